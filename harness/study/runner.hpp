// Runs a study: batch after batch, cell by cell claimed, repeated until its time is known well enough, and written down
// at once; alone or as one of several processes in the same results folder.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "schedule/bench.hpp"
#include "study/study_plan.hpp"

namespace plumb::harness {

struct StudyOutcome {
  std::size_t known = 0;                 ///< cells that were finished already
  std::size_t run = 0;                   ///< cells that this process finished
  std::size_t elsewhere = 0;             ///< cells that other processes have finished since, or still have
  std::size_t idle = 0;                  ///< rungs left out because their knob does nothing there
  std::size_t refined = 0;               ///< cells that were put between others
  std::vector<std::string> out_of_time;  ///< cells, by their labels, that the budget did not reach
};

/// Refined cells are added to the plan. fixed: nothing depends on what was measured, so that every number of ranks and
/// every restart runs the same cells equally often. Throws Interrupted, with all finished cells written.
[[nodiscard]] StudyOutcome run_study_plan(StudyPlan& plan, const StudyFile& study, bool fixed, const Ranks& ranks,
                                          ResultsFile& results, const RunCallbacks& callbacks);

}  // namespace plumb::harness
