// Joints while they are solved: rows of the sub-step, what impulses along them do to the two bodies, and a pass over a
// plain joint. What passes there are is in joint_law.hpp.
#pragma once

#include "bodies/axis_locks.hpp"
#include "bodies/motion.hpp"
#include "joints/jacobian.hpp"
#include "joints/joint_law.hpp"

namespace plumb::impulse {

/// What is worked out at the start of a step and after positions have moved (make_joint_rows, refresh_axis_joint), and
/// with it while a mechanism is solved (choose_share, factor_column).
struct JointWork {
  Jacobian rows;
  RowNumbers error;    ///< C where the rows were made
  bool is_far_off;     ///< there
  JointMatrix factor;  ///< K, and then its factors; of joints that are not plain the factors alone (AxisWork::whole)
  // While a mechanism is solved as a whole:
  Real share;         ///< by which rows yield, relative to K
  Real tikhonov;      ///< the part of that which the impulses gathered so far count for
  RowNumbers change;  ///< of the impulse
  RowNumbers cfm;     ///< speed for a unit impulse by which a row yields beside what the bodies do
};

struct JointImpulse {
  Real along[kJointRows];  ///< N s, N m s
};

/// What joints did to a body whose angular velocity is kept in world axes, by one thread.
PLUMB_HD inline void store_plainly(const Velocity& before, const Velocity& after, Velocity& velocity,
                                   FreeVelocity& free) {
#if defined(PLUMB_IMPULSE_CUDA)
  velocity.linear = after.linear;
  velocity.angular = after.angular;
  free.linear += after.linear - before.linear;
  free.angular += after.angular - before.angular;
#else
  velocity = after;
  store_row(free, load_row(free) + (load_row(after) - load_row(before)));
#endif
}

/// The swing of a body that tumbles, and of what: on a CPU it is found once for all reads between two moves.
struct KeptSwing {
  Quat rotation, orientation;
  Vec inertia;
  Quat swing;
};

/// Everything that a kernel over joints reads and writes.
struct JointView {
  Bodies bodies;
  SolverBodies solver;
  const Joint* joints;
  JointWork* work;
  JointImpulse* impulses;  ///< by slot
  Real* least_moment;      ///< by body: what tension asks of its principal moments (joints/tension.hpp), kg m2
  // Of bodies of the system, each for all its joints, by body:
  JointEnd* arrivals;      ///< where they will be after a sub-step
  KeptSwing* kept_swings;  ///< on a CPU

  PLUMB_HD JointEnd end(std::uint32_t body) const {
    if (body == kWorld) return {{0, 0, 0}, {0, 0, 0, 1}};
    const Displacement& displacement = solver.displacement[body];
    return {displacement.linear, displacement.rotation * bodies.orientation[body]};
  }
  /// Where a body will be after h seconds at its present velocity.
  PLUMB_HD JointEnd end_after(std::uint32_t body, const Velocity& velocity, Real h) const {
    if (body == kWorld) return {{0, 0, 0}, {0, 0, 0, 1}};
    const Displacement& displacement = solver.displacement[body];
    const Turned turned = turn_freely(bodies, solver, displacement.rotation, velocity.angular, h, body);
    return {displacement.linear + h * velocity.linear, turned.rotation * bodies.orientation[body]};
  }
  PLUMB_HD Vec base(const Joint& joint) const {
    const Position from = joint.body_a == kWorld ? joint.world_anchor : bodies.position[joint.body_a];
    return between(from, bodies.position[joint.body_b]);
  }
  /// Of sub-steps.
  PLUMB_HD std::uint32_t level(const Joint& joint) const {
    return solver.levels.of_pair(solver.velocity, joint.body_a, joint.body_b);
  }
  PLUMB_HD Real inverse_mass(std::uint32_t body) const {
    return body == kWorld ? Real(0) : solver.velocity[body].inverse_mass;
  }
  /// In world axes.
  PLUMB_INLINE Velocity velocity(std::uint32_t body) const {
    if (body == kWorld) return {{0, 0, 0}, 0, {0, 0, 0}, 0};
    if (tumbles(bodies, solver, body)) return swung_velocity(body);
    return solver.velocity[body];
  }
  PLUMB_HD Velocity swung_velocity(std::uint32_t body) const {
    Velocity velocity = solver.velocity[body];
    velocity.angular = rotate(swing(body), velocity.angular);
    return velocity;
  }
  PLUMB_HD Quat swing(std::uint32_t body) const {
#if !defined(PLUMB_IMPULSE_CUDA)
    const KeptSwing& kept = kept_swings[body];
    const auto is_kept = [](const auto& x, const auto& y) { return __builtin_memcmp(&x, &y, sizeof x) == 0; };
    if (is_kept(kept.rotation, solver.displacement[body].rotation) &&
        is_kept(kept.orientation, bodies.orientation[body]) && is_kept(kept.inertia, bodies.mass[body].inertia))
      return kept.swing;
#endif
    return swing_now(bodies, solver, body);
  }
  /// Bodies have moved: of each body by one thread.
  PLUMB_HD void keep_swing([[maybe_unused]] std::uint32_t body) const {
#if !defined(PLUMB_IMPULSE_CUDA)
    if (tumbles(bodies, solver, body))
      kept_swings[body] = {solver.displacement[body].rotation, bodies.orientation[body], bodies.mass[body].inertia,
                           swing_now(bodies, solver, body)};
#endif
  }
  /// Without what tension asks.
  PLUMB_HD Sym own_inverse_inertia(std::uint32_t body, const Quat& orientation) const {
    if (body == kWorld) return {0, 0, 0, 0, 0, 0};
    const BodyMass& mass = bodies.mass[body];
    return world_inverse_inertia(orientation, mass.flags, inverse_moments(mass, tumbles(bodies, solver, body)));
  }
  PLUMB_HD Sym inverse_inertia(std::uint32_t body, const Quat& orientation) const {
    if (body == kWorld) return {0, 0, 0, 0, 0, 0};
    const BodyMass& mass = bodies.mass[body];
    const Real most = least_moment[body] > 0 ? Real(1) / least_moment[body] : kHuge;
    const Vec inverse = inverse_moments(mass, tumbles(bodies, solver, body));
    return world_inverse_inertia(orientation, mass.flags,
                                 {min(inverse.x, most), min(inverse.y, most), min(inverse.z, most)});
  }
  /// Joint impulses go into the free velocity too: the next sub-step starts from them along its own rows, so they must
  /// not be carried over as velocity (motion.hpp). By one thread.
  PLUMB_HD void store(std::uint32_t body, const Velocity& before, const Velocity& after) const {
    if (!(before.inverse_mass > 0)) return;
    Velocity& velocity = solver.velocity[body];
    FreeVelocity& free = solver.free_velocity[body];
    if (!tumbles(bodies, solver, body)) return store_plainly(before, after, velocity, free);
    velocity.linear = after.linear;
    free.linear += after.linear - before.linear;
    const Vec change = rotate_back(swing(body), after.angular - before.angular);
    velocity.angular += change;
    free.angular += change;
  }
  /// Likewise by the threads of a joint's rows. was: before, as all of them have it.
  PLUMB_HD void store(std::uint32_t body, const Velocity& was, const Lanes& before, const Lanes& after) const {
    if (!(was.inverse_mass > 0)) return;
    if (tumbles(bodies, solver, body)) {
      const Velocity now = velocity_of(after);
      if (leads_lanes()) store(body, was, now);
      return;
    }
    lanes_meet();  // all have read what the others now write
    store_row(solver.velocity[body], after);
    FreeVelocity& free = solver.free_velocity[body];
    store_row(free, load_row(free) + (after - before));
  }
};

/// What was done to a joint's bodies, of which one of its threads stores it.
PLUMB_HD inline void store_bodies(const JointView& view, std::uint32_t j, const Velocity& a, const Velocity& b,
                                  const Velocity& new_a, const Velocity& new_b) {
  if (!leads_lanes()) return;
  view.store(view.joints[j].body_a, a, new_a);
  view.store(view.joints[j].body_b, b, new_b);
}

PLUMB_HD inline void push_joint(const JointWork& work, int n, const Real* impulse, Velocity& a, Velocity& b) {
  push_along(work.rows, n, false, impulse, a);
  push_along(work.rows, n, true, impulse, b);
}

/// What a joint moves, with the bodies at those ends.
PLUMB_HD inline JointMass joint_mass(const JointView& view, const Joint& joint, const JointEnd& a, const JointEnd& b) {
  return {view.inverse_inertia(joint.body_a, a.orientation), view.inverse_inertia(joint.body_b, b.orientation),
          view.inverse_mass(joint.body_a) + view.inverse_mass(joint.body_b)};
}

/// Rows, errors and K where the bodies are now.
PLUMB_SHARED_CODE inline void make_joint_rows(const JointView& view, std::uint32_t j) {
  const Joint& joint = view.joints[j];
  JointWork& work = view.work[j];
  const JointEnd a = view.end(joint.body_a), b = view.end(joint.body_b);
  const JointPlace place = place_joint(joint, view.base(joint), a, b);
  joint_errors(joint, place, work.error);
  work.is_far_off = is_far_off(joint, place);
  put_rows(work.rows, row_count(joint), joint_mass(view, joint, a, b), work.factor,
           [&](JointRow(&rows)[kJointRows]) { joint_rows(joint, place, rows); });
}

PLUMB_HD inline void factor_joint(const JointView& view, std::uint32_t j) {
  factor(view.work[j].factor, row_count(view.joints[j]));
  lanes_meet();
}
/// Both, for a joint that is solved by itself.
PLUMB_HD inline void refresh_joint(const JointView& view, std::uint32_t j) {
  make_joint_rows(view, j);
  factor_joint(view, j);
}

/// Whether a body turns by a radian or more in that time.
PLUMB_HD inline bool turns_far(const Velocity& a, const Velocity& b, Real h) {
  return h * h * max(length_squared(a.angular), length_squared(b.angular)) > 1;
}
/// Whether a joint's rows as they stand say nothing of where they will be. Such a joint is held by its speeds alone:
/// seen ahead, it would be flung about, ever faster.
PLUMB_HD inline bool cannot_see_ahead(const JointWork& work, const Velocity& a, const Velocity& b, Real h) {
  return work.is_far_off || turns_far(a, b, h);
}

/// Speeds along the rows as they stand.
PLUMB_HD inline Lanes speeds_now(const JointView& view, std::uint32_t j, const Velocity& a, const Velocity& b) {
  return speeds_along(view.work[j].rows, a, b);
}

/// Errors are taken back no faster than this, m/s or rad/s. Bodies that are joined where they are metres apart are
/// drawn together; all at once they would be flung, and through what is between.
constexpr Real kMostJointSpeed = 10;
template <class N>
PLUMB_HD N speed_of_error(Real rate, const N& error) {
  return clamp(N(rate) * error, N(-kMostJointSpeed), N(kMostJointSpeed));
}

/// The rate at which a joint's errors are taken back: by degrees in a long chain, and where contacts press, which
/// would take the speed for a blow. Not of a ring, such as a bridge between two hooks: what it bears would stretch it.
PLUMB_HD inline Real rate_of_error(const JointView& view, const Joint& joint, const JointPass& pass) {
  const Real rate = pass.softness.bias_rate;
  const Mechanisms& mechanisms = view.solver.mechanisms;
  const bool pressed = (joint.body_a != kWorld && mechanisms.touch(joint.body_a)) || mechanisms.touch(joint.body_b);
  if (joint.in_chain || (pressed && !joint.in_ring)) return min(rate, pass.chain_rate);
  return joint.yields_turning && !joint.in_ring ? min(rate, pass.whip_rate) : rate;
}

/// How far the velocities of rows that always hold are from what they should be in this pass. end_after: as the
/// view's.
template <class EndAfter>
PLUMB_HD Lanes joint_residuals(const JointView& view, std::uint32_t j, const JointPass& pass, const Velocity& a,
                               const Velocity& b, const EndAfter& end_after) {
  const Joint& joint = view.joints[j];
  const JointWork& work = view.work[j];
  if (pass.kind == PassKind::kSpeeds) return speeds_along(work.rows, a, b);
  const Lanes error = load_row(work.error);
  const Lanes back = speed_of_error(rate_of_error(view, joint, pass), error);
  if (pass.kind == PassKind::kWhole || cannot_see_ahead(work, a, b, pass.h))
    return speeds_along(work.rows, a, b) + back;
  const JointPlace place = place_joint(joint, view.base(joint), end_after(joint.body_a, a), end_after(joint.body_b, b));
  RowNumbers then{};
  joint_errors(joint, place, then);
  return (lanes_of_numbers(then) - error) * Lanes(pass.inverse_h) + back;
}
PLUMB_HD inline Lanes joint_residuals(const JointView& view, std::uint32_t j, const JointPass& pass, const Velocity& a,
                                      const Velocity& b) {
  return joint_residuals(view, j, pass, a, b, [&](std::uint32_t body, const Velocity& velocity) {
    return view.end_after(body, velocity, pass.h);
  });
}

/// What the last step ended with is where this one begins.
PLUMB_HD inline void take_over_impulse(const JointView& view, std::uint32_t j, const StepParameters& step) {
  const Joint& joint = view.joints[j];
  JointImpulse& impulse = view.impulses[joint.slot];
  const Real kept = view.solver.levels.warm_start(step, view.solver.velocity, joint.body_a, joint.body_b);
  each_row(0, kJointRows,
           [&](int i) { impulse.along[i] = joint.first_step == step.step ? Real(0) : kept * impulse.along[i]; });
}

PLUMB_HD inline void keep_change(const JointView& view, std::uint32_t j) {
  JointImpulse& impulse = view.impulses[view.joints[j].slot];
  each_row(0, row_count(view.joints[j]), [&](int i) { impulse.along[i] = impulse.along[i] + view.work[j].change[i]; });
}

/// Impulses along a joint's rows push its two bodies.
PLUMB_HD inline void push_bodies(const JointView& view, std::uint32_t j, const Velocity& a, const Velocity& b,
                                 const Real* impulse) {
  const Joint& joint = view.joints[j];
  Velocity new_a = a, new_b = b;
  push_joint(view.work[j], row_count(joint), impulse, new_a, new_b);
  store_bodies(view, j, a, b, new_a, new_b);
}

/// The impulses that the joint had before act again, along its rows as they are now.
PLUMB_HD inline void warm_start_joint(const JointView& view, std::uint32_t j) {
  const Joint& joint = view.joints[j];
  push_bodies(view, j, view.velocity(joint.body_a), view.velocity(joint.body_b), view.impulses[joint.slot].along);
}

/// Impulses along a joint's rows act, and are added to what it has.
PLUMB_HD inline void apply_impulse(const JointView& view, std::uint32_t j, const Velocity& a, const Velocity& b,
                                   const Lanes& impulse) {
  const Joint& joint = view.joints[j];
  JointImpulse& total = view.impulses[joint.slot];
  each_row(0, row_count(joint), [&](int i) { total.along[i] = total.along[i] + of_row(impulse, i); });
  RowNumbers all;
  spread(impulse, all);
  push_bodies(view, j, a, b, all);
}

/// A plain joint by itself.
PLUMB_HD inline void solve_joint(const JointView& view, std::uint32_t j, const JointPass& pass) {
  const Joint& joint = view.joints[j];
  const Velocity a = view.velocity(joint.body_a), b = view.velocity(joint.body_b);
  Lanes impulse = -solved_lanes(view.work[j].factor, row_count(joint), joint_residuals(view, j, pass, a, b));
  if (pass.kind == PassKind::kPlaces) {
    const Lanes total = lanes_of_numbers(view.impulses[joint.slot].along);
    impulse = Lanes(pass.softness.mass_scale) * impulse - Lanes(pass.softness.impulse_scale) * total;
  }
  apply_impulse(view, j, a, b, impulse);
}

}  // namespace plumb::impulse
