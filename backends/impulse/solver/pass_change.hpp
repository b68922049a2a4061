// How much a pass over the constraints changed their impulses: what tells that further passes would buy nothing.
#pragma once

#include <limits>
#include <type_traits>

#include "exec/atomic.hpp"
#include "math/wide.hpp"

namespace plumb::impulse {

/// The largest change of an impulse in a pass, and the largest impulse, N s. Held as the bits of non-negative numbers,
/// which are ordered as whole numbers: their maximum does not depend on the order of the calls.
struct PassChange {
  using Bits = std::conditional_t<sizeof(Real) == 8, std::uint64_t, std::uint32_t>;
  Bits change, impulse;

  PLUMB_HD void note(Real changed, Real reached) {
    raise(change, changed);
    raise(impulse, reached);
  }
  PLUMB_HD bool is_below(Real share) const { return number(change) <= share * number(impulse); }

 private:
  PLUMB_HD static Real number(Bits bits) {
    Real x;
    __builtin_memcpy(&x, &bits, sizeof x);
    return x;
  }
  PLUMB_HD static void raise(Bits& most, Real x) {
    Bits bits;
    __builtin_memcpy(&bits, &x, sizeof bits);
    atomic_max(&most, bits);
  }
};

/// x, not negative, or 0 where it is no number any more. A body that is lost changes for ever, and all others would be
/// passed over on its account; and whether inf or NaN is left of it differs by device.
template <class N>
[[nodiscard]] PLUMB_HD N zero_unless_finite(const N& x) {
  return select(x < N(std::numeric_limits<Real>::infinity()), x, N(0));
}

}  // namespace plumb::impulse
