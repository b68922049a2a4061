// How much a pass over the constraints changed their impulses: what tells that further passes would buy nothing.
#pragma once

#include <type_traits>

#include "exec/atomic.hpp"
#include "math/real.hpp"

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

}  // namespace plumb::impulse
