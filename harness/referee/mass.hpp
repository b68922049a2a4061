// Mass, centre of mass and inertia as the referee works them out, by another way than the backend side does.
#pragma once

#include <span>

#include "plumb/physics_world.hpp"
#include "referee/shape.hpp"

namespace plumb::referee {

struct Mass {
  double mass = 0;              ///< kg; 0: static or kinematic
  Vec3 centre = Vec3::Zero();   ///< m, body frame
  Mat3 inertia = Mat3::Zero();  ///< about the centre, in the body's axes, kg m2
};

/// Of a shape filled with `density` (kg/m3). Closed forms where they exist; hulls and closed meshes by the covariance
/// of their tetrahedra (Blow, Binstock 2004, "How to find the inertia tensor of a 3D solid body"). Throws plumb::Error
/// (PLUMB_E_INVALID_ARGUMENT) for what has no volume.
[[nodiscard]] Mass mass_of(const Shape& shape, double density);

/// Of a body as its descriptor asks (density, total, or explicit); shape may be null. Static and kinematic bodies: 0.
[[nodiscard]] Mass mass_of(const PlumbBodyDesc& body, const Shape* shape);

/// From a row of PLUMB_FIELD_MASS: mass, centre of mass, principal inertia, inertia orientation.
[[nodiscard]] Mass mass_of_row(std::span<const double, 11> row);

}  // namespace plumb::referee
