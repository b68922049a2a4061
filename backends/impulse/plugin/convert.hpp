// Between the interface's numbers and the engine's.
#pragma once

#include <cmath>
#include <type_traits>

#include "math/quat.hpp"
#include "plumb/plumb.h"

namespace plumb::impulse {

inline Vec to_vec(const PlumbVec3& v) {
  return {static_cast<Real>(v.x), static_cast<Real>(v.y), static_cast<Real>(v.z)};
}
inline Vec to_vec(const double* v) { return to_vec(PlumbVec3{v[0], v[1], v[2]}); }
inline PlumbVec3 plumb_vec(const Position& p) { return {p.x, p.y, p.z}; }
inline PlumbVec3 to_plumb(const Vec& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline Position to_position(const PlumbVec3& v) { return {v.x, v.y, v.z}; }

using QuatD = Quat4<double>;
inline QuatD to_double(const PlumbQuat& q) { return {q.x, q.y, q.z, q.w}; }
inline QuatD to_double(const Quat& q) {
  return {static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z), static_cast<double>(q.w)};
}
inline Quat to_quat(const QuatD& q) {
  return {static_cast<Real>(q.x), static_cast<Real>(q.y), static_cast<Real>(q.z), static_cast<Real>(q.w)};
}

/// The constant angular velocity that turns `from` into `to` in dt seconds the shorter way, world axes.
inline Vec angular_velocity_between(const PlumbQuat& from, const PlumbQuat& to, double dt) {
  QuatD turn = to_double(to) * conjugate(to_double(from));
  if (turn.w < 0) turn = {-turn.x, -turn.y, -turn.z, -turn.w};
  const double sine = std::sqrt(turn.x * turn.x + turn.y * turn.y + turn.z * turn.z);
  const double rate = sine > 0 ? 2 * std::atan2(sine, turn.w) / (sine * dt) : 2 / dt;
  return to_vec(PlumbVec3{rate * turn.x, rate * turn.y, rate * turn.z});
}

}  // namespace plumb::impulse
