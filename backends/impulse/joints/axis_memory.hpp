// What a CPU remembers of a joint with axes while its rows stay what they are: most of what a pass asks for is what was
// found before. On a GPU the joints of a level take as long as the slowest of them, and nothing is remembered.
#pragma once

#include "bodies/body.hpp"
#include "joints/joint.hpp"

namespace plumb::impulse {

#if defined(PLUMB_IMPULSE_CUDA)

class AxisMemory {
 public:
  PLUMB_HD void forget() {}
  PLUMB_HD bool recall_speeds(const Velocity& /*a*/, const Velocity& /*b*/, RowNumbers& /*speed*/) const {
    return false;
  }
  PLUMB_HD void keep_speeds(const Velocity& /*a*/, const Velocity& /*b*/, const RowNumbers& /*speed*/) {}
};

#else

class AxisMemory {
 public:
  /// The rows have been made anew.
  void forget() { is_refreshed_ = true, has_speeds_ = false; }

  /// Speeds over the sub-step, where they were last found for the same velocities: the pieces of rows are chosen by
  /// them and then solved with them, mostly without a jump between.
  bool recall_speeds(const Velocity& a, const Velocity& b, RowNumbers& speed) const {
    if (!has_speeds_ || any(differ(a, a_) || differ(b, b_))) return false;
    store_row(speed, load_row(speeds_));
    return true;
  }
  void keep_speeds(const Velocity& a, const Velocity& b, const RowNumbers& speed) {
    a_ = a;
    b_ = b;
    store_row(speeds_, load_row(speed));
    has_speeds_ = true;
  }

  /// Compares what the factors of n rows are to be made of with what they were made of. Most sets of active rows come
  /// again: those that hold while contacts push are mostly those that hold then, and in the next sub-step. cfm: as
  /// AxisWork's, below 0 of rows that are not active.
  void compare_factors(const RowNumbers& cfm, int n) {
    is_factored_ = is_other_ = is_refreshed_;
    is_refreshed_ = false;
    for (int i = 0; i < n; ++i) {
      if (cfm[i] == cfm_[i]) continue;
      is_factored_ = true;
      is_other_ = is_other_ || (cfm[i] >= 0) != (cfm_[i] >= 0);
      cfm_[i] = cfm[i];
    }
  }
  /// Whether other rows are active, or the rows are others.
  [[nodiscard]] bool is_other() const { return is_other_; }
  /// Whether the factors are found anew.
  [[nodiscard]] bool is_factored() const { return is_factored_; }
  void set_factored(bool factored) { is_factored_ = factored; }

 private:
  /// To the last bit.
  static Mask differ(const Velocity& x, const Velocity& y) {
    return {__builtin_bit_cast(Mask::Vector, load_row(x).v) != __builtin_bit_cast(Mask::Vector, load_row(y).v)};
  }

  RowNumbers speeds_, cfm_;  // as they were last found, and of the factors
  Velocity a_, b_;           // with which the speeds were found
  bool has_speeds_, is_refreshed_, is_other_, is_factored_;
};

#endif

}  // namespace plumb::impulse
