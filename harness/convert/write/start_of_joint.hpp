// What a coordinate of a joint is at the start: files for other programs call that 0.
#pragma once

#include <cmath>

#include "referee/pose.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// The joint's frame on body a, or in the world, at the start.
[[nodiscard]] inline referee::Pose frame_on_a(const Scene& scene, const SceneJoint& joint) {
  const referee::Pose a = joint.body_a ? referee::pose(scene.bodies[*joint.body_a].desc.pose) : referee::Pose{};
  return a * referee::pose(joint.desc.frame_a);
}
[[nodiscard]] inline referee::Pose frame_on_b(const Scene& scene, const SceneJoint& joint) {
  return referee::pose(scene.bodies[joint.body_b].desc.pose) * referee::pose(joint.desc.frame_b);
}

/// axis: 0 to 2 m along, 3 to 5 rad about x, y and z; angles where the joint has no other beside, or is a universal
/// one.
[[nodiscard]] inline double start_of_joint(const Scene& scene, const SceneJoint& joint, std::size_t axis) {
  const referee::Pose moved = frame_on_b(scene, joint).seen_from(frame_on_a(scene, joint));
  if (axis < 3) return moved.position[static_cast<int>(axis)];
  const referee::Mat3& r = moved.rotation;
  if (axis == 3) return std::atan2(r(2, 1) - r(1, 2), r(1, 1) + r(2, 2));
  return axis == 4 ? std::atan2(r(0, 2), r(2, 2)) : std::atan2(r(1, 0), r(0, 0));
}

}  // namespace plumb::harness
