// From what the repetitions of a cell answered to its row.
#pragma once

#include <vector>

#include "cell/cell.hpp"
#include "rows/row.hpp"
#include "worker/worker_process.hpp"

namespace plumb::harness {

/// From the answers of all repetitions of a cell (at least one). Times are over the windows of all that ran to their
/// end; status and metrics are those of the worst. Differing hashes show as the metric "determinism".
/// Repetitions on a busy machine do not count for times where there are calm ones; where there are none the row is
/// "contended". "restarted" counts those whose worker somebody killed and that were run once more. "knobs" names the
/// settings of the role "quality", "defaults" has the engine's own values of settings off them.
[[nodiscard]] Row make_row(const Cell& cell, const std::vector<Answer>& answers, const Json& machine);

/// The median ms per step of each repetition that counts for times and ran to its end.
[[nodiscard]] std::vector<double> medians_of_runs(const std::vector<Answer>& answers);

}  // namespace plumb::harness
