// Which joints are links of MuJoCo's trees, and who is whose child.
#pragma once

#include <memory>
#include <vector>

#include "joints/joint.hpp"

namespace plumb::mujoco {

/// Bodies in the order in which MuJoCo numbers them: each before its children, and these right after it.
struct Tree {
  std::vector<Body*> order;
  std::vector<std::vector<Body*>> children;  ///< by slot
  std::vector<Body*> roots;                  ///< children of the world
};

/// Sets the links of bodies and joints. Joints that could not close a loop become links first, else in the order of
/// creation. Throws Error (PLUMB_E_UNSUPPORTED) where one of them would have to close one; nothing is changed then.
[[nodiscard]] Tree grow_tree(const std::vector<std::unique_ptr<Body>>& bodies,
                             const std::vector<std::unique_ptr<Joint>>& joints);

}  // namespace plumb::mujoco
