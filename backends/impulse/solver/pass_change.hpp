// How much a pass over the constraints changed their impulses: what tells that further passes would buy nothing.
#pragma once

#include "constraints/contact_friction.hpp"
#include "constraints/contact_normals.hpp"
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

/// A contact in one pass of a solver that takes the step whole: normals, then friction, which so stays within the cone.
struct ContactPass {
  bool friction, note_impacts;
  PassChange* noted;  ///< null where nobody asks

  template <int P, class N>
  PLUMB_HD void solve(const RowAccess<N>& row, Contact<N>& contact, SolverBody<N>& a, SolverBody<N>& b) const {
    Vec3<N> before[P];
    PLUMB_UNROLL
    for (int p = 0; p < P; ++p) before[p] = impulse_of(contact.points[p]);
    ManifoldAim<N> aims;
    aim_hard<P>(contact, aims);
    solve_normals<P>(contact, aims, a, b, note_impacts);
    if (friction) solve_friction<P>(contact, a, b);
    store_impulses<P>(row, contact);
    if (note_impacts) store_impact_speeds<P>(row, contact);
    if (noted == nullptr) return;
    N changed = N(0), reached = N(0);
    PLUMB_UNROLL
    for (int p = 0; p < P; ++p) {
      const Vec3<N> now = impulse_of(contact.points[p]);
      changed = max(changed, most_of(now - before[p]));
      reached = max(reached, most_of(now));
    }
    noted->note(largest(changed), largest(reached));
  }

 private:
  template <class N>
  PLUMB_HD static Vec3<N> impulse_of(const ContactPoint<N>& point) {
    return {point.impulse[0], point.impulse[1], point.impulse[2]};
  }
  template <class N>
  PLUMB_HD static N most_of(const Vec3<N>& v) {
    return max(max(max(v.x, -v.x), max(v.y, -v.y)), max(v.z, -v.z));
  }
};

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
