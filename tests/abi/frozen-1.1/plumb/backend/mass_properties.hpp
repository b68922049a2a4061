// Mass properties of shapes, worked out once for all engines, for a density of 1 kg/m3.
#pragma once

#include <span>

#include "plumb/backend/small_math.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::backend {

struct MassProperties {
  double mass;                    ///< kg
  PlumbVec3 centre_of_mass;       ///< m, shape frame
  PlumbVec3 inertia;              ///< principal moments about the centre of mass, kg m2
  PlumbQuat inertia_orientation;  ///< from principal axes to the shape frame
  double volume;                  ///< m3
};

struct Principal {
  PlumbVec3 moments;
  PlumbQuat orientation;  ///< from principal axes to the tensor's frame
};

/// Eigenvalues and vectors of a symmetric matrix by cyclic Jacobi rotations (Golub, Van Loan, 4th ed., 8.5).
/// Off-diagonal elements below 1e-14 of the largest diagonal one are rounding and taken as 0, so a tensor that is
/// diagonal already keeps its order and gets the identity exactly; else axes stay as near to the frame's as the
/// rotations allow.
[[nodiscard]] Principal principal_axes(Matrix3 a);

/// R diag(moments) R^T: the inertia tensor about the centre of mass in the frame that the principal axes are given in.
[[nodiscard]] Matrix3 inertia_tensor(const PlumbVec3& moments, const PlumbQuat& orientation);

/// What the inertia about a point grows by when a mass is moved to d from it (parallel axes): m (d.d 1 - d d^T).
[[nodiscard]] Matrix3 parallel_axis(double mass, const PlumbVec3& d);

/// The same body of another density or total mass.
[[nodiscard]] inline MassProperties with_density(MassProperties unit, double density) {
  unit.mass *= density;
  unit.inertia = scale(density, unit.inertia);
  return unit;
}
[[nodiscard]] inline MassProperties with_mass(const MassProperties& unit, double mass) {
  return with_density(unit, mass / unit.mass);
}

/// Of a shape filled with 1 kg/m3. desc must be in range (sizes above 0, indices below vertex_count, finite).
/// children_properties: of a compound's children in their order; else not looked at. Where children overlap, their
/// masses add up. Throws Error (PLUMB_E_INVALID_ARGUMENT) for what has no volume: planes, height fields, open or
/// inside-out meshes, flat hulls.
[[nodiscard]] MassProperties unit_mass_properties(const PlumbShapeDesc& desc,
                                                  std::span<const MassProperties> children_properties = {});

}  // namespace plumb::backend
