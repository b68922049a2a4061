// From what a user asked to the cells of a study.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "run/cell.hpp"
#include "run/settings.hpp"
#include "run/sweep.hpp"
#include "run/worker_process.hpp"

namespace plumb::harness {

/// What a sweep is asked to turn, as typed; see Sweep.
struct SweepRequest {
  std::vector<std::string> over, along;
};

/// What `run`, `compare` and `curves` are asked.
struct StudyRequest {
  std::vector<std::string> scenes;
  std::vector<std::string> backends;              ///< names or files; empty: all that load
  std::vector<std::string> parameters, settings;  ///< as typed
  std::optional<SweepRequest> sweep;              ///< none: a cell a backend, with the settings above
  std::string profile = "default", needs = "scene";
  std::optional<double> dt, seconds;
  std::uint32_t threads = 1;
  std::uint32_t repeat = 1;
  double timeout = 300;
  double memory_limit_mb = 0;  ///< 0: three quarters of the machine's memory
  std::string out;             ///< folder; empty: none
  bool record = false;  ///< each cell once more than `repeat`, and that one to a file: no time or error comes from it
  bool layers = false;  ///< what plumb.debug/1 shows, too
  bool trace = false;   ///< times then include the writing of the trace

  [[nodiscard]] WorkerLimits limits() const;
};

/// Cells with the same scene and parameters, of all backends: what is repeated in turns.
struct CellBlock {
  std::vector<Cell> cells;
  std::vector<Ladder> ladders;  ///< of a sweep, by places in `cells`
};

/// Asks a worker of its own what a backend is; whatever goes wrong stands in the description.
[[nodiscard]] BackendDescription ask_description(const std::string& name, const std::string& file,
                                                 const WorkerLimits& limits);

/// The files of backends that were asked for by name or path, or all on the search path. Throws UsageError.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> backend_files(const std::vector<std::string>& asked);

struct Plan {
  std::vector<CellBlock> blocks;
  std::vector<BackendDescription> broken;  ///< not asked for by name, and they do not load
};

/// Throws UsageError for everything that is asked wrongly.
[[nodiscard]] Plan make_plan(const StudyRequest& request);

}  // namespace plumb::harness
