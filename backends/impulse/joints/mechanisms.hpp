// What the sub-stepped solver does with the joints: mechanisms are solved each as a whole where their matrix stays
// sparse, the joints of others one by one.
#pragma once

#include "joints/joint_loops.hpp"
#include "joints/tension.hpp"

namespace plumb::impulse {

/// A mechanism's joints as they stand now. first: in the step. Where contacts push it as a whole they count on it that
/// joints yield as they did when its mobility was found (mechanism_mobility.hpp).
PLUMB_SHARED_DEVICE_CODE inline void refresh_mechanism(Team& team, const JointSystem& system,
                                                       const SystemMechanism& mechanism, const StepParameters& step,
                                                       bool first) {
  const bool touched = system.is_touched(mechanism);
  for_places(team, mechanism, [&](std::uint32_t place) { find_least_moment(system, place, step, first); });
  for_columns(team, mechanism, [&](std::uint32_t column) {
    make_joint_rows(system.view, system.base + column);
    if (!touched) choose_share(system.view, system.base + column, step.h);
  });
  factor_system(team, system, mechanism);
}

/// The impulses of the last sub-step, or step, act again.
PLUMB_SHARED_DEVICE_CODE inline void warm_start_mechanisms(Team& team, const JointSet& joints, bool first,
                                                           const StepParameters& step) {
  if (joints.count == 0) return;
  const JointView view = joints.view;
  const JointSystem& system = joints.system;
  if (first)
    each_single_joint(team, joints, step.level, [=](std::uint32_t j) {
      take_over_impulse(view, j, step);
      refresh_joint(view, j);
    });
  for_single_joints(team, joints, step.level, [=](std::uint32_t j) { warm_start_joint(view, j, false, step); });
  for_mechanisms_of_level(team, system, step.level, [&](Team& own, const SystemMechanism& mechanism) {
    if (first) {
      for_columns(own, mechanism, [&](std::uint32_t column) { take_over_impulse(view, system.base + column, step); });
      refresh_mechanism(own, system, mechanism, step, true);
    }
    push_totals(own, system, mechanism);
  });
}

/// A mechanism's joints in one pass. The first of a sub-step finds tension, and reckons with it.
PLUMB_SHARED_DEVICE_CODE inline void solve_mechanism(Team& team, const JointSystem& system,
                                                     const SystemMechanism& mechanism, const JointPass& pass) {
  find_changes(team, system, mechanism, pass);
  if (pass.take_back_error) {
    ChangeCount count(team, system, mechanism);
    for (std::uint32_t stiffened = 0; stiffened < kMostStiffenings; ++stiffened) {
      if (!tension_grows(team, system, mechanism, pass.h, count)) break;
      for_columns(team, mechanism, [&](std::uint32_t column) { make_joint_rows(system.view, system.base + column); });
      factor_system(team, system, mechanism);
      find_changes(team, system, mechanism, pass);
    }
  }
  push_changes(team, system, mechanism);
}

/// What contacts did to single bodies is passed on before anybody looks where the bodies will be: a plank that bears
/// what weighs a hundred times as much would be looked at where it is thrown alone, far off, and made energy of what
/// took it back from there.
PLUMB_DEVICE inline void pass_on_loads(Team& team, const JointSystem& system, const SystemMechanism& mechanism,
                                       JointPass pass) {
  pass.take_back_error = false;
  find_changes(team, system, mechanism, pass);
  push_changes(team, system, mechanism);
}

/// One pass: the first of a sub-step, which takes errors back, or the second, after positions have moved.
PLUMB_SHARED_DEVICE_CODE inline void solve_mechanisms(Team& team, const JointSet& joints, const StepParameters& step,
                                                      bool take_back_error) {
  if (joints.count == 0) return;
  const JointView view = joints.view;
  const JointSystem& system = joints.system;
  const JointPass pass = {step.joint, step.chain_rate, step.h, step.inverse_h, take_back_error};
  if (!take_back_error) each_single_joint(team, joints, step.level, [=](std::uint32_t j) { refresh_joint(view, j); });
  for_single_joints(team, joints, step.level, [=](std::uint32_t j) { solve_joint(view, j, pass); });
  JointPass exact = pass;
  exact.softness = {step.joint_rate, 1, 0};
  for_mechanisms_of_level(team, system, step.level, [&](Team& own, const SystemMechanism& mechanism) {
    if (!take_back_error) refresh_mechanism(own, system, mechanism, step, false);
    if (take_back_error && system.is_touched(mechanism)) pass_on_loads(own, system, mechanism, exact);
    solve_mechanism(own, system, mechanism, exact);
  });
}

}  // namespace plumb::impulse
