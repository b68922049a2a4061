// Joints of scenes as URDF knows them.
#pragma once

#include <optional>

#include "convert/write/urdf/urdf_output.hpp"

namespace plumb::harness {

/// "revolute", "continuous", "prismatic" or "fixed", and which axis of the scene's joint, 0 to 5, it lets go.
struct UrdfKind {
  const char* word;
  std::optional<std::size_t> axis;
};

/// Throws UsageError for a joint that lets go of more, or of a distance.
[[nodiscard]] UrdfKind urdf_kind(const SceneJoint& joint);

/// Axis, limits, damping and friction, within <joint>, whose frame is the scene joint's on the child. forward: the
/// parent is body a. effort: the most that its motor gives, N or N m; infinite where none is said.
void write_urdf_axis(UrdfOutput& out, const SceneJoint& joint, bool forward, double effort);

}  // namespace plumb::harness
