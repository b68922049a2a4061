// From a study file to its cells: what is run, in which order, and what is compared with what.
//
// Cells have stages, so that a study that runs out of time has seen everything a little: 0 every scene as it is on
// every backend (with the needs that are compared with it), 1 other steps, methods, seeds, profiles, threads and the
// far end of each ladder, 2 the ladders' other rungs, 3 points that were put between others. Within a stage batches of
// cells that are to be compared come in an order shuffled from the study's seed.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "schedule/plan.hpp"
#include "study/study_file.hpp"

namespace plumb::harness {

constexpr int refined_stage = 3;

struct PlannedCell {
  Cell cell;
  std::string id;  ///< cell_id(cell)
  int stage = 0;
  std::string batch;  ///< cells of equal batch and stage are repeated in turns
  Repetitions repetitions;
  bool record = false;
  /// Two cells of a ladder, far apart: where both end in the same state the knob does nothing, and this need not run.
  std::optional<std::pair<std::string, std::string>> unless_same;
};

/// Cells that differ in one number only, by its value.
struct StudyLadder {
  std::string knob;  ///< of the backend, or "dt"
  std::vector<std::size_t> cells;
  std::size_t added = 0;  ///< of them by refinement
};

struct StudyPlan {
  std::vector<PlannedCell> cells;
  std::vector<std::vector<std::size_t>> batches;  ///< in the order in which they are run
  std::vector<StudyLadder> ladders;               ///< that may be refined
  std::vector<BackendDescription> broken;         ///< not asked for by name, and they do not load
  std::map<std::string, std::size_t> places;      ///< of cells, by id

  /// The place of the cell, which is added when it is not there; else the earlier stage and the more repetitions hold.
  std::size_t add(PlannedCell cell);
};

/// The value of a ladder's number in a cell.
[[nodiscard]] double knob_value(const Cell& cell, const std::string& knob);
/// The cell with another value of it; whole-numbered settings get the nearest.
[[nodiscard]] Cell with_knob(Cell cell, const std::string& knob, double value);

/// Asks the backends and makes the cells. fixed: every rung is run, and `at_least` times. Throws UsageError.
[[nodiscard]] StudyPlan plan_study(const StudyFile& study, bool fixed);

}  // namespace plumb::harness
