#include "referee/contact_patch.hpp"

#include <algorithm>
#include <cmath>

#include "plumb/assert.hpp"

namespace plumb::referee {
namespace {

using Vec2 = Eigen::Vector2d;

double cross(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// A plane across the normal, in which features are compared.
struct Across {
  Vec3 normal, x, y;

  explicit Across(const Vec3& n) : normal(n), x(n.unitOrthogonal()), y(n.cross(x)) {}
  [[nodiscard]] Vec2 of(const Vec3& p) const { return {x.dot(p), y.dot(p)}; }
};

/// Corners counter-clockwise; one or two of a point or an edge. Andrew's monotone chain.
std::vector<Vec2> hull_of(std::vector<Vec2> points, double size) {
  std::sort(points.begin(), points.end(),
            [](const Vec2& a, const Vec2& b) { return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y(); });
  std::vector<Vec2> hull;
  const auto add_chain = [&](const auto& order, std::size_t least) {
    for (const Vec2& p : order) {
      if (!hull.empty() && (p - hull.back()).norm() <= 1e-9 * size) continue;
      while (hull.size() > least &&
             cross(hull[hull.size() - 1] - hull[hull.size() - 2], p - hull.back()) <= 1e-9 * size * size)
        hull.pop_back();
      hull.push_back(p);
    }
  };
  add_chain(points, 1);
  const std::size_t lower = hull.size();
  std::reverse(points.begin(), points.end());
  add_chain(points, lower);
  if (hull.size() > 1 && (hull.back() - hull.front()).norm() <= 1e-9 * size) hull.pop_back();
  return hull;
}

/// The part of a polygon, edge or point that is on the left of the line through `from` and `to`.
std::vector<Vec2> clipped(const std::vector<Vec2>& polygon, const Vec2& from, const Vec2& to, double slack) {
  const Vec2 along = (to - from).normalized();
  const auto side = [&](const Vec2& p) { return cross(along, p - from); };
  std::vector<Vec2> inside;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &p = polygon[i], &next = polygon[(i + 1) % polygon.size()];
    const double here = side(p), there = side(next);
    if (here >= -slack) inside.push_back(p);
    const bool crosses = (here > slack && there < -slack) || (here < -slack && there > slack);
    if (crosses && (polygon.size() > 2 || i == 0)) inside.push_back(p + here / (here - there) * (next - p));
  }
  return inside;
}

/// Common part of two edges: of parallel ones the overlap.
std::vector<Vec2> common_edge(const std::vector<Vec2>& a, const std::vector<Vec2>& b, double size) {
  const Vec2 along = (a[1] - a[0]).normalized(), other = (b[1] - b[0]).normalized();
  if (std::abs(cross(along, other)) > 1e-3 || std::abs(cross(along, b[0] - a[0])) > 1e-3 * size) return {};
  const auto at = [&](const Vec2& p) { return along.dot(p - a[0]); };
  const auto [low, high] = std::minmax({at(b[0]), at(b[1])});
  const double from = std::max(0.0, low), to = std::min(at(a[1]), high);
  if (from > to) return {};
  return {a[0] + from * along, a[0] + to * along};
}

struct Feature {
  std::vector<Vec2> outline;
  Vec3 on, normal;  ///< the plane in which it lies

  /// Along the direction of `across`, at a place in it.
  [[nodiscard]] double height(const Across& across, const Vec2& place) const {
    const Vec3 flat = place.x() * across.x + place.y() * across.y;
    return normal.dot(on - flat) / normal.dot(across.normal);
  }
};

/// What a core has furthest along a direction. facing: that of its surface.
Feature feature_of(const Polytope& core, const Pose& pose, const Vec3& facing, const Across& across, double flat) {
  PLUMB_ASSERT(!core.corners.empty());
  const Vec3 local = pose.rotation.transpose() * facing;
  double furthest = -INFINITY;
  for (const Vec3& corner : core.corners) furthest = std::max(furthest, local.dot(corner));
  std::vector<Vec2> points;
  std::vector<Vec3> corners;
  for (const Vec3& corner : core.corners) {
    if (local.dot(corner) < furthest - flat) continue;
    corners.push_back(pose * corner);
    points.push_back(across.of(corners.back()));
  }
  Feature feature{hull_of(points, std::max(core.radius, 1e-12)), corners.front(), facing};
  if (feature.outline.size() == 2) {
    const Vec3 edge = corners.back() - corners.front();
    feature.normal = (facing - facing.dot(edge) / edge.squaredNorm() * edge).normalized();
  } else if (feature.outline.size() > 2) {
    const auto best = std::max_element(core.faces.begin(), core.faces.end(), [&](const auto& a, const auto& b) {
      return a.normal.dot(local) < b.normal.dot(local);
    });
    feature.normal = pose.rotation * best->normal;
    feature.on = pose * (best->offset * best->normal);
  }
  return feature;
}

/// The normal of a face where it is all but that: nearest points that all but coincide give few digits.
Vec3 snapped(const Vec3& normal, const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b) {
  constexpr double same = 1e-5;
  const auto face_near = [](const Polytope& core, const Pose& pose, const Vec3& direction) -> Vec3 {
    for (const Polytope::Face& face : core.faces)
      if (core.solid && (pose.rotation * face.normal - direction).norm() < same) return pose.rotation * face.normal;
    return Vec3::Zero();
  };
  if (const Vec3 face = face_near(a.core(), pose_a, normal); !face.isZero()) return face;
  if (const Vec3 face = face_near(b.core(), pose_b, -normal); !face.isZero()) return -face;
  return normal;
}

void add_convex(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, double flat, double reach,
                std::vector<PatchPoint>& patch) {
  const Penetration found = penetration(a, pose_a, b, pose_b);
  if (!(found.depth >= -reach)) return;
  const Vec3 normal = snapped(found.normal, a, pose_a, b, pose_b);
  PLUMB_ASSERT(std::abs(normal.squaredNorm() - 1) < 1e-6);
  const Across across(normal);
  const Feature on_a = feature_of(a.core(), pose_a, normal, across, flat);
  const Feature on_b = feature_of(b.core(), pose_b, -normal, across, flat);
  const double size = std::min(a.core().radius + a.rounding(), b.core().radius + b.rounding());
  std::vector<Vec2> common;
  const bool a_smaller = on_a.outline.size() <= on_b.outline.size();
  const Feature &small = a_smaller ? on_a : on_b, &large = a_smaller ? on_b : on_a;
  if (large.outline.size() == 2 && small.outline.size() == 2) {
    common = common_edge(small.outline, large.outline, size);
  } else if (small.outline.size() > 1) {
    common = small.outline;
    for (std::size_t i = 0; i < large.outline.size() && !common.empty(); ++i)
      common = clipped(common, large.outline[i], large.outline[(i + 1) % large.outline.size()], 1e-9 * size);
    common = common.empty() ? common : hull_of(common, size);
  }
  if (common.size() < 2) {  // a point touches, or edges cross
    patch.push_back({found.point, normal, -found.depth});
    return;
  }
  for (const Vec2& place : common) {
    const double low = on_a.height(across, place) + a.rounding(), high = on_b.height(across, place) - b.rounding();
    patch.push_back({place.x() * across.x + place.y() * across.y + (low + high) / 2 * normal, normal, high - low});
  }
}

}  // namespace

bool has_patches(const Shape& shape) {
  if (shape.type() != PLUMB_COMPOUND) return shape.has_core();
  return std::all_of(shape.children().begin(), shape.children().end(),
                     [](const Shape::Child& child) { return has_patches(*child.shape); });
}

std::vector<PatchPoint> contact_patch(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b,
                                      double flat, double reach) {
  if (!has_patches(a) || !has_patches(b))
    throw Error(PLUMB_E_UNSUPPORTED,
                "contact points of planes, cylinders, meshes and height fields are not worked out");
  std::vector<PatchPoint> patch;
  const auto each_child = [](const Shape& shape, const Pose& pose, const auto& visit) {
    if (shape.type() != PLUMB_COMPOUND) return visit(shape, pose);
    for (const Shape::Child& child : shape.children()) visit(*child.shape, pose * child.pose);
  };
  each_child(a, pose_a, [&](const Shape& part_a, const Pose& at_a) {
    each_child(b, pose_b, [&](const Shape& part_b, const Pose& at_b) {
      add_convex(part_a, at_a, part_b, at_b, flat, reach, patch);
    });
  });
  return patch;
}

}  // namespace plumb::referee
