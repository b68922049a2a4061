// Mechanisms of which some rows are limits, motors or springs: solved as a whole in rounds, until each row is on the
// piece of its law that the solution asks for.
#pragma once

#include "joints/joint_axis_solve.hpp"
#include "joints/joint_loops.hpp"
#include "joints/tension.hpp"

namespace plumb::impulse {

/// Returns whether a row is on another piece than before, or ought to be.
PLUMB_HD inline bool choose_in_system(const AxisView& view, const JointSystem& system, std::uint32_t column,
                                      const JointPass& pass, std::uint32_t round) {
  const std::uint32_t j = system.base + column;
  const Joint& joint = view.joints[j];
  JointWork& work = system.work(column);
  Lanes jump(0);
  const bool keeps = round != 0 && is_plain(joint);
  const bool changed = !keeps && choose_pieces(view, j, pass, view.velocity(joint.body_a), view.velocity(joint.body_b),
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
  return is_plain(joint) ? view.work[j].tikhonov : Real(0);
}

/// The changes that solve the system with its rows on the pieces chosen. anew: as of row_speeds.
PLUMB_SHARED_DEVICE_CODE inline void find_axis_changes(Team& team, const JointSystem& system,
                                                       const SystemMechanism& mechanism, const AxisView& view,
                                                       const JointPass& pass, bool anew) {
  solve_columns(team, system, mechanism, [&](std::uint32_t column) {
    const std::uint32_t j = system.base + column;
    const Joint& joint = view.joints[j];
    const Real tikhonov = pass.kind == PassKind::kSpeeds ? tikhonov_of_speeds(view, j) : view.work[j].tikhonov;
    return row_residuals(view, j, pass, view.velocity(joint.body_a), view.velocity(joint.body_b), anew, tikhonov);
  });
}

/// A mechanism's joints in one pass.
PLUMB_SHARED_DEVICE_CODE inline void solve_in_rounds(Team& team, const JointSystem& system,
                                                     const SystemMechanism& mechanism, const AxisView& view,
                                                     const JointPass& pass) {
  ChangeCount count(team, system, mechanism);
  RoundCount rounds;
  std::uint32_t stiffened = 0;
  while (true) {
    const ChangeCount::Round now = count.next();
    const std::uint32_t round = rounds.round();
    for_columns(team, mechanism, [&](std::uint32_t column) {
      if (column == mechanism.first_column) now.clear_next();
      if (choose_in_system(view, system, column, pass, round) && leads_lanes()) now.note_change();
    });
    team.barrier();
    const RoundKind kind = rounds.next(*now.now != 0);
    if (kind == RoundKind::kDone) break;
    push_changes(team, system, mechanism);
    if (has_new_matrix(kind)) factor_axis_system(team, system, mechanism, view);
    find_axis_changes(team, system, mechanism, view, pass, has_new_tangent(kind));
    while (pass.kind == PassKind::kPlaces && stiffened < kMostStiffenings &&
           tension_grows(team, system, mechanism, pass.h, count)) {
      ++stiffened;
      for_columns(team, mechanism, [&](std::uint32_t column) { refresh_axis_joint(view, system.base + column); });
      factor_axis_system(team, system, mechanism, view);
      find_axis_changes(team, system, mechanism, view, pass, has_new_tangent(kind));
    }
    push_changes(team, system, mechanism);
  }
  for_columns(team, mechanism, [&](std::uint32_t column) {
    store_row(system.work(column).change, settle_pieces(view, system.base + column, pass));
  });
  push_changes(team, system, mechanism);
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
  solve_columns(team, system, mechanism, [&](std::uint32_t column) {
    const std::uint32_t j = system.base + column;
    const Joint& joint = view.joints[j];
    const AxisWork& own = view.parts.work[j];
    const Lanes speeds = speeds_now(view, j, view.velocity(joint.body_a), view.velocity(joint.body_b));
    const Real tikhonov = tikhonov_of_speeds(view, j);
    return by_row(row_count(joint), [&](int i) {
      if (!own.is_active(i)) return Real(0);
      return -((of_row(speeds, i) - speed_met(view, j, i)) + tikhonov * own.cfm[i] * view.total(j)[i]);
    });
  });
  push_changes(team, system, mechanism);
}

}  // namespace plumb::impulse
