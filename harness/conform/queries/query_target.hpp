// A body that stands still, of any shape, for queries: in a backend's world, and as the referee knows it.
#pragma once

#include <cmath>
#include <random>

#include "conform/probe.hpp"
#include "referee/penetration.hpp"

namespace plumb::harness::conform {

/// Every shape that can stand still.
inline constexpr PlumbShapeType kTargets[] = {PLUMB_SPHERE,   PLUMB_BOX,           PLUMB_CAPSULE,
                                              PLUMB_CYLINDER, PLUMB_CONVEX_HULL,   PLUMB_COMPOUND,
                                              PLUMB_PLANE,    PLUMB_TRIANGLE_MESH, PLUMB_HEIGHT_FIELD};

inline constexpr PlumbQuat kLevel = {0, 0, 0, 1};

/// Every shape that can ask.
inline constexpr PlumbShapeType kConvex[] = {PLUMB_SPHERE, PLUMB_BOX, PLUMB_CAPSULE, PLUMB_CYLINDER, PLUMB_CONVEX_HULL};
/// One of them, of about half a metre.
inline PlumbShapeDesc convex_desc(PlumbShapeType type) {
  static constexpr double kVertices[] = {-0.4, -0.3, -0.4, 0.4, -0.3, -0.4, 0, -0.3, 0.4, 0.1, 0.4, 0};
  PlumbShapeDesc desc = shape_desc(type);
  desc.radius = 0.3;
  desc.half_height = 0.25;
  desc.half_extents = {0.3, 0.2, 0.4};
  desc.vertices = kVertices;
  desc.vertex_count = 4;
  return desc;
}

template <class Random>
[[nodiscard]] PlumbQuat any_turn(Random& random) {
  std::normal_distribution<double> normal;
  const Eigen::Quaterniond q =
      Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
  return {q.x(), q.y(), q.z(), q.w()};
}

class Target {
 public:
  Target(Conformance& c, PlumbShapeType type)
      : probe(c, kQueryNeeds, Vec::Zero()),
        type_(type),
        has_cylinders_(c.backend().capability(PLUMB_CAP_SHAPE, PLUMB_CYLINDER, PLUMB_STATIC) != PLUMB_NONE) {
    PlumbBodyDesc desc = body_desc(PLUMB_STATIC);
    desc.material.friction = 0;
    desc.pose.position = {1, -2, 0.5};
    const Eigen::Quaterniond q(Eigen::AngleAxisd(0.4, Vec(1, 2, 3).normalized()));
    desc.pose.orientation = {q.x(), q.y(), q.z(), q.w()};
    pose_ = referee::pose(desc.pose);
    make_shape(desc.shape);
    shape = desc.shape;
    pose = desc.pose;
    body = probe.body(desc);
  }

  /// Above 0: apart.
  [[nodiscard]] double distance(const referee::Shape& other, const referee::Pose& there) const {
    return -referee::penetration(other, there, *shape_, pose_).depth;
  }
  /// The unit normal of the nearest part of the surface, at a place that is apart from it.
  [[nodiscard]] Vec normal_at(const Vec& place) const {
    return -referee::penetration(*point_, at(place), *shape_, pose_).normal;
  }
  [[nodiscard]] double distance(const Vec& place) const { return distance(*point_, at(place)) + point_->radius(); }
  [[nodiscard]] double distance_to_triangle(std::uint32_t triangle, const Vec& place) const {
    if (triangle >= triangles_.size()) return 1e9;
    return -referee::penetration(*point_, at(place), *triangles_[triangle], pose_).depth;
  }
  /// Of planes and height fields, before their front; of all others, outside. Engines differ on what they should see
  /// from elsewhere.
  [[nodiscard]] bool is_outside(const Vec& place) const {
    const Vec p = pose_.inverse() * place;
    if (type_ == PLUMB_PLANE) return p.y() > 0;
    if (type_ == PLUMB_HEIGHT_FIELD)
      return p.y() > kHighest || (std::abs(p.x()) < 1.6 && std::abs(p.z()) < 1.6 && normal_at(place).dot(up()) > 0.1);
    if (type_ == PLUMB_TRIANGLE_MESH) return p.cwiseAbs().maxCoeff() > 1;
    return distance(place) > 0;
  }
  /// Outside, and where the way to the target leads to its front.
  [[nodiscard]] bool is_before(const Vec& place) const {
    const Vec p = pose_.inverse() * place;
    return is_outside(place) && (type_ != PLUMB_HEIGHT_FIELD || (std::abs(p.x()) < 1.6 && std::abs(p.z()) < 1.6));
  }
  [[nodiscard]] bool is_surface() const { return type_ == PLUMB_TRIANGLE_MESH || type_ == PLUMB_HEIGHT_FIELD; }
  /// Whether the overlap of a body there is one that all engines must see: what is behind a surface may be none.
  [[nodiscard]] bool is_fit(const Vec& place) const {
    const bool solid = type_ != PLUMB_PLANE && type_ != PLUMB_TRIANGLE_MESH && type_ != PLUMB_HEIGHT_FIELD;
    return solid || is_outside(place);
  }
  template <class Random>
  [[nodiscard]] Vec place_about(Random& random, double spread) const {
    std::uniform_real_distribution<double> unit(-1, 1);
    return pose_ * Vec(spread * Vec(unit(random), unit(random), unit(random)));
  }
  [[nodiscard]] bool has_triangles() const { return type_ == PLUMB_TRIANGLE_MESH; }

  Probe probe;
  PlumbShape shape = 0;
  PlumbPose pose{};
  PlumbBody body = 0;

 private:
  static constexpr double kHighest = 0.6;

  [[nodiscard]] Vec up() const { return pose_.rotation.col(1); }
  [[nodiscard]] static referee::Pose at(const Vec& place) { return {referee::Mat3::Identity(), place}; }
  void make_shape(PlumbShape& id) {
    PlumbShapeDesc desc = shape_desc(type_);
    desc.radius = 0.7;
    desc.half_height = 0.8;
    desc.half_extents = {0.9, 0.6, 0.7};
    std::vector<double> vertices, heights;
    std::vector<std::uint32_t> indices;
    if (type_ == PLUMB_CONVEX_HULL) vertices = {-1, -1, -1, 1, -1, -1, 0, -1, 1, 0.2, 1, 0.1, 0.8, 0.5, 0.4};
    if (type_ == PLUMB_TRIANGLE_MESH) make_cube(vertices, indices);
    if (type_ == PLUMB_HEIGHT_FIELD) {
      for (int row = 0; row < 6; ++row)
        for (int column = 0; column < 7; ++column) heights.push_back(0.3 + 0.3 * std::sin(row) * std::cos(2 * column));
      desc.rows = 6;
      desc.columns = 7;
      desc.spacing = {0.6, 0, 0.7};
    }
    desc.vertices = vertices.data();
    desc.vertex_count = static_cast<std::uint32_t>(vertices.size() / 3);
    desc.indices = indices.data();
    desc.triangle_count = static_cast<std::uint32_t>(indices.size() / 3);
    desc.heights = heights.data();
    if (type_ == PLUMB_COMPOUND) return make_compound(desc, id);
    id = probe.shape(desc);
    shape_ = referee::Shape::make(desc);
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
      const std::uint32_t three[3] = {indices[i], indices[i + 1], indices[i + 2]};
      desc.indices = three;
      desc.triangle_count = 1;
      triangles_.push_back(referee::Shape::make(desc));
    }
  }
  /// A box and a cylinder, or what the engine has instead of one.
  void make_compound(PlumbShapeDesc desc, PlumbShape& id) {
    PlumbCompoundChild children[2] = {{}, {}};
    referee::ShapePtr known[2];
    for (int k = 0; k < 2; ++k) {
      PlumbShapeDesc child = shape_desc(k == 0 ? PLUMB_BOX : has_cylinders_ ? PLUMB_CYLINDER : PLUMB_SPHERE);
      child.radius = 0.5;
      child.half_height = 0.4;
      child.half_extents = {0.3, 0.9, 0.4};
      children[k] = {probe.shape(child), identity_pose(), 0, 0, {}};
      children[k].pose.position.x = k == 0 ? -0.6 : 0.5;
      known[k] = referee::Shape::make(child);
    }
    desc.children = children;
    desc.child_count = 2;
    id = probe.shape(desc);
    shape_ = referee::Shape::make(desc, known);
  }
  /// Of half edge 1; each side is 2 x 2 squares of two triangles.
  static void make_cube(std::vector<double>& vertices, std::vector<std::uint32_t>& indices) {
    constexpr std::uint32_t n = 2;
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {-1.0, 1.0}) {
        const auto first = static_cast<std::uint32_t>(vertices.size() / 3);
        for (std::uint32_t i = 0; i <= n; ++i)
          for (std::uint32_t k = 0; k <= n; ++k) {
            Vec p;
            p[axis] = sign;
            p[(axis + 1) % 3] = 2.0 * i / n - 1;
            p[(axis + 2) % 3] = 2.0 * k / n - 1;
            vertices.insert(vertices.end(), {p.x(), p.y(), p.z()});
          }
        for (std::uint32_t i = 0; i < n; ++i)
          for (std::uint32_t k = 0; k < n; ++k) {
            const std::uint32_t a = first + i * (n + 1) + k, b = a + n + 1, c = b + 1, d = a + 1;
            if (sign > 0)
              indices.insert(indices.end(), {a, b, c, a, c, d});
            else
              indices.insert(indices.end(), {a, c, b, a, d, c});
          }
      }
  }

  PlumbShapeType type_;
  bool has_cylinders_;
  referee::ShapePtr shape_, point_ = make_point();
  std::vector<referee::ShapePtr> triangles_;
  referee::Pose pose_;

  static referee::ShapePtr make_point() {
    PlumbShapeDesc desc = shape_desc(PLUMB_SPHERE);
    desc.radius = 1e-9;
    return referee::Shape::make(desc);
  }
};

}  // namespace plumb::harness::conform
