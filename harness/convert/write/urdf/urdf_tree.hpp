// The bodies of a scene as the tree of links that URDF knows.
#pragma once

#include <optional>
#include <vector>

#include "convert/imported.hpp"

namespace plumb::harness {

/// A body with the joint by which its parent holds it; of the root none, nor of what stands, which the world holds.
struct UrdfLink {
  std::size_t body;
  std::optional<std::size_t> parent, joint;
  bool forward = true;  ///< the parent is the joint's body a
};

struct UrdfTree {
  bool in_world = false;        ///< the world is the root, and holds what has no parent
  std::vector<UrdfLink> links;  ///< parents first
};

/// What stands is part of it where it holds something. Throws UsageError for bodies that are in no tree with the
/// others, and joints that close a loop or hold a kinematic body; what stands apart becomes remarks.
[[nodiscard]] UrdfTree urdf_tree(const Scene& scene, Remarks& remarks);

}  // namespace plumb::harness
