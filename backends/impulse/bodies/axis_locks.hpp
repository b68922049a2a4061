// Axes of the world that a body neither moves along nor turns about.
#pragma once

#include "bodies/body.hpp"

namespace plumb::impulse {

/// Largest moment to the smallest, of bodies that do not tumble.
inline constexpr Real kMostSlender = 25;

/// What is left of a vector without its components along locked axes; first: the flag of x.
PLUMB_HD inline Vec unlocked(std::uint32_t flags, std::uint32_t first, const Vec& v) {
  return {(flags & first) != 0 ? Real(0) : v.x, (flags & first << 1) != 0 ? Real(0) : v.y,
          (flags & first << 2) != 0 ? Real(0) : v.z};
}

/// What is left of I^-1 when the turn about one axis is held: the Schur complement of that axis.
PLUMB_HD inline Sym hold_turn(const Sym& inverse, int axis) {
  const Vec unit = {axis == 0 ? Real(1) : Real(0), axis == 1 ? Real(1) : Real(0), axis == 2 ? Real(1) : Real(0)};
  const Vec column = inverse * unit;
  const Real own = dot(column, unit);
  if (!(own > 0)) return inverse;
  const Vec scaled = (Real(1) / own) * column;
  Sym held = {inverse.xx - column.x * scaled.x, inverse.yy - column.y * scaled.y, inverse.zz - column.z * scaled.z,
              inverse.xy - column.x * scaled.y, inverse.xz - column.x * scaled.z, inverse.yz - column.y * scaled.z};
  if (axis == 0) held.xx = held.xy = held.xz = 0;
  if (axis == 1) held.xy = held.yy = held.yz = 0;
  if (axis == 2) held.xz = held.yz = held.zz = 0;
  return held;
}
/// I^-1 in world axes of a body that does not turn about its locked ones, from inverse principal moments.
PLUMB_HD inline Sym world_inverse_inertia(const Quat& orientation, std::uint32_t flags, const Vec& inverse_moments) {
  Sym inverse = rotated_diagonal(to_matrix(orientation), inverse_moments);
  if ((flags & kBodyLocked) == 0) return inverse;
  for (int axis = 0; axis < 3; ++axis)
    if ((flags & kLockAngular << axis) != 0) inverse = hold_turn(inverse, axis);
  return inverse;
}
/// Inverse principal moments as constraints see them. Where bodies do not tumble, angular velocity is kept while the
/// moments turn with the body, and makes energy of what differs: no moment is then less than a share of the largest.
PLUMB_HD inline Vec inverse_moments(const BodyMass& mass, bool tumbles) {
  const Vec& inverse = mass.inverse_inertia;
  if (tumbles) return inverse;
  const Real most = max(max(mass.inertia.x, mass.inertia.y), mass.inertia.z);
  if (!(most > 0)) return inverse;
  const Real bound = kMostSlender / most;
  return {min(inverse.x, bound), min(inverse.y, bound), min(inverse.z, bound)};
}
PLUMB_HD inline Sym world_inverse_inertia(const Quat& orientation, const BodyMass& mass) {
  return world_inverse_inertia(orientation, mass.flags, mass.inverse_inertia);
}

}  // namespace plumb::impulse
