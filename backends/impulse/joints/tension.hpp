// What tension in joints asks of a body's inertia, so that a light link under a heavy load does not fly apart.
//
// A joint that pulls with F at an arm r turns its body back towards the line of the force: a spring of stiffness up to
// k = (F r + |F| |r|) / 2, the largest eigenvalue of the geometric stiffness; what pushes inward asks for nothing. It
// is taken as it was in the sub-step before, and such a spring is stable only while its stiffness is below 4 I / h^2.
// So no moment is less than the sum of h^2 k over a body's joints: what swings faster than a sub-step can follow swings
// more slowly instead (Andrews, Teichmann, Kry, "Geometric Stiffness for Real-time Constrained Multibody Dynamics",
// Eurographics 2017, section 4, bounds its diagonal likewise; Tournier et al., "Stable Constrained Dynamics", SIGGRAPH
// 2015, on why it is needed). What turns slowly keeps its own inertia. About the arm, too, though nothing pulls there:
// moments that differ much make energy where a body tumbles.
//
// Tension that comes at once, as where a rope snaps taut, is found by the very solve that it upsets: what that finds is
// thrown away, and found again with the moments that it asks for.
#pragma once

#include "exec/atomic.hpp"
#include "joints/joint_system.hpp"

namespace plumb::impulse {

/// The least moment falls no faster than this, s: tension that comes and goes would pump.
inline constexpr Real kTensionFades = 1;

/// Moments that tension asks for may be short of that by this factor before the changes found are found again, and that
/// is done no more often than this in a pass.
inline constexpr Real kTensionGrows = Real(1.2);
inline constexpr std::uint32_t kMostStiffenings = 2;

/// What the tension in its joints asks for, for the body at a place of the system; kg m2. changed: when the changes
/// found have acted.
PLUMB_HD inline Real moment_by_tension(const JointSystem& system, std::uint32_t place, Real h, bool changed) {
  const Quat orientation = system.view.end(system.bodies[place]).orientation;
  Real moment = 0;
  for (std::uint32_t k = system.body_first[place]; k < system.body_first[place + 1]; ++k) {
    const JointOnBody on = system.on_body[k];
    const Joint& joint = system.view.joints[on.joint];
    const JointWork& work = system.view.work[on.joint];
    const Real* total = system.view.impulses[joint.slot].along;
    Vec pull = {0, 0, 0};
    for (int i = 0; i < row_count(joint); ++i) {
      const Real impulse = changed ? total[i] + work.change[i] : total[i];
      if ((joint.pulls >> i & 1U) != 0) pull += impulse * work.rows.direction(i);
    }
    const Vec arm = rotate(orientation, (on.is_b ? joint.frame_b : joint.frame_a).position);
    const Real outward = on.is_b ? dot(pull, arm) : -dot(pull, arm);
    moment = moment + h * max(Real(0), outward + sqrt(length_squared(pull) * length_squared(arm))) / 2;
  }
  return moment;
}

/// One over the least of the moments that the body has by itself.
PLUMB_HD inline Real largest_inverse(const JointView& view, std::uint32_t body) {
  const Vec inverse = inverse_moments(view.bodies.mass[body], tumbles(view.bodies, view.solver, body));
  return max(max(inverse.x, inverse.y), inverse.z);
}

/// A body whose moments grow from one bound to the other keeps its angular momentum: with its angular velocity it would
/// gain energy each time a rope snaps taut.
PLUMB_HD inline void slow_down(const JointView& view, std::uint32_t body, Real from, Real to) {
  if (largest_inverse(view, body) * to <= 1) return;
  const BodyMass& mass = view.bodies.mass[body];
  const Vec inverse = inverse_moments(mass, tumbles(view.bodies, view.solver, body));
  const Velocity before = view.velocity(body);
  const Quat orientation = view.end(body).orientation;
  Vec turn = rotate_back(orientation, before.angular);
  for (int i = 0; i < 3; ++i)
    if (inverse[i] * to > 1) turn[i] = turn[i] * (max(Real(1), inverse[i] * from) / (inverse[i] * to));
  Velocity after = before;
  after.angular = unlocked(mass.flags, kLockAngular, rotate(orientation, turn));
  view.store(body, before, after);
}

/// In a sub-step, for the body at a place of the system. first: of the step.
PLUMB_HD inline void find_least_moment(const JointSystem& system, std::uint32_t place, const StepParameters& step,
                                       bool first) {
  const std::uint32_t body = system.bodies[place];
  const Real h = step.h, shortened = first ? system.view.solver.levels.shortened(step, body) : Real(1);
  system.view.keep_swing(body);
  Real& kept = system.view.least_moment[body];
  const Real before = kept, fading = shortened * max(Real(0), Real(1) - h / kTensionFades);
  kept = max(moment_by_tension(system, place, h, false), fading * before);
  if (kept > before) slow_down(system.view, body, before, kept);
}

/// Counts, in a mechanism's rounds, what changes in each. What a round counts is cleared while the one before is
/// counted, when everybody has long read what it was.
class ChangeCount {
 public:
  PLUMB_DEVICE ChangeCount(Team& team, const JointSystem& system, const SystemMechanism& mechanism)
      : counts_(system.changes + std::size_t{3} * mechanism.number) {
    std::uint32_t* const counts = counts_;
    team.single([=] { counts[0] = 0; });
  }
  /// The next round, as its loop has it.
  struct Round {
    std::uint32_t *now, *next;
    /// Once in a round.
    PLUMB_HD void clear_next() const { *next = 0; }
    PLUMB_DEVICE void note_change() const { atomic_add(now, 1U); }
  };
  PLUMB_HD Round next() {
    const std::uint32_t turn = turn_++;
    return {counts_ + turn % 3, counts_ + (turn + 1) % 3};
  }

 private:
  std::uint32_t* counts_;
  std::uint32_t turn_ = 0;
};

/// Whether the changes found, which have not acted yet, bring tension that asks for larger moments, which bodies have
/// from then on: the changes must be found again.
PLUMB_DEVICE inline bool tension_grows(Team& team, const JointSystem& system, const SystemMechanism& mechanism, Real h,
                                       ChangeCount& count) {
  const ChangeCount::Round round = count.next();
  for_places(team, mechanism, [&](std::uint32_t place) {
    if (place == mechanism.first_place) round.clear_next();
    const std::uint32_t body = system.bodies[place];
    Real& kept = system.view.least_moment[body];
    const Real before = kept, asked = moment_by_tension(system, place, h, true);
    if (!(asked > kTensionGrows * before && asked * largest_inverse(system.view, body) > kTensionGrows)) return;
    kept = asked;
    slow_down(system.view, body, before, asked);
    round.note_change();
  });
  team.barrier();
  return *round.now != 0;
}

}  // namespace plumb::impulse
