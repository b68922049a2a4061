// The joints by which a body moves against its parent.
#pragma once

#include "convert/builder.hpp"
#include "convert/mjcf/mjcf_types.hpp"

namespace plumb::harness {

struct MjcfEnds {
  std::optional<std::size_t> parent;  ///< none: the world
  std::size_t child;
};

/// All joints of the body become one, from where they are at the start. A body that is free gets none.
void add_joints(const mjModel& model, const mjData& start, int body, const MjcfEnds& ends, Imported& imported);

/// What closes loops: connect and weld. poses: of all bodies in the scene's world; bodies: their indices in the scene.
void add_equalities(const mjModel& model, const std::vector<referee::Pose>& poses,
                    const std::vector<std::optional<std::size_t>>& bodies, Imported& imported);

}  // namespace plumb::harness
