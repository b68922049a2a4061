// All scene files that the program can find, and how a user names them.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace plumb::harness {

/// Where scenes are looked for: $PLUMB_SCENES, the source tree's scenes/ in a build, the installed share/plumb/scenes.
[[nodiscard]] std::vector<std::filesystem::path> scene_directories();

/// All scenes, sorted by id (A1 A2 ... A10, B1). Throws UsageError when a file is broken.
[[nodiscard]] std::vector<SceneFile> all_scenes();

/// All that find_scenes takes but paths: ids, slugs and groups, from the files' names alone.
[[nodiscard]] std::vector<std::string> scene_words();

/// Scenes for what a user typed: an id ("D1"), slug ("tower"), "stacking/tower", a group ("stacking", "core", "all")
/// or a path to a file. Throws UsageError with the nearest right word.
[[nodiscard]] std::vector<SceneFile> find_scenes(const std::string& what);

}  // namespace plumb::harness
