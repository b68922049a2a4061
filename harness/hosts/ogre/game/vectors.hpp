// What the game reckons with vectors and quaternions.
#pragma once

#include "plumb/backend/small_math.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::ogre {

using backend::add, backend::cross, backend::dot, backend::length, backend::rotate, backend::scale, backend::sub;

[[nodiscard]] inline double distance(const PlumbVec3& a, const PlumbVec3& b) { return length(sub(a, b)); }

/// The way from a to b, but no further than `most`.
[[nodiscard]] inline PlumbVec3 towards(const PlumbVec3& a, const PlumbVec3& b, double most) {
  const PlumbVec3 way = sub(b, a);
  const double far = length(way);
  return far <= most ? way : scale(most / far, way);
}

[[nodiscard]] constexpr PlumbVec3 to_world(const PlumbPose& pose, const PlumbVec3& local) {
  return add(pose.position, rotate(pose.orientation, local));
}
[[nodiscard]] constexpr PlumbVec3 to_local(const PlumbPose& pose, const PlumbVec3& world) {
  return backend::unrotate(pose.orientation, sub(world, pose.position));
}

}  // namespace plumb::ogre
