// One shape of every kind, about a metre across, for tours of pairs.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace plumb::harness {

struct KindOfShape {
  std::string name;
  std::vector<SceneShape> shapes;  ///< the last is the shape; those before are a compound's children
  bool moves = true;               ///< whether engines let it move
  double reach = 0.5;              ///< m: about how far it extends from its origin
};

[[nodiscard]] std::vector<KindOfShape> kinds_of_shapes();

}  // namespace plumb::harness
