// A trajectory as binary glTF 2.0 (Khronos Group, ISO/IEC 12113:2022): opens in browsers, Blender and game engines.
#pragma once

#include <string>

#include "record/trajectory.hpp"

namespace plumb::harness {

/// One node a body, with its name, and the children of a compound as nodes below it; below both bodies of a joint (at
/// the root where that is the world) a ball at its anchor, named after the joint, with its type and largest gap (m) as
/// extras; one mesh a shape and colour; one animation that moves those that move, linear between frames. Poses that are
/// not finite are as they were last.
[[nodiscard]] std::string binary_gltf(const Trajectory& trajectory);

}  // namespace plumb::harness
