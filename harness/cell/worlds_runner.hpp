// One scene in many worlds that are stepped together, run in a worker: what a step of all costs, and whether each world
// comes to what it comes to alone.
#pragma once

#include "base/json.hpp"
#include "cell/progress.hpp"
#include "plumb/loader.hpp"

namespace plumb::harness {

/// request: as run_cell's without files, and "count": worlds, "over": threads over which they are spread, 0: as many as
/// there are processors. The answer has "status", "reason", "count", "over", "bodies" (of a world), "steps", "setup_ms"
/// and "step_ms" (of all worlds; of a step the median over the second half of the run), "differ": worlds whose state
/// ends in other bits than that of one alone, "hash" (of that one) and "peak_mb". Throws nothing.
[[nodiscard]] Json run_worlds(Backend& backend, const Json& request, Progress& progress);

}  // namespace plumb::harness
