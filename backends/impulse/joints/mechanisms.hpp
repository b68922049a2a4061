// What the sub-stepped solver does with the joints: mechanisms are solved as a whole where their matrix stays sparse,
// the joints of others one by one.
#pragma once

#include "joints/joint_loops.hpp"
#include "joints/tension.hpp"

namespace plumb::impulse {

/// The joints as they stand now. loaded: contacts push mechanisms as a whole (mechanism_mobility.hpp), and count on it
/// that joints yield as they did there.
PLUMB_DEVICE inline void refresh_mechanisms(Team& team, const JointSet& joints, Real h, Real shortened, bool loaded) {
  const JointView view = joints.view;
  const JointSystem system = joints.system;
  const std::uint32_t base = system.base;
  team.each(system.body_count, [=](std::uint32_t place) { find_least_moment(system, place, h, shortened); });
  team.each(joints.count, [=](std::uint32_t j) {
    make_joint_rows(view, j);
    if (j < base) factor_joint(view, j);
    if (j >= base && !loaded) choose_share(view, j, h);
  });
  factor_system(team, joints.system);
}

/// The impulses of the last sub-step, or step, act again.
PLUMB_DEVICE inline void warm_start_mechanisms(Team& team, const JointSet& joints, bool first, bool loaded,
                                               const StepParameters& step) {
  if (joints.count == 0) return;
  const JointView view = joints.view;
  const JointSystem system = joints.system;
  if (first) {
    team.each(joints.count, [=](std::uint32_t j) {
      if (j == 0) system.changes[0] = 0;
      take_over_impulse(view, j, step);
    });
    refresh_mechanisms(team, joints, step.h, step.shortened, loaded);
  }
  for_single_joints(team, joints, [=](std::uint32_t j) { warm_start_joint(view, j, false, step); });
  team.each(system.body_count, [=](std::uint32_t i) { push_body(system, i, true); });
}

/// The system's joints in one pass. The first of a sub-step finds tension, and reckons with it. turn: counts the rounds
/// of a step.
PLUMB_DEVICE inline void solve_system(Team& team, const JointSystem& system, const JointPass& pass,
                                      std::uint32_t& turn) {
  if (system.levels == 0) return;
  find_changes(team, system, pass);
  for (std::uint32_t stiffened = 0; pass.take_back_error && stiffened < kMostStiffenings; ++stiffened) {
    if (!tension_grows(team, system, pass.h, turn)) break;
    team.each(system.level_first[system.levels],
              [=](std::uint32_t i) { make_joint_rows(system.view, system.base + i); });
    factor_system(team, system);
    find_changes(team, system, pass);
  }
  push_changes(team, system);
}

/// What contacts did to single bodies is passed on before anybody looks where the bodies will be: a plank that bears
/// what weighs a hundred times as much would be looked at where it is thrown alone, far off, and made energy of what
/// took it back from there.
PLUMB_DEVICE inline void pass_on_loads(Team& team, const JointSystem& system, JointPass pass) {
  if (system.levels == 0) return;
  pass.take_back_error = false;
  find_changes(team, system, pass);
  push_changes(team, system);
}

/// One pass: the first of a sub-step, which takes errors back, or the second, after positions have moved.
PLUMB_DEVICE inline void solve_mechanisms(Team& team, const JointSet& joints, const StepParameters& step,
                                          bool take_back_error, bool loaded, std::uint32_t& turn) {
  if (joints.count == 0) return;
  if (!take_back_error) refresh_mechanisms(team, joints, step.h, 1, loaded);
  const JointView view = joints.view;
  const JointPass pass = {step.joint, step.chain_rate, step.h, step.inverse_h, take_back_error};
  for_single_joints(team, joints, [=](std::uint32_t j) { solve_joint(view, j, pass); });
  JointPass exact = pass;
  exact.softness = {step.joint_rate, 1, 0};
  if (take_back_error && loaded) pass_on_loads(team, joints.system, exact);
  solve_system(team, joints.system, exact, turn);
}

}  // namespace plumb::impulse
