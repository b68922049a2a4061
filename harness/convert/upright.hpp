// Robots' files have z up, scenes y; their cylinders and capsules lie along z, those of scenes along y.
#pragma once

#include "plumb/shapes.h"
#include "referee/pose.hpp"

namespace plumb::harness {

/// A world of z up as one of y up: x stays, z becomes y.
[[nodiscard]] inline referee::Pose upright() {
  return {(referee::Mat3() << 1, 0, 0, 0, 0, 1, 0, -1, 0).finished(), referee::Vec3::Zero()};
}

/// The frame of a shape along y within that of one along z.
[[nodiscard]] inline referee::Pose along_z() { return upright().inverse(); }

/// Whether along_z() tells such a shape's frame in a scene from that of a robot's file.
[[nodiscard]] inline bool lies_along_y(PlumbShapeType type) {
  return type == PLUMB_CAPSULE || type == PLUMB_CYLINDER || type == PLUMB_PLANE;
}

[[nodiscard]] inline PlumbPose plain(const referee::Pose& pose) {
  const referee::Quat q(pose.rotation);
  return {referee::plain(pose.position), {q.x(), q.y(), q.z(), q.w()}};
}

}  // namespace plumb::harness
