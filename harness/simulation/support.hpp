// What a scene uses that a backend may lack: asked of the capabilities before anything is built.
#pragma once

#include <string>

#include "plumb/loader.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// The needs that the backend has in any degree.
[[nodiscard]] PlumbNeeds needs_of(const Backend& backend);

/// What the backend lacks for the scene, first thing first, in words with the backend's own note; "" when it has all:
/// needs, shapes with their motions, joints with the features used, and pairs of shapes that the scene's filters and
/// motions let touch. That the two will ever meet is not known, so a pair counts only where each type's motion is
/// given.
[[nodiscard]] std::string missing_support(const Backend& backend, const Scene& scene);

}  // namespace plumb::harness
