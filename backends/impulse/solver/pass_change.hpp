// How much a pass over the constraints changed their impulses: what tells that further passes would buy nothing.
#pragma once

#include "constraints/contact_friction.hpp"
#include "constraints/contact_normals.hpp"
#include "constraints/joint_bias.hpp"
#include "exec/atomic.hpp"
#include "solver/axis_mechanisms.hpp"

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
  PLUMB_HD void solve(const RowAccess<N>& row, Contact<P, N>& contact, SolverBody<N>& a, SolverBody<N>& b) const {
    PerPoint<P, N> before[3];
    PLUMB_UNROLL
    for (int k = 0; k < 3; ++k) before[k] = contact.impulse[k];
    const ManifoldAim<P, N> aim = aim_hard(contact);
    ContactMotion<N> motion = motion_of(contact, a, b);
    ContactWrench<N> wrench = no_wrench<N>();
    const auto held = solve_normals(contact, aim, motion, wrench, note_impacts);
    if (friction) solve_friction(contact, motion, wrench, held);
    push(contact, wrench, a, b);
    store_impulses(row, contact);
    if (note_impacts) store_impact_speeds(row, contact);
    if (noted == nullptr) return;
    PLUMB_UNROLL
    for (int i = 0; i < kHeld<P>; ++i) {
      N changed = N(0), reached = N(0);
      PLUMB_UNROLL
      for (int k = 0; k < 3; ++k) {
        const N now = contact.impulse[k].at[i], change = now - before[k].at[i];
        changed = max(changed, max(change, -change));
        reached = max(reached, max(now, -now));
      }
      noted->note(largest(changed), largest(reached));
    }
  }
};

/// f(j) on a joint, and how much it changed the impulses.
template <class F>
PLUMB_HD void note_joint(const JointView& view, std::uint32_t j, PassChange* noted, const F& f) {
  const JointImpulse before = view.impulses[view.joints[j].slot];
  f(j);
  if (noted == nullptr) return;
  const JointImpulse& now = view.impulses[view.joints[j].slot];
  Real changed = 0, reached = 0;
  for (int i = 0; i < row_count(view.joints[j]); ++i) {
    changed = max(changed, abs(now.along[i] - before.along[i]));
    reached = max(reached, abs(now.along[i]));
  }
  noted->note(changed, reached);
}

/// All joints in one pass.
template <JointCode kJoints>
PLUMB_DEVICE void solve_joints_noted(Team& team, const JointSet& joints, const StepParameters& step,
                                     PassChange* noted) {
  if constexpr (kJoints == JointCode::kAll) {
    const AxisView view = axis_view(joints);
    const RowTime time = {RowPass::kWhole, step.h, step.inverse_h, step.bias_rate, 0};
    for_joints(team, joints, [=](std::uint32_t j) {
      note_joint(view, j, noted, [&](std::uint32_t i) { solve_axis_joint(view, i, time); });
    });
  } else {
    const JointView view = joints.view;
    const Real bias_rate = step.bias_rate;
    for_joints(team, joints, [=](std::uint32_t j) {
      note_joint(view, j, noted, [&](std::uint32_t i) { solve_joint_with_bias(view, i, bias_rate); });
    });
  }
}

}  // namespace plumb::impulse
