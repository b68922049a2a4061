// Scenes as a page runs them itself.
#pragma once

#include "base/json.hpp"
#include "report/page/parts/page_options.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// about: "title" and "params", as in a trajectory's header. settings: asked for, by name. Throws UsageError where
/// this machine lacks what the scene needs.
[[nodiscard]] PageWorld page_world(const Scene& scene, const Json& about, const Json& settings);

/// Of recordings by their headers, with the engine; nothing where there is no engine at hand. A scene that is not
/// found, or is another one by now, is left out.
[[nodiscard]] PageWorlds worlds_of_recordings(const std::vector<Json>& headers);

}  // namespace plumb::harness
