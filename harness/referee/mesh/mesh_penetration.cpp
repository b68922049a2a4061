#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "plumb/assert.hpp"
#include "referee/convex_distance.hpp"
#include "referee/convex_penetration.hpp"
#include "referee/expanding_polytope.hpp"
#include "referee/mesh/way_out.hpp"

namespace plumb::referee {

namespace {

// One triangle and a convex shape that cuts it or that it is near to, in the mesh's frame.
class TrianglePair {
 public:
  TrianglePair(const Shape::Triangle& triangle, const std::array<Vec3, 3>& neighbours, const Shape& convex,
               const Pose& pose)
      : triangle_(triangle_polytope(triangle)),
        neighbours_(neighbours),
        convex_(convex),
        pose_(pose),
        front_(triangle_.faces[0].normal) {}

  Penetration run() {
    const ConvexView view_triangle{nullptr, &triangle_, Pose{}}, view_convex{&convex_, nullptr, pose_};
    const ConvexDistance near = convex_distance(view_triangle, view_convex);
    const double radius = convex_.rounding();
    if (near.distance > 0) {
      const Vec3 normal = (near.on_b - near.on_a) / near.distance;
      if (near.distance >= radius || lets_go(normal))
        return {radius - near.distance, normal, (near.on_a + near.on_b - radius * normal) / 2};
    }
    offer(front_);
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 edge = triangle_.corners[(i + 1) % 3] - triangle_.corners[i];
      offer(edge.cross(front_));
      for (const Vec3& other : edge_directions()) {
        offer(edge.cross(other));
        offer(other.cross(edge));
      }
    }
    if (convex_.type() == PLUMB_CYLINDER) {
      offer(pose_.rotation.col(1));
      offer(-pose_.rotation.col(1));
      offer(expanding_polytope(view_triangle, view_convex).normal);
    } else {
      for (const Polytope::Face& face : convex_.core().faces) offer(-(pose_.rotation * face.normal));
    }
    const Vec3 deepest = pose_ * convex_.support(-(pose_.rotation.transpose() * best_normal_));
    return {best_depth_, best_normal_, deepest + best_depth_ / 2 * best_normal_};
  }

 private:
  // Whether the mesh lets go along a direction: not through the back, and over an edge no further than the surface
  // turns away there. So over an edge within flat ground, or in a valley, only the front counts.
  [[nodiscard]] bool lets_go(const Vec3& direction) const {
    constexpr double rounding = 1e-9;
    const double up = direction.dot(front_);
    if (up < -rounding) return false;
    for (std::size_t i = 0; i < 3; ++i) {
      if (neighbours_[i].isZero()) continue;
      const Vec3 beyond = (triangle_.corners[(i + 1) % 3] - triangle_.corners[i]).cross(front_).normalized();
      const double over = direction.dot(beyond);
      if (over <= rounding) continue;
      const double turns = neighbours_[i].dot(beyond);  // above 0: the edge is a ridge
      if (turns <= rounding || up * turns - over * neighbours_[i].dot(front_) < -rounding) return false;
    }
    return true;
  }

  // The translation of the convex shape along a direction that takes it off the triangle, if the mesh lets go.
  void offer(const Vec3& direction) {
    const double length = direction.norm();
    if (!(length > 1e-12 * triangle_.radius)) return;
    const Vec3 normal = direction / length;
    if (!lets_go(normal)) return;
    PLUMB_ASSERT(std::abs(normal.squaredNorm() - 1) < 1e-9);
    const double reach = triangle_.corners[triangle_.support(normal)].dot(normal);
    const double depth = reach - (pose_ * convex_.support(-(pose_.rotation.transpose() * normal))).dot(normal);
    if (depth < best_depth_) best_depth_ = depth, best_normal_ = normal;
  }

  [[nodiscard]] std::vector<Vec3> edge_directions() const {
    std::vector<Vec3> directions;
    if (convex_.type() == PLUMB_CYLINDER) directions.push_back(pose_.rotation.col(1));
    if (convex_.type() == PLUMB_BOX) {
      for (int i = 0; i < 3; ++i) directions.push_back(pose_.rotation.col(i));
    } else {
      for (const Polytope::Edge& edge : convex_.core().edges)
        directions.push_back(pose_.rotation * (convex_.core().corners[edge.to] - convex_.core().corners[edge.from]));
    }
    return directions;
  }

  Polytope triangle_;
  const std::array<Vec3, 3>& neighbours_;
  const Shape& convex_;
  const Pose& pose_;
  Vec3 front_;
  double best_depth_ = infinity;
  Vec3 best_normal_ = Vec3::UnitY();
};

/// Of a surface that is neither a ridge nor a valley where it is cut, a triangle may not let go in the direction in
/// which the whole does: there is a shorter way out than the deepest triangle's. Looked for where it matters only, for
/// it costs as much as a hundred triangles.
void find_shorter_way(const Shape& mesh, const Shape& convex, const Pose& pose, const std::vector<std::size_t>& cut,
                      std::vector<Vec3> directions, Penetration& deepest) {
  constexpr std::size_t most_faces = 32;
  if (convex.has_core() && convex.core().faces.size() <= most_faces)
    for (const Polytope::Face& face : convex.core().faces) directions.push_back(-(pose.rotation * face.normal));
  const WayOut out(mesh, convex, pose, cut);
  for (const Vec3& direction : directions) {
    const std::optional<double> way = out.along(direction, deepest.depth);
    if (!way) continue;
    const Vec3 lowest = pose * convex.support(-(pose.rotation.transpose() * direction));
    deepest = {*way, direction, lowest + *way / 2 * direction};
  }
}

double box_distance(const Aabb& a, const Aabb& b) {
  return (a.low - b.high).cwiseMax(b.low - a.high).cwiseMax(0.0).norm();
}

}  // namespace

Penetration mesh_penetration(const Shape& mesh, const Shape& convex, const Pose& pose_convex, Apart apart) {
  const Aabb bounds = convex.bounds(pose_convex);
  PLUMB_ASSERT(mesh.triangle_bounds().size() == mesh.triangles().size());
  PLUMB_ASSERT(mesh.neighbour_normals().size() == mesh.triangles().size());
  Penetration deepest{-infinity, Vec3::UnitY(), pose_convex.position};
  std::vector<std::size_t> cut;
  std::vector<Vec3> directions;
  for (std::size_t i = 0; i < mesh.triangles().size(); ++i) {
    const double at_least = box_distance(mesh.triangle_bounds()[i], bounds);
    if (at_least > 0 && apart == Apart::lower_bound) {
      if (-at_least > deepest.depth) deepest.depth = -at_least;
      continue;
    }
    if (at_least > 0 && -at_least < deepest.depth) continue;
    const Penetration one = TrianglePair(mesh.triangles()[i], mesh.neighbour_normals()[i], convex, pose_convex).run();
    if (one.depth > 0) {
      cut.push_back(i);
      directions.push_back(one.normal);
      directions.push_back(front_of(mesh.triangles()[i]).normalized());
    }
    if (one.depth > deepest.depth) deepest = one;
  }
  constexpr double worth_a_look = 1e-3;  // of the size
  if (cut.size() > 1 && deepest.depth > worth_a_look * (bounds.high - bounds.low).norm())
    find_shorter_way(mesh, convex, pose_convex, cut, std::move(directions), deepest);
  return deepest;
}

}  // namespace plumb::referee
