// Shapes, poses and random numbers that the tests of the referee share.
#pragma once

#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "plumb/physics_world.hpp"
#include "referee/penetration.hpp"

namespace plumb::referee::testing {

inline ShapePtr sphere(double radius) {
  PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
  desc.radius = radius;
  return Shape::make(desc);
}
inline ShapePtr box(double x, double y, double z) {
  PlumbShapeDesc desc = shape_desc(PLUMB_BOX);
  desc.half_extents = {x, y, z};
  return Shape::make(desc);
}
inline ShapePtr round_bar(PlumbShapeType type, double radius, double half_height) {
  PlumbShapeDesc desc = shape_desc(type);
  desc.radius = radius;
  desc.half_height = half_height;
  return Shape::make(desc);
}
inline ShapePtr capsule(double radius, double half_height) { return round_bar(PLUMB_CAPSULE, radius, half_height); }
inline ShapePtr cylinder(double radius, double half_height) { return round_bar(PLUMB_CYLINDER, radius, half_height); }
inline ShapePtr plane() { return Shape::make(shape_desc(PLUMB_PLANE)); }

inline PlumbShapeDesc hull_desc(const std::vector<double>& vertices) {
  PlumbShapeDesc desc = shape_desc(PLUMB_CONVEX_HULL);
  desc.vertices = vertices.data();
  desc.vertex_count = static_cast<std::uint32_t>(vertices.size() / 3);
  return desc;
}
inline ShapePtr hull(const std::vector<double>& vertices) { return Shape::make(hull_desc(vertices)); }

inline PlumbShapeDesc mesh_desc(const std::vector<double>& vertices, const std::vector<std::uint32_t>& indices) {
  PlumbShapeDesc desc = shape_desc(PLUMB_TRIANGLE_MESH);
  desc.vertices = vertices.data();
  desc.vertex_count = static_cast<std::uint32_t>(vertices.size() / 3);
  desc.indices = indices.data();
  desc.triangle_count = static_cast<std::uint32_t>(indices.size() / 3);
  return desc;
}

/// The eight corners of a box, xyz triples.
inline std::vector<double> box_corners(double x, double y, double z) {
  std::vector<double> corners;
  for (int i = 0; i < 8; ++i) {
    corners.push_back(i & 1 ? x : -x);
    corners.push_back(i & 2 ? y : -y);
    corners.push_back(i & 4 ? z : -z);
  }
  return corners;
}

inline Pose at(double x, double y, double z) { return {Mat3::Identity(), {x, y, z}}; }
inline Pose turned(double degrees, const Vec3& axis, const Vec3& position = Vec3::Zero()) {
  return {Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis.normalized()).toRotationMatrix(), position};
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double in(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 vector(double reach) { return {in(-reach, reach), in(-reach, reach), in(-reach, reach)}; }
  Vec3 direction() {
    std::normal_distribution<double> normal;
    return Vec3(normal(engine_), normal(engine_), normal(engine_)).normalized();
  }
  Pose pose(double reach) {
    std::normal_distribution<double> normal;
    const Quat turn = Quat(normal(engine_), normal(engine_), normal(engine_), normal(engine_)).normalized();
    return {turn.toRotationMatrix(), vector(reach)};
  }
  /// The hull of 4 to 24 points.
  ShapePtr hull() {
    std::vector<double> points;
    const int count = 3 * std::uniform_int_distribution<int>(4, 24)(engine_);
    for (int i = 0; i < count; ++i) points.push_back(in(-0.7, 0.7));
    return testing::hull(points);
  }
  ShapePtr box() { return testing::box(in(0.1, 0.8), in(0.1, 0.8), in(0.1, 0.8)); }
  /// Any convex shape of about half a metre.
  ShapePtr convex() {
    switch (std::uniform_int_distribution<int>(0, 4)(engine_)) {
      case 0: return sphere(in(0.2, 0.8));
      case 1: return box();
      case 2: return capsule(in(0.1, 0.5), in(0.1, 0.6));
      case 3: return cylinder(in(0.1, 0.7), in(0.1, 0.7));
      default: return hull();
    }
  }

 private:
  std::mt19937_64 engine_;
};

/// How far b must move along a direction to clear a, by support functions alone: never less than the depth.
inline double overlap_along(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                            const Vec3& direction) {
  const Vec3 top = pose_a * a.support(pose_a.rotation.transpose() * direction);
  const Vec3 bottom = pose_b * b.support(pose_b.rotation.transpose() * -direction);
  return (top - bottom).dot(direction);
}

}  // namespace plumb::referee::testing
