#include "hosts/gazebo/world/geometry.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace plumb::gazebo {
namespace {

constexpr double kPi = std::numbers::pi;

/// On circles of latitude, poles included: enough that the hull's surface is within 1 % of the ellipsoid's.
std::vector<double> points_on(const Vector& radii) {
  constexpr int kCircles = 15, kPoints = 24;
  std::vector<double> points = {0, 0, radii.Z(), 0, 0, -radii.Z()};
  for (int circle = 1; circle <= kCircles; ++circle)
    for (int point = 0; point < kPoints; ++point) {
      const double polar = kPi * circle / (kCircles + 1), around = 2 * kPi * point / kPoints;
      points.insert(points.end(), {radii.X() * std::sin(polar) * std::cos(around),
                                   radii.Y() * std::sin(polar) * std::sin(around), radii.Z() * std::cos(polar)});
    }
  return points;
}

bool positive(double value) { return std::isfinite(value) && value > 0; }

Geometry round(Form form, double radius, double length) {
  Geometry geometry;
  geometry.form = form;
  geometry.radius = radius;
  geometry.length = length;
  return geometry;
}

Geometry wide(Form form, const Vector& size) {
  Geometry geometry;
  geometry.form = form;
  geometry.size = size;
  return geometry;
}

}  // namespace

Geometry box_of(const Vector& edges) { return wide(Form::box, edges); }
Geometry sphere_of(double radius) { return round(Form::sphere, radius, 0); }
Geometry cylinder_of(double radius, double length) { return round(Form::cylinder, radius, length); }
Geometry capsule_of(double radius, double length) { return round(Form::capsule, radius, length); }
Geometry ellipsoid_of(const Vector& radii) { return wide(Form::ellipsoid, radii); }
Geometry plane_of(const Vector& normal) { return wide(Form::plane, normal); }

std::string fault_of(const Geometry& geometry) {
  const Vector& size = geometry.size;
  switch (geometry.form) {
    case Form::box:
    case Form::ellipsoid:
      for (const double edge : {size.X(), size.Y(), size.Z()})
        if (!positive(edge)) return "its size has a component of " + std::to_string(edge) + "; all must be above 0 m";
      return "";
    case Form::plane:
      if (!size.IsFinite() || size.Length() < 1e-9) return "its normal is not finite or 0; give it a direction";
      return "";
    case Form::mesh:
      for (const double value : geometry.vertices)
        if (!std::isfinite(value)) return "its mesh has a vertex that is not finite; mend the file";
      if (geometry.vertices.size() < 12 || geometry.indices.size() < 3)
        return "its mesh has no triangles; only submeshes of triangles count";
      return "";
    case Form::cylinder:
      if (!positive(geometry.length))
        return "its length is " + std::to_string(geometry.length) + "; it must be above 0 m";
      break;
    case Form::capsule:
      if (!std::isfinite(geometry.length) || geometry.length < 0)
        return "its length is " + std::to_string(geometry.length) + "; it must not be below 0 m";
      break;
    case Form::sphere: break;
  }
  return positive(geometry.radius) ? "" : "its radius is " + std::to_string(geometry.radius) + "; it must be above 0 m";
}

Rotation turn_of(const Geometry& geometry) {
  Rotation turn = Rotation::Identity;
  if (geometry.form == Form::cylinder || geometry.form == Form::capsule) turn.From2Axes(Vector::UnitY, Vector::UnitZ);
  if (geometry.form == Form::plane) turn.From2Axes(Vector::UnitY, geometry.size);
  return turn;
}

PlumbShapeType type_of(const Geometry& geometry, PlumbMotion motion) {
  switch (geometry.form) {
    case Form::box: return PLUMB_BOX;
    case Form::sphere: return PLUMB_SPHERE;
    case Form::cylinder: return PLUMB_CYLINDER;
    case Form::capsule: return PLUMB_CAPSULE;
    case Form::ellipsoid: return PLUMB_CONVEX_HULL;
    case Form::plane: return PLUMB_PLANE;
    case Form::mesh: break;
  }
  return motion == PLUMB_STATIC ? PLUMB_TRIANGLE_MESH : PLUMB_CONVEX_HULL;
}

PlumbShapeDesc describe(const Geometry& geometry, PlumbMotion motion, std::vector<double>& points) {
  PlumbShapeDesc desc = shape_desc(type_of(geometry, motion));
  desc.radius = geometry.radius;
  desc.half_height = geometry.length / 2;
  desc.half_extents = to_plumb(geometry.size / 2);
  if (geometry.form == Form::ellipsoid) points = points_on(geometry.size);
  const std::vector<double>& vertices = geometry.form == Form::ellipsoid ? points : geometry.vertices;
  desc.vertices = vertices.data();
  desc.vertex_count = static_cast<std::uint32_t>(vertices.size() / 3);
  desc.indices = geometry.indices.data();
  desc.triangle_count = static_cast<std::uint32_t>(geometry.indices.size() / 3);
  return desc;
}

ignition::math::AxisAlignedBox bounds_of(const Geometry& geometry) {
  const auto around = [](const Vector& half) { return ignition::math::AxisAlignedBox(-half, half); };
  switch (geometry.form) {
    case Form::box: return around(geometry.size / 2);
    case Form::ellipsoid: return around(geometry.size);
    case Form::sphere: return around(Vector(geometry.radius, geometry.radius, geometry.radius));
    case Form::cylinder: return around({geometry.radius, geometry.radius, geometry.length / 2});
    case Form::capsule: return around({geometry.radius, geometry.radius, geometry.length / 2 + geometry.radius});
    case Form::plane: {
      constexpr double kFar = std::numeric_limits<double>::infinity();
      return around({kFar, kFar, kFar});
    }
    case Form::mesh: break;
  }
  ignition::math::AxisAlignedBox box;
  const std::vector<double>& at = geometry.vertices;
  for (std::size_t i = 0; i + 2 < at.size(); i += 3) {
    const Vector vertex(at[i], at[i + 1], at[i + 2]);
    box.Merge(ignition::math::AxisAlignedBox(vertex, vertex));
  }
  return box;
}

}  // namespace plumb::gazebo
