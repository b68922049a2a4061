// A study: the cells of a plan, run by workers, each finished one handed on and written down at once.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "rows/results_file.hpp"
#include "rows/row.hpp"
#include "study/plan.hpp"

namespace plumb::harness {

/// How far it is, for a progress bar.
struct StudyProgress {
  std::size_t cells_done, cells_total;
  std::string cell;                    ///< "D1 H=10 bullet 2/3": what is being run
  std::uint64_t step, steps;           ///< of it
  std::optional<double> seconds_left;  ///< of wall time until the end, where that can be told
};

struct StudyCallbacks {
  std::function<void(const Row& row, bool is_new)> finished;  ///< in the order in which cells finish
  std::function<void(const StudyProgress&)> progress;         ///< may be empty
};

/// Cells whose row `results` (may be null) has already are not run again, and those that another process is running in
/// the same folder are waited for. Repetitions of a block alternate between its
/// backends' live workers in an order shuffled anew each round from a fixed seed; never are two cells run at a time.
/// Of a ladder the base and the probe come first: where both end in the same state, or the base is unsupported, the
/// ladder's other cells are left out.
/// Throws Interrupted, with all finished cells written.
void run_study(const Plan& plan, const StudyRequest& request, ResultsFile* results, const StudyCallbacks& callbacks);

}  // namespace plumb::harness
