// The shape of a body as a URDF link's collisions.
#pragma once

#include "convert/write/urdf/urdf_output.hpp"

namespace plumb::harness {

/// pose: of the body's frame in the link's. A capsule is a cylinder and two spheres; planes become remarks.
void write_urdf_collisions(UrdfOutput& out, const SceneBody& body, const referee::Pose& pose);

}  // namespace plumb::harness
