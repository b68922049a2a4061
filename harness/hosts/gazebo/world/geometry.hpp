// The form of a collision as Gazebo says it, and as Plumb takes it.
#pragma once

#include <cstdint>
#include <ignition/math/AxisAlignedBox.hh>
#include <vector>

#include "hosts/gazebo/world/transform.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::gazebo {

enum class Form { box, sphere, cylinder, capsule, ellipsoid, plane, mesh };

struct Geometry {
  Form form = Form::box;
  Vector size;                         ///< box: edges; ellipsoid: radii; plane: normal; mesh: scale
  double radius = 0;                   ///< sphere, cylinder, capsule
  double length = 0;                   ///< cylinder, capsule: along z, of a capsule without its caps
  std::vector<double> vertices;        ///< mesh, scaled; xyz triples
  std::vector<std::uint32_t> indices;  ///< mesh
};

[[nodiscard]] Geometry box_of(const Vector& edges);
[[nodiscard]] Geometry sphere_of(double radius);
[[nodiscard]] Geometry cylinder_of(double radius, double length);
[[nodiscard]] Geometry capsule_of(double radius, double length);
[[nodiscard]] Geometry ellipsoid_of(const Vector& radii);
[[nodiscard]] Geometry plane_of(const Vector& normal);

/// "" where Plumb can take it; else what is wrong with which number.
[[nodiscard]] std::string fault_of(const Geometry& geometry);

/// Axes are along y in Plumb and along z here: how Plumb's frame lies in Gazebo's.
[[nodiscard]] Rotation turn_of(const Geometry& geometry);

/// A mesh that moves is its convex hull, and an ellipsoid is one of points on its surface.
[[nodiscard]] PlumbShapeType type_of(const Geometry& geometry, PlumbMotion motion);
/// Points into geometry and into points, which it fills for an ellipsoid.
[[nodiscard]] PlumbShapeDesc describe(const Geometry& geometry, PlumbMotion motion, std::vector<double>& points);

/// In Gazebo's frame of the shape. A plane fills all of space.
[[nodiscard]] ignition::math::AxisAlignedBox bounds_of(const Geometry& geometry);

}  // namespace plumb::gazebo
