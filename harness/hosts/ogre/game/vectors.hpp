// What the game reckons with vectors and quaternions.
#pragma once

#include <cmath>

#include "plumb/physics_world.hpp"

namespace plumb::ogre {

[[nodiscard]] constexpr PlumbVec3 add(const PlumbVec3& a, const PlumbVec3& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
[[nodiscard]] constexpr PlumbVec3 sub(const PlumbVec3& a, const PlumbVec3& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[nodiscard]] constexpr PlumbVec3 scale(double s, const PlumbVec3& a) { return {s * a.x, s * a.y, s * a.z}; }
[[nodiscard]] constexpr double dot(const PlumbVec3& a, const PlumbVec3& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
[[nodiscard]] constexpr PlumbVec3 cross(const PlumbVec3& a, const PlumbVec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
[[nodiscard]] inline double length(const PlumbVec3& a) { return std::sqrt(dot(a, a)); }
[[nodiscard]] inline double distance(const PlumbVec3& a, const PlumbVec3& b) { return length(sub(a, b)); }

/// The way from a to b, but no further than `most`.
[[nodiscard]] inline PlumbVec3 towards(const PlumbVec3& a, const PlumbVec3& b, double most) {
  const PlumbVec3 way = sub(b, a);
  const double far = length(way);
  return far <= most ? way : scale(most / far, way);
}

[[nodiscard]] constexpr PlumbVec3 rotate(const PlumbQuat& q, const PlumbVec3& v) {
  const PlumbVec3 u{q.x, q.y, q.z};
  const PlumbVec3 t = scale(2, cross(u, v));
  return add(add(v, scale(q.w, t)), cross(u, t));
}
[[nodiscard]] constexpr PlumbVec3 to_world(const PlumbPose& pose, const PlumbVec3& local) {
  return add(pose.position, rotate(pose.orientation, local));
}
[[nodiscard]] constexpr PlumbVec3 to_local(const PlumbPose& pose, const PlumbVec3& world) {
  const PlumbQuat& q = pose.orientation;
  return rotate({-q.x, -q.y, -q.z, q.w}, sub(world, pose.position));
}

}  // namespace plumb::ogre
