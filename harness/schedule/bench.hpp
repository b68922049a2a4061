// The bench on which cells are repeated, whoever says which and how often: claims, live workers, progress, rows.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "rows/results_file.hpp"
#include "schedule/claims.hpp"
#include "schedule/ranks.hpp"
#include "worker/cell_workers.hpp"

namespace plumb::harness {

/// How far it is, for a progress bar.
struct RunProgress {
  std::size_t cells_done, cells_total;
  std::string cell;                    ///< "D1 H=10 bullet 2/3": what is being run
  std::uint64_t step, steps;           ///< of it
  std::optional<double> seconds_left;  ///< of wall time until the end, where that can be told
};

struct RunCallbacks {
  std::function<void(const Row& row, bool is_new)> finished;  ///< in the order in which cells finish
  std::function<void(const RunProgress&)> progress;           ///< may be empty
};

class Bench {
 public:
  /// results: where rows are written down and cells are claimed; null: nowhere.
  Bench(ResultsFile* results, const Ranks& ranks, const RunCallbacks& callbacks);

  /// False when another process has the cell.
  [[nodiscard]] bool take(const std::string& cell_id);
  void give_back(const std::string& cell_id);

  /// One repetition, whose progress is told: `progress` says what is known beside the steps. Throws Interrupted.
  Answer repeat(const Cell& cell, const CellFiles& files, const WorkerLimits& limits, RunProgress progress,
                const std::function<std::optional<double>()>& seconds_left = {});
  /// Likewise, untold.
  Answer repeat_quietly(const Cell& cell, const CellFiles& files, const WorkerLimits& limits) {
    return workers_.ask(cell, files, limits, {});
  }

  [[nodiscard]] Row row_of(const Cell& cell, const std::vector<Answer>& answers) const;

 private:
  std::optional<Claims> claims_;  ///< where there are results
  const RunCallbacks& callbacks_;
  Json machine_;
  CellWorkers workers_;
};

/// "D1 H=10 bullet 2/3"; without the numbers where there is one repetition only.
[[nodiscard]] std::string label_of_repetition(const Cell& cell, std::uint32_t round, std::uint32_t rounds);

/// A worker was killed by somebody, twice: the cell has no result, and the next start runs it again.
[[nodiscard]] bool was_killed(const std::vector<Answer>& answers);

}  // namespace plumb::harness
