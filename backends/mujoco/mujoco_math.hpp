// Values of the wall as MuJoCo's and back. MuJoCo's quaternions begin with w.
#pragma once

#include <mujoco/mujoco.h>

#include <algorithm>

#include "plumb/backend/small_math.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::mujoco {

using backend::add;
using backend::compose;
using backend::cross;
using backend::dot;
using backend::inverse;
using backend::length;
using backend::multiply;
using backend::normalized;
using backend::rotate;
using backend::scale;
using backend::sub;
using backend::unrotate;

inline PlumbVec3 vec(const mjtNum* v) { return {v[0], v[1], v[2]}; }
inline PlumbQuat quat(const mjtNum* q) { return {q[1], q[2], q[3], q[0]}; }
inline void put(const PlumbVec3& v, mjtNum* to) {
  to[0] = v.x;
  to[1] = v.y;
  to[2] = v.z;
}
inline void put(const PlumbQuat& q, mjtNum* to) {
  to[0] = q.w;
  put(PlumbVec3{q.x, q.y, q.z}, to + 1);
}
inline PlumbPose pose_of(const double* row) { return {{row[0], row[1], row[2]}, {row[3], row[4], row[5], row[6]}}; }
inline PlumbVec3 point_of(const PlumbPose& pose, const PlumbVec3& local) {
  return add(pose.position, rotate(pose.orientation, local));
}
/// Unit vector along x, y or z.
constexpr PlumbVec3 unit(std::size_t axis) { return {axis == 0 ? 1.0 : 0, axis == 1 ? 1.0 : 0, axis == 2 ? 1.0 : 0}; }

/// MuJoCo's planes and height fields look along z, ours along y; its capsules and cylinders stand along z.
inline constexpr PlumbQuat kZToY{-0.70710678118654752440, 0, 0, 0.70710678118654752440};

}  // namespace plumb::mujoco
