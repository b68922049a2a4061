// What is remembered of a joint with axes while its rows stay what they are: most of what a pass asks for is what was
// found before.
#pragma once

#include "bodies/body.hpp"
#include "joints/row_lanes.hpp"

namespace plumb::impulse {

class AxisMemory {
 public:
  /// The rows have been made anew.
  PLUMB_HD void forget() { is_refreshed_ = true, has_speeds_ = false; }

  /// Speeds over the sub-step, where they were last found for the same velocities: the pieces of rows are chosen by
  /// them and then solved with them, mostly without a jump between.
  PLUMB_HD bool recall_speeds(const Velocity& a, const Velocity& b, Lanes& speed) const {
    if (!has_speeds_ || differ(lanes_of_velocity(a), load_row(a_)) || differ(lanes_of_velocity(b), load_row(b_)))
      return false;
    speed = load_row(speeds_);
    return true;
  }
  PLUMB_HD void keep_speeds(const Velocity& a, const Velocity& b, const Lanes& speed) {
    store_row(a_, lanes_of_velocity(a));
    store_row(b_, lanes_of_velocity(b));
    store_row(speeds_, speed);
    lanes_meet();
    has_speeds_ = true;
  }

  /// Compares what the factors of n rows are to be made of with what they were made of. Most sets of active rows come
  /// again: those that hold while contacts push are mostly those that hold then, and in the next sub-step. cfm: as
  /// AxisWork's, below 0 of rows that are not active.
  PLUMB_HD void compare_factors(const RowNumbers& cfm, int n) {
    const bool is_refreshed = is_refreshed_;
    lanes_meet();
    const std::uint32_t others = rows_where(0, n, [&](int i) { return (cfm[i] >= 0) != (cfm_[i] >= 0); });
    const std::uint32_t changed = rows_where(0, n, [&](int i) {
      const bool changes = cfm[i] != cfm_[i];
      cfm_[i] = cfm[i];
      return changes;
    });
    is_refreshed_ = false;
    is_factored_ = is_refreshed || changed != 0;
    is_other_ = is_refreshed || others != 0;
  }
  /// Whether other rows are active, or the rows are others.
  [[nodiscard]] PLUMB_HD bool is_other() const { return is_other_; }
  /// Whether the factors are found anew.
  [[nodiscard]] PLUMB_HD bool is_factored() const { return is_factored_; }
  PLUMB_HD void set_factored(bool factored) { is_factored_ = factored; }

 private:
  RowNumbers speeds_, cfm_;  // as they were last found, and of the factors
  RowNumbers a_, b_;         // velocities with which the speeds were found
  bool has_speeds_, is_refreshed_, is_other_, is_factored_;
};

}  // namespace plumb::impulse
