// A scene as the text of a scene file: plain numbers, no parameters.
#pragma once

#include "base/json.hpp"
#include "convert/imported.hpp"

namespace plumb::harness {

/// What the file says beside the scene.
struct SceneTitle {
  std::string id, slug, title, doc;
};

/// Without its measure and metrics, which the caller adds.
[[nodiscard]] Json scene_json(const Scene& scene, const SceneTitle& title);

/// Indented as the files in scenes/ are: what fits into a line stands in one.
[[nodiscard]] std::string scene_text(const Json& scene);

}  // namespace plumb::harness
