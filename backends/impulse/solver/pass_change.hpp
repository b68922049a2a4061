// How much a pass over the constraints changed their impulses: what tells that further passes would buy nothing.
#pragma once

#include "constraints/contact.hpp"
#include "constraints/joint_bias.hpp"
#include "exec/atomic.hpp"
#include "solver/joint_loops.hpp"

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

/// A contact in one pass: normals, then friction, which so stays within the cone. noted: null where nobody asks.
template <class N>
PLUMB_HD void solve_whole_contact(const RowAccess<N>& row, int points, SolverBody<N>& a, SolverBody<N>& b,
                                  const ContactPass& pass, PassChange* noted) {
  const ImpulsesBefore before(row, noted == nullptr ? 0 : points);
  solve_normals(row, points, a, b, pass);
  if (pass.friction) solve_friction(row, points, a, b);
  if (noted != nullptr) before.compare(row, points, *noted);
}

/// All joints in one pass.
PLUMB_DEVICE inline void solve_joints_noted(Team& team, const JointSet& joints, const StepParameters& step,
                                            PassChange* noted) {
  const JointView view = joints.view;
  const Real bias_rate = step.bias_rate;
  for_joints(team, joints, [=](std::uint32_t j) {
    const JointImpulse before = view.impulses[view.joints[j].slot];
    solve_joint_with_bias(view, j, bias_rate);
    if (noted == nullptr) return;
    const JointImpulse& now = view.impulses[view.joints[j].slot];
    Real changed = 0, reached = 0;
    for (int i = 0; i < rows_of(view.joints[j].type); ++i) {
      changed = max(changed, abs(now.along[i] - before.along[i]));
      reached = max(reached, abs(now.along[i]));
    }
    noted->note(changed, reached);
  });
}

}  // namespace plumb::impulse
