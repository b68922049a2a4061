// Runs the blocks of a plan, as `run`, `compare` and `curves` do: each cell as often as was asked, its row handed on
// and written down at once.
//
// Not what a study does (study/runner): here every cell is repeated as often as was asked and rows come in the order of
// the plan, for people who wait for a table; there a budget and the spread of the times decide, and other processes'
// cells are left to them. What both do to a cell is the bench's.
#pragma once

#include "schedule/bench.hpp"
#include "schedule/plan.hpp"

namespace plumb::harness {

/// Cells whose row `results` (may be null) has already are not run again, and those that another process is running in
/// the same folder are waited for. Repetitions of a block alternate between its
/// backends' live workers in an order shuffled anew each round from a fixed seed; never are two cells run at a time.
/// Of a ladder the base and the probe come first: where both end in the same state, or the base is unsupported, the
/// ladder's other cells are left out.
/// Throws Interrupted, with all finished cells written.
void run_blocks(const Plan& plan, const RunRequest& request, ResultsFile* results, const RunCallbacks& callbacks);

}  // namespace plumb::harness
