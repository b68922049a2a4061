// A scene with plain numbers, as JSON, and what can be taken out of it.
#pragma once

#include <string>
#include <vector>

#include "base/json.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// The scene as a file without parameters, with its measure and metrics. Its id has an r behind it.
[[nodiscard]] Json plain_scene(const Scene& scene, const SceneFile& file);

/// What can be taken out, one kind after the other: quantities that are measured; bodies with all that is theirs;
/// joints; then what the host does, limits, motors and springs, velocities, restitution, and all else that is usual
/// when it is not said. Pointers into the JSON.
[[nodiscard]] std::vector<std::vector<Json::json_pointer>> parts_of(const Json& scene);

/// The scene without these, and without what speaks of bodies and joints that are gone: joints, actions, quantities and
/// their metrics, shapes of nobody.
[[nodiscard]] Json without(const Json& scene, const std::vector<Json::json_pointer>& parts);

/// "3 bodies, 1 joint, 0.5 s".
[[nodiscard]] std::string size_text(const Json& scene);

}  // namespace plumb::harness
