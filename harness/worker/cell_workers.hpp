// The live workers of a run, one a backend, and what a cell's repetition costs and meets on this machine.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>

#include "cell/cell.hpp"
#include "rows/row.hpp"
#include "worker/contention.hpp"
#include "worker/worker_process.hpp"

namespace plumb::harness {

class CellWorkers {
 public:
  /// ranks: how many processes like this one time cells on this machine at once.
  explicit CellWorkers(unsigned ranks = 1) : ranks_(ranks) {}

  /// One repetition, with its wall time and contention in the answer. A broken backend answers by what is wrong with
  /// it; a worker that somebody killed is asked once more. Throws Interrupted, and UsageError for a scene that
  /// is wrong.
  Answer ask(const Cell& cell, const CellFiles& files, const WorkerLimits& limits,
             const std::function<void(const Progress&)>& tick);

 private:
  Answer ask_once(const Cell& cell, const CellFiles& files, const WorkerLimits& limits,
                  const std::function<void(const Progress&)>& tick);

  unsigned ranks_;
  LoadWatch watch_;
  double workers_time_ = 0;                                        ///< of processors, s, of all workers so far
  std::map<std::string, std::unique_ptr<WorkerProcess>> workers_;  ///< by file
};

/// "D1 H=10 bullet iterations=20": for people who watch.
[[nodiscard]] std::string label_of(const Cell& cell);

/// A file of the cell's own in the folder `kind` of a results folder, which is made.
[[nodiscard]] std::string cell_file(const std::filesystem::path& results, const Cell& cell, const char* kind,
                                    const char* suffix);

/// Where a cell's recording lies. A recording is a run of its own, of which only the trajectory is kept: looking costs
/// time, and some of what is looked at an engine must keep books for.
[[nodiscard]] std::string trajectory_of(const std::filesystem::path& results, const Cell& cell);
/// Whether a cell that came out as `row` is to be run once more for it: not when it would only fail again, nor when the
/// recording of a row of old is there.
[[nodiscard]] bool wants_recording(const std::filesystem::path& results, const Cell& cell, const Row& row, bool is_new);

}  // namespace plumb::harness
