// How much a pass over the constraints changed their impulses: what tells that further passes would buy nothing.
#pragma once

#include "constraints/contact_rows.hpp"
#include "exec/atomic.hpp"
#include "exec/executor.hpp"

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

/// The impulses of a manifold before a pass, and what the pass did to them.
template <class N>
struct ImpulsesBefore {
  N value[kManifoldPoints][3];

  PLUMB_HD ImpulsesBefore(const RowAccess<N>& row, int points) {
    for (int p = 0; p < points; ++p)
      for (std::uint32_t i = 0; i < 3; ++i) value[p][i] = row.get(point_field(p, kNormalImpulse + i));
  }
  PLUMB_HD void compare(const RowAccess<N>& row, int points, PassChange& to) const {
    N changed = N(0), reached = N(0);
    for (int p = 0; p < points; ++p)
      for (std::uint32_t i = 0; i < 3; ++i) {
        const N now = row.get(point_field(p, kNormalImpulse + i)), by = now - value[p][i];
        changed = max(changed, max(by, -by));
        reached = max(reached, max(now, -now));
      }
    to.note(largest(changed), largest(reached));
  }
};
template <class N>
ImpulsesBefore(const RowAccess<N>&, int) -> ImpulsesBefore<N>;

}  // namespace plumb::impulse
