// From what a user asked of `run`, `compare` or `curves` to cells.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cell/cell.hpp"
#include "cell/settings.hpp"
#include "cell/sweep.hpp"
#include "worker/backends.hpp"

namespace plumb::harness {

/// What a sweep is asked to turn, as typed; see Sweep.
struct SweepRequest {
  std::vector<std::string> over, along;
};

/// What `run`, `compare` and `curves` are asked.
struct RunRequest {
  std::vector<std::string> scenes;
  std::vector<std::string> backends;              ///< names or files; empty: all that load
  std::vector<std::string> parameters, settings;  ///< as typed
  bool own_variants = true;                       ///< false: one cell of the parameters, not the scene's variants
  std::optional<SweepRequest> sweep;              ///< none: a cell a backend, with the settings above
  std::string profile = "default", needs = "scene";
  std::optional<double> dt, seconds;
  std::uint32_t threads = 1;
  std::uint32_t repeat = 1;
  double timeout = 300;                 ///< of an engine
  std::optional<double> judge_timeout;  ///< of the referee; none: that of the engine, and at least a minute
  double memory_limit_mb = 0;           ///< 0: three quarters of the machine's memory
  std::string out;                      ///< folder; empty: none
  bool record = false;    ///< each cell once more than `repeat`, and that one to a file: no time or error comes from it
  bool layers = false;    ///< what plumb.debug/1 shows, too
  bool trace = false;     ///< times then include the writing of the trace
  bool timeline = false;  ///< and of the timeline

  [[nodiscard]] WorkerLimits limits() const;
};

/// Needs as a user names them: "scene", "all", or "scene" and more needs, "scene+sleeping". Throws UsageError, with the
/// nearest right word, after `option`.
void check_needs(const std::string& option, const std::string& needs);

/// Cells with the same scene and parameters, of all backends: what is repeated in turns.
struct CellBlock {
  std::vector<Cell> cells;
  std::vector<Ladder> ladders;  ///< of a sweep, by places in `cells`
};

struct Plan {
  std::vector<CellBlock> blocks;
  std::vector<BackendDescription> broken;  ///< not asked for by name, and they do not load
};

/// The blocks of a request on these backends, whatever it says of backends itself. Throws UsageError for everything
/// that is asked wrongly.
[[nodiscard]] std::vector<CellBlock> plan_blocks(const RunRequest& request, const std::vector<BuiltBackend>& backends);

/// Throws UsageError for everything that is asked wrongly.
[[nodiscard]] Plan make_plan(const RunRequest& request);

}  // namespace plumb::harness
