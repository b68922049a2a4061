// What a scene holds that works on it or stores energy: whether its mechanical energy and momentum account for the
// engine.
#pragma once

#include "scene/scene.hpp"

namespace plumb::harness {

struct SceneNature {
  bool driven = false;      ///< host forces, motors, kinematic bodies, moving surfaces
  bool stores = false;      ///< springs
  bool dissipates = false;  ///< collisions, damping, limits
  bool closed = true;       ///< nothing outside pushes: momentum is kept
};

[[nodiscard]] SceneNature nature_of(const Scene& scene);

}  // namespace plumb::harness
