// What solvers do with joints: one by one, and, in the sub-stepped one, those of mechanisms whose matrix stays sparse
// each as a whole.
//
// A plain joint, or a mechanism of such, is one linear system. Where there are limits, motors, springs or locked axes
// it is solved in rounds (joint_axis_solve.hpp, mechanism_rounds.hpp). Which of the two is asked of each joint and each
// mechanism by itself, so that a motor changes nothing for what it is not joined to. A step of plain joints has a view
// that knows no others, and code that is smaller.
#pragma once

#include "joints/mechanism_rounds.hpp"

namespace plumb::impulse {

/// A set's joints, as code of that kind sees them.
template <JointCode kJoints>
PLUMB_HD auto view_of(const JointSet& joints) {
  if constexpr (kJoints == JointCode::kAll) {
    AxisView view;
    static_cast<JointView&>(view) = joints.view;
    view.parts = joints.axes;
    return view;
  } else {
    return joints.view;
  }
}

// --- a joint by itself

/// A sub-step begins, or a step: impulses of joint j are those of the last one.
PLUMB_HD inline void begin_joint(const JointView& view, std::uint32_t j, bool first, const StepParameters& step) {
  if (first) take_over_impulse(view, j, step);
}
PLUMB_HD inline void begin_joint(const AxisView& view, std::uint32_t j, bool first, const StepParameters& step) {
  if (first) take_over_impulse(view, j, step);
  begin_reaction(view, j, first && !step.is_later_part);
}

/// Its rows where its bodies are now.
PLUMB_HD inline void refresh(const JointView& view, std::uint32_t j) { refresh_joint(view, j); }
PLUMB_HD inline void refresh(const AxisView& view, std::uint32_t j) {
  if (is_plain(view.joints[j]))
    refresh_joint(view, j);
  else
    refresh_axis_joint(view, j);
}

PLUMB_HD inline void solve(const JointView& view, std::uint32_t j, const JointPass& pass) {
  solve_joint(view, j, pass);
}
PLUMB_HD inline void solve(const AxisView& view, std::uint32_t j, const JointPass& pass) {
  if (is_plain(view.joints[j]))
    solve_joint(view, j, pass);
  else
    solve_axis_joint(view, j, pass);
}

/// Whether joints of such a view have reactions, which every sub-step adds to.
template <class View>
inline constexpr bool kHasReactions = std::is_same_v<View, AxisView>;

// --- a mechanism as a whole

/// The rows of joint j, one of its columns, where the bodies are now.
PLUMB_HD inline void refresh_rows(const SystemMechanism& /*mechanism*/, const JointView& view, std::uint32_t j) {
  make_joint_rows(view, j);
}
PLUMB_HD inline void refresh_rows(const SystemMechanism& mechanism, const AxisView& view, std::uint32_t j) {
  if (mechanism.is_plain)
    make_joint_rows(view, j);
  else
    refresh_axis_joint(view, j);
}

/// Its rows, and the least moments of its bodies. first: in the step. Where contacts push it as a whole they count on
/// it that joints yield as they did when its mobility was found (solver/mechanism_mobility.hpp).
template <class View>
PLUMB_SHARED_DEVICE_CODE void refresh_mechanism(Team& team, const JointSystem& system, const SystemMechanism& mechanism,
                                                const View& view, const StepParameters& step, bool first) {
  const bool touched = system.is_touched(mechanism);
  for_places(team, mechanism, [&](std::uint32_t place) { find_least_moment(system, place, step, first); });
  for_columns(team, mechanism, [&](std::uint32_t column) {
    refresh_rows(mechanism, view, system.base + column);
    if (!touched) choose_share(view, system.base + column, step.h);
  });
  if (mechanism.is_plain) factor_system(team, system, mechanism);
}

/// A plain one, in one pass. That over places finds tension, and reckons with it. What contacts did to single bodies is
/// passed on before anybody looks where the bodies will be: a plank that bears what weighs a hundred times as much
/// would be looked at where it is thrown alone, far off, and made energy of what took it back from there.
PLUMB_SHARED_DEVICE_CODE inline void solve_plain_mechanism(Team& team, const JointSystem& system,
                                                           const SystemMechanism& mechanism, const JointPass& pass) {
  const bool over_places = pass.kind == PassKind::kPlaces;
  if (over_places && system.is_touched(mechanism)) {
    JointPass load = pass;
    load.kind = PassKind::kSpeeds;
    find_changes(team, system, mechanism, load);
    push_changes(team, system, mechanism);
  }
  find_changes(team, system, mechanism, pass);
  if (over_places) {
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

/// first: sub-step of the step. In rounds loads are passed on before speeds are solved, too, for pieces are chosen by
/// them; and not before the places of the first sub-step, where contacts have done no more than start warm.
PLUMB_DEVICE inline void solve_mechanism(Team& team, const JointSystem& system, const SystemMechanism& mechanism,
                                         const JointView& /*view*/, const JointPass& pass, bool /*first*/) {
  solve_plain_mechanism(team, system, mechanism, pass);
}
PLUMB_SHARED_DEVICE_CODE inline void solve_mechanism(Team& team, const JointSystem& system,
                                                     const SystemMechanism& mechanism, const AxisView& view,
                                                     const JointPass& pass, bool first) {
  const bool over_speeds = pass.kind == PassKind::kSpeeds;
  if (mechanism.is_plain) {
    solve_plain_mechanism(team, system, mechanism, pass);
  } else {
    if ((over_speeds || !first) && system.is_touched(mechanism)) pass_on_loads(team, system, mechanism, view);
    solve_in_rounds(team, system, mechanism, view, pass);
  }
  const bool follows = over_speeds && !mechanism.is_plain && view.solver.mechanisms.count != 0;
  for_columns(team, mechanism, [&](std::uint32_t column) {
    if (follows) follow_rows(view, system.base + column, pass);
    add_reaction(view, system.base + column);
  });
}

// --- all of a level of sub-steps

/// The impulses of the last sub-step, or step, act again. first: sub-step of the step.
template <class View>
PLUMB_SHARED_DEVICE_CODE void warm_start_joints(Team& team, const JointSet& joints, const View& view, bool first,
                                                const StepParameters& step) {
  if (joints.count == 0) return;
  const JointSystem& system = joints.system;
  if (first || kHasReactions<View>)
    each_single_joint(team, joints, step.level, [=](std::uint32_t j) {
      begin_joint(view, j, first, step);
      if (first) refresh(view, j);
    });
  for_single_joints(team, joints, step.level, [=](std::uint32_t j) { warm_start_joint(view, j); });
  for_mechanisms_of_level(team, system, step.level, [&](Team& own, const SystemMechanism& mechanism) {
    if (first || kHasReactions<View>)
      for_columns(own, mechanism, [&](std::uint32_t column) { begin_joint(view, system.base + column, first, step); });
    if (first) refresh_mechanism(own, system, mechanism, view, step, true);
    push_totals(own, system, mechanism);
  });
}

/// Bodies have moved: how far what joints couple has gone.
PLUMB_DEVICE inline void follow_ways(Team& team, const JointSet& joints, const StepParameters& step) {
  if (!joints.any_couples) return;
  const AxisView view = view_of<JointCode::kAll>(joints);
  each_by_rows(team, joints.count, [=](std::uint32_t j) {
    if (view.level(view.joints[j]) == step.level) add_way(view, j, step.h);
  });
  team.barrier();
}

/// Where contacts push mechanisms, what is beyond a limit comes back no faster than this, m/s or rad/s: where one holds
/// against it, as the ground does under the foot of a leg that is folded as far as it goes, more would throw all of it
/// up.
inline constexpr Real kMostReturn = 1;
/// Of a whip, whose rows yield a little, this share of the errors is taken back in a sub-step: all at once it would
/// swing about its place, ever by as much.
inline constexpr Real kWhipRate = Real(0.6);

/// A pass over mechanisms. There what is beyond a limit comes back by degrees, too: contacts push a body beyond a limit
/// by a little in each sub-step, and back at once it would be thrown at them, for ever.
PLUMB_HD inline JointPass exact_pass(PassKind kind, const StepParameters& step, bool collision) {
  JointPass pass = {kind, step.h, step.inverse_h, rigid(step.joint_rate), step.chain_rate, kWhipRate * step.joint_rate};
  if (!collision) return pass;
  pass.return_rate = step.chain_rate;
  pass.most_return = kMostReturn;
  return pass;
}

/// One pass of the sub-stepped solver: over places, or over speeds after positions have moved. collision: contacts may
/// push mechanisms. first: sub-step of the step.
template <class View>
PLUMB_SHARED_DEVICE_CODE void solve_joints(Team& team, const JointSet& joints, const View& view,
                                           const StepParameters& step, PassKind kind, bool collision, bool first) {
  if (joints.count == 0) return;
  const JointSystem& system = joints.system;
  const bool over_speeds = kind == PassKind::kSpeeds;
  const JointPass exact = exact_pass(kind, step, collision);
  JointPass pass = exact;
  if (!over_speeds) pass.softness = step.joint;
  if (over_speeds) each_single_joint(team, joints, step.level, [=](std::uint32_t j) { refresh(view, j); });
  for_single_joints(team, joints, step.level, [=](std::uint32_t j) { solve(view, j, pass); });
  if constexpr (kHasReactions<View>)
    each_single_joint(team, joints, step.level, [=](std::uint32_t j) { add_reaction(view, j); });
  for_mechanisms_of_level(team, system, step.level, [&](Team& own, const SystemMechanism& mechanism) {
    if (over_speeds) refresh_mechanism(own, system, mechanism, view, step, false);
    solve_mechanism(own, system, mechanism, view, exact, first);
  });
}

/// Contacts have pushed mechanisms, and bodies are about to move: those that would pass a limit are solved once more.
/// Contacts count on limits only where they have held for a while. What is light and short would be turned far beyond
/// others, and where two press it against one, stay there.
PLUMB_SHARED_DEVICE_CODE inline void hold_limits(Team& team, const JointSet& joints, const AxisView& view,
                                                 const StepParameters& step, bool first) {
  const JointSystem& system = joints.system;
  const JointPass pass = exact_pass(PassKind::kPlaces, step, true);
  for_mechanisms_of_level(team, system, step.level, [&](Team& own, const SystemMechanism& mechanism) {
    if (mechanism.is_plain || !system.is_touched(mechanism)) return;
    ChangeCount count(own, system, mechanism);
    const ChangeCount::Round now = count.next();
    for_columns(own, mechanism, [&](std::uint32_t column) {
      if (passes_limit(view, system.base + column, step.h) && leads_lanes()) now.note_change();
    });
    own.barrier();
    const bool passes = *now.now != 0;
    own.barrier();  // what comes next counts anew
    if (passes) solve_mechanism(own, system, mechanism, view, pass, first);
  });
}

}  // namespace plumb::impulse
