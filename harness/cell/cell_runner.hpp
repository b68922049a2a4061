// One cell, run in a worker: the scene's measure on the opened backend, and everything that stands in its row.
#pragma once

#include "base/json.hpp"
#include "cell/progress.hpp"
#include "plumb/loader.hpp"

namespace plumb::harness {

/// request: {"scene": path, "scene_hash", "parameters", "settings", "dt", "seconds", "threads", "needs",
/// "trajectory", "trace" and "timeline": path or "", "layers"}. The answer has "status", "reason", "metrics",
/// "settings" (in force), "step_ms" (of the window), "window", "steps", "setup_ms", "phase_ms", "counts", "hash" and
/// "peak_mb". Throws nothing.
[[nodiscard]] Json run_cell(Backend& backend, const Json& request, Progress& progress);

}  // namespace plumb::harness
