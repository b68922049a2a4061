// What solvers do with joints of which some have rows that do not always hold, and with reactions. As in
// mechanisms.hpp mechanisms are solved as a whole where their matrix stays sparse: in rounds, until each row is on the
// piece of its law that the solution asks for.
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

/// Of a joint whose rows always hold: on the pieces where they were.
PLUMB_HD inline void keep_all_rows(JointWork& work) {
  for (Real& change : work.change) change = 0;
}

PLUMB_HD inline void choose_in_system(const AxisView& view, const JointSystem& system, std::uint32_t column,
                                      const RowTime& time, std::uint32_t round, std::uint32_t turn) {
  const std::uint32_t j = system.base + column;
  const Joint& joint = view.joints[j];
  if (column == 0) system.changes[(turn + 1) % 3] = 0;
  if (round != 0 && rows_of(joint.type) == row_count(joint)) return keep_all_rows(system.work(column));
  const bool changed = choose_pieces(view, j, time, view.velocity(joint.body_a), view.velocity(joint.body_b), round,
                                     view.work[j].share, system.work(column).change);
  if (changed) atomic_add(&system.changes[turn % 3], 1U);
}

#if !defined(PLUMB_IMPULSE_CUDA)
/// Whether a column's factors are to be found anew, those of earlier columns being known: for its own rows, for those
/// of later joints that it meets, and for what earlier columns take off it.
inline bool needs_factors(const JointSystem& system, const AxisView& view, std::uint32_t column) {
  const AxisWork* work = view.parts.work + system.base;
  bool needs = work[column].is_factored();
  for (std::uint32_t e = system.column_first[column]; !needs && e < system.column_first[column + 1]; ++e)
    needs = work[system.entries[e].row].is_other();
  for (std::uint32_t r = system.row_first[column]; !needs && r < system.row_first[column + 1]; ++r)
    needs = work[system.entries[system.row_entries[r]].column].is_factored();
  return needs;
}
#endif

PLUMB_DEVICE inline void factor_axis_system(Team& team, const JointSystem& system, const AxisView& view) {
#if !defined(PLUMB_IMPULSE_CUDA)
  team.each(system.level_first[system.levels], [=](std::uint32_t column) {
    AxisWork& own = view.parts.work[system.base + column];
    own.compare_factors(own.cfm, system.rows(column));
  });
#endif
  for_columns_up(team, system, [=](std::uint32_t column) {
    AxisWork& own = view.parts.work[system.base + column];
#if !defined(PLUMB_IMPULSE_CUDA)
    own.set_factored(needs_factors(system, view, column));
    if (!own.is_factored()) return;
#endif
    mask_matrix(own, system.rows(column), system.work(column).factor);
    eliminate_column(system, column, [&](std::uint32_t i) { return view.parts.work[system.base + i].active(); });
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
PLUMB_DEVICE inline void find_axis_changes(Team& team, const JointSystem& system, const AxisView& view,
                                           const RowTime& time, bool anew) {
  for_columns_up(team, system, [=](std::uint32_t column) {
    const std::uint32_t j = system.base + column;
    const Joint& joint = view.joints[j];
    const Real tikhonov = time.pass == RowPass::kSpeeds ? tikhonov_of_speeds(view, j) : view.work[j].tikhonov;
    row_residuals(view, j, time, view.velocity(joint.body_a), view.velocity(joint.body_b), anew, tikhonov,
                  system.work(column).change);
    take_earlier(system, column, system.work(column).change);
  });
  for_columns_down(team, system, [=](std::uint32_t column) { solve_backward(system, column); });
}

/// The system's joints in one pass. turn: counts the rounds of a step; the count of one is cleared while the one before
/// is counted, when everybody has long read what it was.
PLUMB_DEVICE inline void solve_axis_system(Team& team, const JointSet& joints, const RowTime& time,
                                           std::uint32_t& turn) {
  const JointSystem system = joints.system;
  if (system.levels == 0) return;
  const AxisView view = axis_view(joints);
  const std::uint32_t count = joints.count - system.base;
  RoundCount rounds;
  std::uint32_t stiffened = 0;
  while (true) {
    const std::uint32_t now = turn++;
    const std::uint32_t round = rounds.round();
    team.each(count, [=](std::uint32_t column) { choose_in_system(view, system, column, time, round, now); });
    team.barrier();
    const RoundKind kind = rounds.next(system.changes[now % 3] != 0);
    if (kind == RoundKind::kDone) break;
    push_changes(team, system);
    if (has_new_matrix(kind)) factor_axis_system(team, system, view);
    find_axis_changes(team, system, view, time, has_new_tangent(kind));
    while (time.pass == RowPass::kPlaces && stiffened < kMostStiffenings && tension_grows(team, system, time.h, turn)) {
      ++stiffened;
      team.each(count, [=](std::uint32_t column) { refresh_axis_joint(view, system.base + column); });
      factor_axis_system(team, system, view);
      find_axis_changes(team, system, view, time, has_new_tangent(kind));
    }
    push_changes(team, system);
  }
  team.each(count,
            [=](std::uint32_t column) { settle_pieces(view, system.base + column, time, system.work(column).change); });
  push_changes(team, system);
}

PLUMB_DEVICE inline void add_reactions(Team& team, const JointSet& joints) {
  const AxisView view = axis_view(joints);
  team.each(joints.count, [=](std::uint32_t j) { add_reaction(view, j); });
}

/// Rows where the bodies are now. loaded: as of refresh_mechanisms.
PLUMB_DEVICE inline void refresh_axes(Team& team, const JointSet& joints, Real h, Real shortened, bool loaded) {
  const AxisView view = axis_view(joints);
  const JointSystem system = joints.system;
  team.each(system.body_count, [=](std::uint32_t place) { find_least_moment(system, place, h, shortened); });
  team.each(joints.count, [=](std::uint32_t j) {
    refresh_axis_joint(view, j);
    if (!loaded) choose_share(view, j, h);
  });
}

/// The impulses of the last sub-step, or step, act again.
PLUMB_DEVICE inline void warm_start_axes(Team& team, const JointSet& joints, bool first, bool loaded,
                                         const StepParameters& step) {
  if (joints.count == 0) return;
  const AxisView view = axis_view(joints);
  const JointSystem system = joints.system;
  team.each(joints.count, [=](std::uint32_t j) {
    if (j == 0) system.changes[0] = 0;
    if (first) take_over_impulse(view, j, step);
    begin_reaction(view, j, first && !step.is_later_part);
  });
  if (first) refresh_axes(team, joints, step.h, step.shortened, loaded);
  for_single_joints(team, joints, [=](std::uint32_t j) { warm_start_joint(view, j, false, step); });
  team.each(system.body_count, [=](std::uint32_t i) { push_body(system, i, true); });
}

/// The speed that contacts have left a row that holds while they push.
PLUMB_HD inline Real speed_met(const AxisView& view, std::uint32_t j, int row) {
  const AxisWork& own = view.parts.work[j];
  return own.piece[row] == RowPiece::kSteady ? own.target[row] : Real(0);
}

/// The rows that always hold pass on what contacts did to single bodies, so that all others start from where they
/// nearly are: from speeds that no mechanism has they would not find their pieces. So do those that are predicted to.
PLUMB_DEVICE inline void pass_on_loads(Team& team, const JointSet& joints) {
  const JointSystem system = joints.system;
  if (system.levels == 0) return;
  const AxisView view = axis_view(joints);
  team.each(joints.count - system.base, [=](std::uint32_t column) {
    const std::uint32_t j = system.base + column;
    choose_rows_met(view, j);
  });
  factor_axis_system(team, system, view);
  for_columns_up(team, system, [=](std::uint32_t column) {
    const std::uint32_t j = system.base + column;
    const Joint& joint = view.joints[j];
    const AxisWork& own = view.parts.work[j];
    RowNumbers& y = system.work(column).change;
    speeds_now(view, j, view.velocity(joint.body_a), view.velocity(joint.body_b), y);
    const Real tikhonov = tikhonov_of_speeds(view, j);
    for (int i = 0; i < row_count(joint); ++i)
      y[i] = own.is_active(i) ? -((y[i] - speed_met(view, j, i)) + tikhonov * own.cfm[i] * view.total(j)[i]) : Real(0);
    take_earlier(system, column, y);
  });
  for_columns_down(team, system, [=](std::uint32_t column) { solve_backward(system, column); });
  push_changes(team, system);
}

/// Where contacts push mechanisms, what is beyond a limit comes back no faster than this, m/s or rad/s: where one holds
/// against it, as the ground does under the foot of a leg that is folded as far as it goes, more would throw all of it
/// up.
constexpr Real kMostReturn = 1;

/// One pass of the sub-stepped solver: over places, or over speeds after positions have moved. touched: contacts may
/// push mechanisms. loaded: they have handed over what they did.
PLUMB_DEVICE inline void solve_axes(Team& team, const JointSet& joints, const StepParameters& step, RowPass pass,
                                    bool touched, bool loaded, std::uint32_t& turn) {
  if (joints.count == 0) return;
  const AxisView view = axis_view(joints);
  if (pass == RowPass::kSpeeds) refresh_axes(team, joints, step.h, 1, loaded);
  if (loaded) pass_on_loads(team, joints);
  RowTime time = {pass, step.h, step.inverse_h, step.joint.bias_rate,
                  pass == RowPass::kSpeeds ? Real(0) : step.joint.gamma};
  if (touched) time.most_return = kMostReturn;
  for_single_joints(team, joints, [=](std::uint32_t j) { solve_axis_joint(view, j, time); });
  RowTime exact = time;
  exact.rate = step.joint_rate;
  exact.chain_rate = step.chain_rate;
  solve_axis_system(team, joints, exact, turn);
  if (pass == RowPass::kSpeeds && view.solver.mechanisms.count != 0)
    team.each(joints.count - joints.system.base,
              [=](std::uint32_t i) { follow_rows(view, joints.system.base + i, exact); });
  add_reactions(team, joints);
}

}  // namespace plumb::impulse
