// What helpers share: vectors, and state in batches.
#pragma once

#include <span>
#include <string>

#include "plumb/backend/small_math.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::helpers {

using backend::add;
using backend::compose;
using backend::conjugate;
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

/// Part of v along the unit vector n taken away.
[[nodiscard]] constexpr PlumbVec3 without(const PlumbVec3& v, const PlumbVec3& n) {
  return sub(v, scale(dot(v, n), n));
}

/// v / |v|, or `otherwise` where v is 0.
[[nodiscard]] inline PlumbVec3 direction(const PlumbVec3& v, const PlumbVec3& otherwise) {
  const double size = length(v);
  return size > 1e-12 ? scale(1 / size, v) : otherwise;
}

/// Throws when a setting is not what it must be; `text` names it and the remedy.
inline void require(bool holds, const std::string& text) {
  if (!holds) throw Error(PLUMB_E_INVALID_ARGUMENT, text);
}

/// The extension, or Error that says which the helper misses.
template <class Extension>
Extension& require_extension(Extension* extension, const std::string& helper, const std::string& name,
                             const std::string& need) {
  if (extension == nullptr)
    throw Error(PLUMB_E_UNSUPPORTED, helper + " works by " + name + ", which this world lacks: declare " + need +
                                         ", or take another backend");
  return *extension;
}

struct Velocity {
  PlumbVec3 linear, angular;
};

template <class T>
void read_rows(IPhysicsWorld& world, PlumbField field, std::span<const PlumbBody> bodies, std::span<T> rows) {
  if (!bodies.empty()) check(world, world.read(field, bodies, rows_over(rows)));
}
template <class T>
void write_rows(IPhysicsWorld& world, PlumbField field, std::span<const PlumbBody> bodies, std::span<const T> rows) {
  if (!bodies.empty()) check(world, world.write(field, bodies, const_rows_over(rows)));
}
template <class T>
[[nodiscard]] T read_one(IPhysicsWorld& world, PlumbField field, PlumbBody body) {
  T row{};
  read_rows(world, field, std::span<const PlumbBody>(&body, 1), std::span<T>(&row, 1));
  return row;
}
template <class T>
void write_one(IPhysicsWorld& world, PlumbField field, PlumbBody body, const T& row) {
  write_rows(world, field, std::span<const PlumbBody>(&body, 1), std::span<const T>(&row, 1));
}

/// A row of PLUMB_FIELD_MASS.
struct MassRow {
  double mass;
  PlumbVec3 centre;
  PlumbVec3 inertia;
  PlumbQuat orientation;
};
[[nodiscard]] inline PlumbVec3 centre_of_mass(const PlumbPose& pose, const MassRow& mass) {
  return add(pose.position, rotate(pose.orientation, mass.centre));
}
/// A row of a force or impulse at a point.
struct AtPoint {
  PlumbVec3 value, point;
};

}  // namespace plumb::helpers
