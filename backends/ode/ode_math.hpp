// Poses and vectors between the wall's plain values and ODE's arrays, in double on both sides.
#pragma once

#include <ode/ode.h>

#include "plumb/backend/small_math.hpp"

namespace plumb::ode {

using backend::add;
using backend::compose;
using backend::conjugate;
using backend::cross;
using backend::dot;
using backend::inverse;
using backend::length;
using backend::Matrix3;
using backend::multiply;
using backend::normalized;
using backend::rotate;
using backend::rotation_vector;
using backend::scale;
using backend::sub;
using backend::unrotate;

[[nodiscard]] inline PlumbVec3 vec(const dReal* v) { return {v[0], v[1], v[2]}; }
[[nodiscard]] inline bool is_zero(const PlumbVec3& v) { return v.x == 0 && v.y == 0 && v.z == 0; }

/// ODE keeps w first.
[[nodiscard]] inline PlumbQuat quat(const dReal* q) { return {q[1], q[2], q[3], q[0]}; }

struct OdeQuaternion {
  explicit OdeQuaternion(const PlumbQuat& q) : wxyz{q.w, q.x, q.y, q.z} {}
  dQuaternion wxyz;
};

}  // namespace plumb::ode
