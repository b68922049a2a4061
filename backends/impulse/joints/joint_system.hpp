// Mechanisms solved exactly: the L D L^T of all joints of one at once (joints/joint_elimination.hpp), level by
// level. Each thread gathers what earlier levels give to its own row, so that sums have one order. Mechanisms do not
// depend on each other, whatever else is in the world.
#pragma once

#include "exec/executor.hpp"
#include "joints/joint_factors.hpp"

namespace plumb::impulse {

/// How much a row yields beside what the bodies do, relative to that: below what positions resolve.
inline constexpr Real kCfmShare = sizeof(Real) == 8 ? Real(1e-10) : Real(1e-5);
/// In a mechanism that closes on itself rows may repeat others (those of four parallel hinges do), and would leave
/// their impulses undetermined: they yield by so much more. Those of a whip yield a little more: by less, blows make
/// energy in float; by 1e-4 what hangs on a long arm swings on it by decimetres a second.
inline constexpr Real kCfmShareInLoops = Real(1e-4), kCfmShareInWhips = sizeof(Real) == 8 ? kCfmShare : Real(1.6e-5);
/// Impulses grow where turns of the rows feed back on them: by the square of the angle turned in a sub-step, over what
/// rows yield. There, and in a whip, they yield by so many times that square.
inline constexpr Real kCfmShareByTurn = 16;
/// Of what rows yield whatever the turn, the part that leaks: that counts for the impulse gathered so far, too. All of
/// it (Tikhonov's regularisation), and every mechanism gives way under its load; none of it (a proximal step), and what
/// rows leave undetermined never fades. (Parikh, Boyd, "Proximal Algorithms", 2014, section 4.1.)
inline constexpr Real kTikhonovShare = Real(0.1);

/// By how much of their own mobility the rows of joint j yield. Where contacts push mechanisms as a whole it is chosen
/// once a step: they push too hard, and more so each time, where joints then yield more than they counted on.
PLUMB_HD inline void choose_share(const JointView& view, std::uint32_t j, Real h) {
  const Joint& joint = view.joints[j];
  const Real a = length_squared(h * view.velocity(joint.body_a).angular);
  const Real b = length_squared(h * view.velocity(joint.body_b).angular);
  const Real still = joint.in_ring ? kCfmShareInLoops : joint.yields_turning ? kCfmShareInWhips : kCfmShare;
  const Real turned = joint.yields_turning ? kCfmShareByTurn * (a + b) : Real(0);
  JointWork& work = view.work[j];
  work.share = still + turned;
  work.tikhonov = (kTikhonovShare * still + turned) / work.share;
}

PLUMB_HD inline void factor_column(const JointSystem& system, std::uint32_t j) {
  JointWork& work = system.work(j);
  const int n = system.rows(j);
  const Lanes cfm = by_row(n, [&](int p) { return work.share * work.factor(p, p); });
  store_row(work.cfm, cfm);
  BlockAtWork diagonal;
  copy_columns(work.factor, n, diagonal);
  add_to_diagonal(diagonal, n, cfm);
  eliminate_column(system, j, diagonal, [](std::uint32_t) { return kAllRows; });
}

/// What the joints before it give, taken off a row's residuals y.
PLUMB_HD inline Lanes without_earlier(const JointSystem& system, std::uint32_t j, Lanes y) {
  for (std::uint32_t r = system.row_first[j]; r < system.row_first[j + 1]; ++r) {
    const std::uint32_t e = system.row_entries[r];
    const std::uint32_t k = system.entries[e].column;
    y = without_product(y, system.scaled[e], system.work(k).change, system.rows(k));
  }
  return y;
}

/// Where the body at a place will be, for column_residuals.
PLUMB_HD inline void find_arrival(const JointSystem& system, std::uint32_t place, Real h) {
  const std::uint32_t body = system.bodies[place];
  system.view.arrivals[body] = system.view.end_after(body, system.view.velocity(body), h);
}

/// How far the rows of a column of plain joints are from what they should be in this pass, with the other sign.
PLUMB_HD inline Lanes column_residuals(const JointSystem& system, std::uint32_t j, const JointPass& pass) {
  const Joint& joint = system.view.joints[system.base + j];
  const JointWork& work = system.work(j);
  const JointView& view = system.view;
  const Lanes residual =
      joint_residuals(view, system.base + j, pass, view.velocity(joint.body_a), view.velocity(joint.body_b),
                      [&](std::uint32_t body, const Velocity& velocity) {
                        const bool is_of_system = velocity.inverse_mass > 0;
                        return is_of_system ? view.arrivals[body] : view.end_after(body, velocity, pass.h);
                      });
  const Lanes total = lanes_of_numbers(system.view.impulses[joint.slot].along);
  return -(residual + Lanes(work.tikhonov) * load_row(work.cfm) * total);
}

PLUMB_HD inline void solve_backward(const JointSystem& system, std::uint32_t j) {
  JointWork& work = system.work(j);
  Lanes z = solved_lanes(work.factor, system.rows(j), load_row(work.change));
  for (std::uint32_t e = system.column_first[j]; e < system.column_first[j + 1]; ++e) {
    const std::uint32_t i = system.entries[e].row;
    z = without_product(z, system.turned[e], system.work(i).change, system.rows(i));
  }
  store_row(work.change, z);
}

#if !defined(PLUMB_IMPULSE_CUDA)
/// Whether no number of a row is 0: then it stays what it is, to the sign of its zeros, when 0 is added.
inline bool has_no_zero(const Lanes& row, std::uint32_t numbers) {
  return !any(lanes_of(numbers) && !(row < Lanes(0)) && !(row > Lanes(0)));
}
/// Whether the changes on a body are 0, and leave all its numbers as they are.
inline bool stays(const JointSystem& system, std::uint32_t place) {
  for (std::uint32_t k = system.body_first[place]; k < system.body_first[place + 1]; ++k) {
    const Lanes change = load_row(system.view.work[system.on_body[k].joint].change);
    if (any(Mask{change.v != Lanes::Vector{}})) return false;
  }
  const std::uint32_t body = system.bodies[place];
  return has_no_zero(load_row(system.view.solver.velocity[body]), kVelocityLanes) &&
         has_no_zero(load_row(system.view.solver.free_velocity[body]), kVelocityLanes);
}
#endif

/// All impulses on one body act. With `total` those that the joints have gathered, else the change just found.
PLUMB_HD inline void push_body(const JointSystem& system, std::uint32_t place, bool total) {
  const JointView& view = system.view;
  const std::uint32_t body = system.bodies[place];
  const Velocity velocity = view.velocity(body);
  const Lanes before = lanes_of_velocity(velocity);
  Lanes after = before;
  for (std::uint32_t k = system.body_first[place]; k < system.body_first[place + 1]; ++k) {
    const JointOnBody on = system.on_body[k];
    const JointWork& work = view.work[on.joint];
    const Joint& joint = view.joints[on.joint];
    const Real* impulse = total ? view.impulses[joint.slot].along : work.change;
    after = pushed_along(work.rows, row_count(joint), on.is_b, velocity.inverse_mass, impulse, after);
  }
  view.store(body, velocity, before, only_velocity(after, before));
}

/// f(team, mechanism) for every mechanism: of small ones each by its own team.
template <class F>
PLUMB_DEVICE void for_mechanisms(Team& team, const JointSystem& system, const F& f) {
  team.each_group(system.small_count, system.mechanism_count, [&](Team& own, std::uint32_t m) {
    const SystemMechanism mechanism = system.mechanisms[m];
    f(own, mechanism);
  });
}
/// Likewise of those that have sub-steps of that level.
template <class F>
PLUMB_DEVICE void for_mechanisms_of_level(Team& team, const JointSystem& system, std::uint32_t level, const F& f) {
  for_mechanisms(team, system, [&](Team& own, const SystemMechanism& mechanism) {
    if (system.level(mechanism) == level) f(own, mechanism);
  });
}

/// f(i) for every i < n, by the threads that work on the rows of one joint.
template <class F>
PLUMB_DEVICE void each_by_rows(Team& team, std::uint32_t n, const F& f) {
  team.each(n * kRowThreads, [=](std::uint32_t i) { f(i / kRowThreads); });
}

/// f(column) for every column of a mechanism, by the threads of its rows.
template <class F>
PLUMB_DEVICE void for_columns(Team& team, const SystemMechanism& mechanism, const F& f) {
  const std::uint32_t first = mechanism.first_column;
  each_by_rows(team, mechanism.column_count(), [=](std::uint32_t i) { f(first + i); });
}
/// Level after level, upward or downward.
template <class F>
PLUMB_DEVICE void for_columns_of_level(Team& team, const JointSystem& system, std::uint32_t level, const F& f) {
  const std::uint32_t first = system.level_first[level];
  each_by_rows(team, system.level_first[level + 1] - first, [=](std::uint32_t i) { f(first + i); });
}
template <class F>
PLUMB_DEVICE void for_columns_up(Team& team, const JointSystem& system, const SystemMechanism& mechanism, const F& f) {
  for (std::uint32_t level = mechanism.first_level; level < mechanism.level_end; ++level)
    for_columns_of_level(team, system, level, f);
}
template <class F>
PLUMB_DEVICE void for_columns_down(Team& team, const JointSystem& system, const SystemMechanism& mechanism,
                                   const F& f) {
  for (std::uint32_t level = mechanism.level_end; level-- > mechanism.first_level;)
    for_columns_of_level(team, system, level, f);
}
/// f(place) for every body of a mechanism, by one thread.
template <class F>
PLUMB_DEVICE void for_places(Team& team, const SystemMechanism& mechanism, const F& f) {
  const std::uint32_t first = mechanism.first_place;
  team.each(mechanism.place_count(), [=](std::uint32_t i) { f(first + i); });
}

/// The impulses gathered act on all bodies.
PLUMB_DEVICE inline void push_totals(Team& team, const JointSystem& system, const SystemMechanism& mechanism) {
  each_by_rows(team, mechanism.place_count(),
               [=](std::uint32_t i) { push_body(system, mechanism.first_place + i, true); });
}

/// The changes found act on all bodies.
PLUMB_SHARED_DEVICE_CODE inline void push_changes(Team& team, const JointSystem& system,
                                                  const SystemMechanism& mechanism) {
  each_by_rows(team, max(mechanism.column_count(), mechanism.place_count()), [=](std::uint32_t i) {
    if (i < mechanism.column_count()) keep_change(system.view, system.base + mechanism.first_column + i);
    if (i >= mechanism.place_count()) return;
    const std::uint32_t place = mechanism.first_place + i;
#if !defined(PLUMB_IMPULSE_CUDA)
    if (stays(system, place)) return;
#endif
    push_body(system, place, false);
  });
}

PLUMB_SHARED_DEVICE_CODE inline void factor_system(Team& team, const JointSystem& system,
                                                   const SystemMechanism& mechanism) {
  for_columns_up(team, system, mechanism, [&](std::uint32_t j) { factor_column(system, j); });
}

/// The changes that solve the system for the residuals of its columns.
template <class Residuals>
PLUMB_DEVICE void solve_columns(Team& team, const JointSystem& system, const SystemMechanism& mechanism,
                                const Residuals& residuals) {
  for_columns_up(team, system, mechanism,
                 [&](std::uint32_t j) { store_row(system.work(j).change, without_earlier(system, j, residuals(j))); });
  for_columns_down(team, system, mechanism, [&](std::uint32_t j) { solve_backward(system, j); });
}

/// The changes that solve the system, which do not act yet.
PLUMB_SHARED_DEVICE_CODE inline void find_changes(Team& team, const JointSystem& system,
                                                  const SystemMechanism& mechanism, const JointPass& pass) {
  if (pass.kind == PassKind::kPlaces)
    for_places(team, mechanism, [&](std::uint32_t place) { find_arrival(system, place, pass.h); });
  solve_columns(team, system, mechanism, [&](std::uint32_t j) { return column_residuals(system, j, pass); });
}

}  // namespace plumb::impulse
