// What a worker is asked for, as a scene and the options of its simulation; and how such work ended.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "base/json.hpp"
#include "scene/scene.hpp"
#include "simulation/simulation.hpp"

namespace plumb::harness {

/// The status of a cell whose scene turned out wrong only when it was made, which is no row but a wrong question.
inline constexpr const char* wrong_scene = "wrong_scene";

/// The request's "scene". Throws UsageError where the file is no longer the one whose "scene_hash" was asked for.
[[nodiscard]] SceneFile scene_file_of(const Json& request);
/// With its "parameters", "dt", "seconds" and "needs". Throws UsageError, and Error where it says that it lacks
/// something.
[[nodiscard]] Scene scene_of(const SceneFile& file, const Json& request);
/// Its "threads", "needs" and "settings".
[[nodiscard]] SimulationOptions options_of(const Backend& backend, const Json& request);

struct Outcome {
  std::string status = "ok", reason;
};

/// Runs the work and says how it ended: what an engine refuses or throws is an answer, not the end of a worker. file:
/// where what is refused is said; may be filled by the work.
[[nodiscard]] Outcome outcome_of(const std::optional<SceneFile>& file, const std::function<void()>& work);

}  // namespace plumb::harness
