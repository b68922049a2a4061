// What solvers do with joints of which some have rows that do not always hold, and with reactions. As in
// mechanisms.hpp mechanisms are solved each as a whole where their matrix stays sparse: in rounds, until each row is on
// the piece of its law that the solution asks for.
#pragma once

#include "exec/atomic.hpp"
#include "joints/joint_loops.hpp"
#include "joints/tension.hpp"

namespace plumb::impulse {

PLUMB_HD inline AxisView axis_view(const JointSet& joints) {
  AxisView view;
  static_cast<JointView&>(view) = joints.view;
  view.parts = joints.axes;
  return view;
}

/// Returns whether a row is on another piece than before, or ought to be.
PLUMB_HD inline bool choose_in_system(const AxisView& view, const JointSystem& system, std::uint32_t column,
                                      const RowTime& time, std::uint32_t round) {
  const std::uint32_t j = system.base + column;
  const Joint& joint = view.joints[j];
  JointWork& work = system.work(column);
  Lanes jump(0);
  const bool keeps = round != 0 && rows_of(joint.type) == row_count(joint);  // all rows are on pieces where they were
  const bool changed = !keeps && choose_pieces(view, j, time, view.velocity(joint.body_a), view.velocity(joint.body_b),
                                               round, work.share, jump);
  store_row(work.change, jump);
  return changed;
}

/// Whether a column's factors are to be found anew, those of earlier columns being known: for its own rows, for those
/// of later joints that it meets, and for what earlier columns take off it.
PLUMB_HD inline bool needs_factors(const JointSystem& system, const AxisView& view, std::uint32_t column) {
  const AxisWork* work = view.parts.work + system.base;
  bool needs = work[column].is_factored();
  for (std::uint32_t e = system.column_first[column]; !needs && e < system.column_first[column + 1]; ++e)
    needs = work[system.entries[e].row].is_other();
  for (std::uint32_t r = system.row_first[column]; !needs && r < system.row_first[column + 1]; ++r)
    needs = work[system.entries[system.row_entries[r]].column].is_factored();
  return needs;
}

PLUMB_SHARED_DEVICE_CODE inline void factor_axis_system(Team& team, const JointSystem& system,
                                                        const SystemMechanism& mechanism, const AxisView& view) {
  for_columns(team, mechanism, [&](std::uint32_t column) {
    AxisWork& own = view.parts.work[system.base + column];
    own.compare_factors(own.cfm, system.rows(column));
  });
  for_columns_up(team, system, mechanism, [&](std::uint32_t column) {
    AxisWork& own = view.parts.work[system.base + column];
    const bool needs = needs_factors(system, view, column);
    lanes_meet();
    own.set_factored(needs);
    if (!needs) return;
    BlockAtWork diagonal = masked_matrix(own, system.rows(column));
    eliminate_column(system, column, diagonal,
                     [&](std::uint32_t i) { return view.parts.work[system.base + i].active(); });
  });
}

/// What Tikhonov's share leaks while places are solved is taken back as they drift; what leaks while speeds are stays.
/// It calms what sways, but a bridge at rest would seem to sink by a millimetre a second: joints with limits, motors or
/// springs have none.
PLUMB_HD inline Real tikhonov_of_speeds(const AxisView& view, std::uint32_t j) {
  const Joint& joint = view.joints[j];
  return rows_of(joint.type) == row_count(joint) ? view.work[j].tikhonov : Real(0);
}

/// The changes that solve the system with its rows on the pieces chosen. anew: as of row_speeds.
PLUMB_SHARED_DEVICE_CODE inline void find_axis_changes(Team& team, const JointSystem& system,
                                                       const SystemMechanism& mechanism, const AxisView& view,
                                                       const RowTime& time, bool anew) {
  for_columns_up(team, system, mechanism, [&](std::uint32_t column) {
    const std::uint32_t j = system.base + column;
    const Joint& joint = view.joints[j];
    const Real tikhonov = time.pass == RowPass::kSpeeds ? tikhonov_of_speeds(view, j) : view.work[j].tikhonov;
    const Lanes y =
        row_residuals(view, j, time, view.velocity(joint.body_a), view.velocity(joint.body_b), anew, tikhonov);
    store_row(system.work(column).change, without_earlier(system, column, y));
  });
  for_columns_down(team, system, mechanism, [&](std::uint32_t column) { solve_backward(system, column); });
}

/// A mechanism's joints in one pass.
PLUMB_SHARED_DEVICE_CODE inline void solve_in_rounds(Team& team, const JointSystem& system,
                                                     const SystemMechanism& mechanism, const AxisView& view,
                                                     const RowTime& time) {
  ChangeCount count(team, system, mechanism);
  RoundCount rounds;
  std::uint32_t stiffened = 0;
  while (true) {
    const ChangeCount::Round now = count.next();
    const std::uint32_t round = rounds.round();
    for_columns(team, mechanism, [&](std::uint32_t column) {
      if (column == mechanism.first_column) now.clear_next();
      if (choose_in_system(view, system, column, time, round) && leads_lanes()) now.note_change();
    });
    team.barrier();
    const RoundKind kind = rounds.next(*now.now != 0);
    if (kind == RoundKind::kDone) break;
    push_changes(team, system, mechanism);
    if (has_new_matrix(kind)) factor_axis_system(team, system, mechanism, view);
    find_axis_changes(team, system, mechanism, view, time, has_new_tangent(kind));
    while (time.pass == RowPass::kPlaces && stiffened < kMostStiffenings &&
           tension_grows(team, system, mechanism, time.h, count)) {
      ++stiffened;
      for_columns(team, mechanism, [&](std::uint32_t column) { refresh_axis_joint(view, system.base + column); });
      factor_axis_system(team, system, mechanism, view);
      find_axis_changes(team, system, mechanism, view, time, has_new_tangent(kind));
    }
    push_changes(team, system, mechanism);
  }
  for_columns(team, mechanism, [&](std::uint32_t column) {
    store_row(system.work(column).change, settle_pieces(view, system.base + column, time));
  });
  push_changes(team, system, mechanism);
}

PLUMB_DEVICE inline void add_reactions(Team& team, const JointSet& joints) {
  const AxisView view = axis_view(joints);
  each_by_rows(team, joints.count, [=](std::uint32_t j) { add_reaction(view, j); });
}

/// A mechanism's rows where its bodies are now. As of refresh_mechanism.
PLUMB_DEVICE inline void refresh_axes(Team& team, const JointSystem& system, const SystemMechanism& mechanism,
                                      const AxisView& view, const StepParameters& step, bool first) {
  const bool touched = system.is_touched(mechanism);
  for_places(team, mechanism, [&](std::uint32_t place) { find_least_moment(system, place, step, first); });
  for_columns(team, mechanism, [&](std::uint32_t column) {
    refresh_axis_joint(view, system.base + column);
    if (!touched) choose_share(view, system.base + column, step.h);
  });
}

/// A sub-step begins, or a step: impulses of joint j are those of the last one.
PLUMB_HD inline void begin_axis_joint(const AxisView& view, std::uint32_t j, bool first, const StepParameters& step) {
  if (first) take_over_impulse(view, j, step);
  begin_reaction(view, j, first && !step.is_later_part);
}

/// The impulses of the last sub-step, or step, act again.
PLUMB_SHARED_DEVICE_CODE inline void warm_start_axes(Team& team, const JointSet& joints, bool first,
                                                     const StepParameters& step) {
  if (joints.count == 0) return;
  const AxisView view = axis_view(joints);
  const JointSystem& system = joints.system;
  each_single_joint(team, joints, step.level, [=](std::uint32_t j) {
    begin_axis_joint(view, j, first, step);
    if (first) refresh_axis_joint(view, j);
  });
  for_single_joints(team, joints, step.level, [=](std::uint32_t j) { warm_start_joint(view, j, false, step); });
  for_mechanisms_of_level(team, system, step.level, [&](Team& own, const SystemMechanism& mechanism) {
    for_columns(own, mechanism,
                [&](std::uint32_t column) { begin_axis_joint(view, system.base + column, first, step); });
    if (first) refresh_axes(own, system, mechanism, view, step, true);
    push_totals(own, system, mechanism);
  });
}

/// The speed that contacts have left a row that holds while they push.
PLUMB_HD inline Real speed_met(const AxisView& view, std::uint32_t j, int row) {
  const AxisWork& own = view.parts.work[j];
  return own.piece[row] == RowPiece::kSteady ? own.target[row] : Real(0);
}

/// The rows that always hold pass on what contacts did to single bodies, so that all others start from where they
/// nearly are: from speeds that no mechanism has they would not find their pieces. So do those that are predicted to.
PLUMB_DEVICE inline void pass_on_loads(Team& team, const JointSystem& system, const SystemMechanism& mechanism,
                                       const AxisView& view) {
  for_columns(team, mechanism, [&](std::uint32_t column) { choose_rows_met(view, system.base + column); });
  factor_axis_system(team, system, mechanism, view);
  for_columns_up(team, system, mechanism, [&](std::uint32_t column) {
    const std::uint32_t j = system.base + column;
    const Joint& joint = view.joints[j];
    const AxisWork& own = view.parts.work[j];
    const Lanes speeds = speeds_now(view, j, view.velocity(joint.body_a), view.velocity(joint.body_b));
    const Real tikhonov = tikhonov_of_speeds(view, j);
    const Lanes y = by_row(row_count(joint), [&](int i) {
      if (!own.is_active(i)) return Real(0);
      return -((of_row(speeds, i) - speed_met(view, j, i)) + tikhonov * own.cfm[i] * view.total(j)[i]);
    });
    store_row(system.work(column).change, without_earlier(system, column, y));
  });
  for_columns_down(team, system, mechanism, [&](std::uint32_t column) { solve_backward(system, column); });
  push_changes(team, system, mechanism);
}

/// Where contacts push mechanisms, what is beyond a limit comes back no faster than this, m/s or rad/s: where one holds
/// against it, as the ground does under the foot of a leg that is folded as far as it goes, more would throw all of it
/// up.
constexpr Real kMostReturn = 1;

/// One pass of the sub-stepped solver: over places, or over speeds after positions have moved. touched: contacts may
/// push mechanisms. loaded: those that they do push have yet to pass on what contacts did.
PLUMB_SHARED_DEVICE_CODE inline void solve_axes(Team& team, const JointSet& joints, const StepParameters& step,
                                                RowPass pass, bool touched, bool loaded) {
  if (joints.count == 0) return;
  const AxisView view = axis_view(joints);
  const JointSystem& system = joints.system;
  RowTime time = {pass, step.h, step.inverse_h, step.joint.bias_rate,
                  pass == RowPass::kSpeeds ? Real(0) : step.joint.gamma};
  if (touched) time.most_return = kMostReturn;
  if (pass == RowPass::kSpeeds)
    each_single_joint(team, joints, step.level, [=](std::uint32_t j) { refresh_axis_joint(view, j); });
  for_single_joints(team, joints, step.level, [=](std::uint32_t j) { solve_axis_joint(view, j, time); });
  each_single_joint(team, joints, step.level, [=](std::uint32_t j) { add_reaction(view, j); });
  RowTime exact = time;
  exact.rate = step.joint_rate;
  exact.chain_rate = step.chain_rate;
  for_mechanisms_of_level(team, system, step.level, [&](Team& own, const SystemMechanism& mechanism) {
    if (pass == RowPass::kSpeeds) refresh_axes(own, system, mechanism, view, step, false);
    if (loaded && system.is_touched(mechanism)) pass_on_loads(own, system, mechanism, view);
    solve_in_rounds(own, system, mechanism, view, exact);
    const bool follows = pass == RowPass::kSpeeds && view.solver.mechanisms.count != 0;
    for_columns(own, mechanism, [&](std::uint32_t column) {
      if (follows) follow_rows(view, system.base + column, exact);
      add_reaction(view, system.base + column);
    });
  });
}

}  // namespace plumb::impulse
