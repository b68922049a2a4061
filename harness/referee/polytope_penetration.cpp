#include "referee/polytope_penetration.hpp"

#include <cmath>

#include "referee/convex_distance.hpp"

namespace plumb::referee {

namespace {

// An edge pair must beat the faces by this much of the size: parallel faces and edges tie but for rounding.
constexpr double edge_handicap = 1e-12;
constexpr double parallel = 1e-10;  // sine of the angle of edges that span no plane

// Mean of the corners furthest along a direction: of a face that lies flat its middle.
Vec3 furthest_feature(const std::vector<Vec3>& corners, const Vec3& direction, double tolerance) {
  double reach = -infinity;
  for (const Vec3& corner : corners) reach = std::max(reach, corner.dot(direction));
  Vec3 sum = Vec3::Zero();
  double count = 0;
  for (const Vec3& corner : corners)
    if (corner.dot(direction) >= reach - tolerance) sum += corner, count += 1;
  return sum / count;
}

struct Axis {
  double separation = -infinity;  ///< of b from a along normal
  Vec3 normal = Vec3::UnitY();
};

class PolytopePair {
 public:
  PolytopePair(const Polytope& a, const Polytope& b, const Pose& pose_b) : a_(a), pose_(pose_b), b_(b) {
    for (const Vec3& corner : b.corners) corners_b_.push_back(pose_b * corner);
    size_ = a.radius + b.radius;
  }

  Penetration run() {
    for (const Polytope::Face& face : a_.faces) offer(lowest_b(face.normal) - face.offset, face.normal, 0);
    const double of_a = best_.separation;
    for (const Polytope::Face& face : b_.faces) {
      const Vec3 normal = -(pose_.rotation * face.normal);
      offer(-face.offset + normal.dot(pose_.position) - highest_a(normal), normal, 0);
    }
    const bool by_b = best_.separation > of_a;
    const Axis by_face = best_;
    if (a_.solid && b_.solid)
      mapped_edges();
    else
      all_edges();

    Vec3 middle;
    if (best_.separation > by_face.separation && has_edges_) {
      middle = edge_middle_;
    } else if (by_b) {
      middle = furthest_feature(a_.corners, best_.normal, 1e-9 * size_) + best_.separation / 2 * best_.normal;
    } else {
      middle = furthest_feature(corners_b_, -best_.normal, 1e-9 * size_) - best_.separation / 2 * best_.normal;
    }
    return {-best_.separation, best_.normal, middle};
  }

 private:
  [[nodiscard]] double lowest_b(const Vec3& normal) const {
    double low = infinity;
    for (const Vec3& corner : corners_b_) low = std::min(low, corner.dot(normal));
    return low;
  }
  [[nodiscard]] double highest_a(const Vec3& normal) const { return a_.corners[a_.support(normal)].dot(normal); }

  bool offer(double separation, const Vec3& normal, double handicap) {
    if (!(separation > best_.separation + handicap)) return false;
    best_ = {separation, normal};
    return true;
  }

  void keep_middle(const Polytope::Edge& edge_a, const Polytope::Edge& edge_b) {
    const Vec3 &p = a_.corners[edge_a.from], &q = corners_b_[edge_b.from];
    const ConvexDistance near = segment_distance(p, a_.corners[edge_a.to] - p, q, corners_b_[edge_b.to] - q);
    edge_middle_ = (near.on_a + near.on_b) / 2;
    has_edges_ = true;
  }

  // Two edges make a face of the difference when the arcs between their faces' normals cross on the unit sphere.
  void mapped_edges() {
    for (const Polytope::Edge& edge_b : b_.edges) {
      const Vec3 c = -(pose_.rotation * edge_b.normal_left), d = -(pose_.rotation * edge_b.normal_right);
      const Vec3 from_b = corners_b_[edge_b.from], along_b = corners_b_[edge_b.to] - from_b, dxc = d.cross(c);
      for (const Polytope::Edge& edge_a : a_.edges) {
        const Vec3 &a = edge_a.normal_left, &b = edge_a.normal_right;
        const double adc = a.dot(dxc), bdc = b.dot(dxc);
        if (adc * bdc >= 0) continue;
        const Vec3 bxa = b.cross(a);
        const double cba = c.dot(bxa), dba = d.dot(bxa);
        if (cba * dba >= 0 || cba * bdc <= 0) continue;
        const Vec3 from_a = a_.corners[edge_a.from], along_a = a_.corners[edge_a.to] - from_a;
        Vec3 normal = along_a.cross(along_b);
        const double length = normal.norm();
        if (length <= parallel * along_a.norm() * along_b.norm()) continue;
        normal /= normal.dot(from_a - a_.centre) < 0 ? -length : length;
        if (offer(normal.dot(from_b - from_a), normal, edge_handicap * size_)) keep_middle(edge_a, edge_b);
      }
    }
  }

  void all_edges() {
    for (const Polytope::Edge& edge_a : a_.edges)
      for (const Polytope::Edge& edge_b : b_.edges) {
        const Vec3 along_a = a_.corners[edge_a.to] - a_.corners[edge_a.from];
        const Vec3 along_b = corners_b_[edge_b.to] - corners_b_[edge_b.from];
        Vec3 normal = along_a.cross(along_b);
        const double length = normal.norm();
        if (length <= parallel * along_a.norm() * along_b.norm()) continue;
        normal /= length;
        for (const Vec3& side : {normal, Vec3(-normal)})
          if (offer(lowest_b(side) - highest_a(side), side, edge_handicap * size_)) keep_middle(edge_a, edge_b);
      }
  }

  const Polytope& a_;
  const Pose& pose_;
  const Polytope& b_;
  std::vector<Vec3> corners_b_;
  Axis best_;
  Vec3 edge_middle_ = Vec3::Zero();
  bool has_edges_ = false;
  double size_ = 0;
};

}  // namespace

Penetration polytope_penetration(const Polytope& a, const Polytope& b, const Pose& pose_b) {
  return PolytopePair(a, b, pose_b).run();
}

Penetration box_penetration(const Vec3& half_a, const Vec3& half_b, const Pose& pose_b) {
  const Mat3& r = pose_b.rotation;
  const Mat3 absolute = r.cwiseAbs();
  const Vec3& t = pose_b.position;
  double best = -infinity;
  int axis = -1;
  const Vec3 beyond_a = t.cwiseAbs() - half_a - absolute * half_b;
  const Vec3 in_b = r.transpose() * t;
  const Vec3 beyond_b = in_b.cwiseAbs() - half_b - absolute.transpose() * half_a;
  for (int i = 0; i < 3; ++i)
    if (beyond_a[i] > best) best = beyond_a[i], axis = i;
  for (int i = 0; i < 3; ++i)
    if (beyond_b[i] > best) best = beyond_b[i], axis = 3 + i;
  const double handicap = edge_handicap * (half_a.norm() + half_b.norm());
  for (int i = 0; i < 3; ++i) {
    const int i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (int j = 0; j < 3; ++j) {
      const double length = std::hypot(r(i1, j), r(i2, j));  // of e_i x r_j
      if (length <= parallel) continue;
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double reach_a = half_a[i1] * absolute(i2, j) + half_a[i2] * absolute(i1, j);
      const double reach_b = half_b[j1] * absolute(i, j2) + half_b[j2] * absolute(i, j1);
      const double distance = std::abs(t[i2] * r(i1, j) - t[i1] * r(i2, j));
      if (const double separation = (distance - reach_a - reach_b) / length; separation > best + handicap)
        best = separation, axis = 6 + 3 * i + j;
    }
  }

  const auto corner_b = [&](const Vec3& direction) {  // furthest along it; the middle of what is square to it
    const Vec3 local = r.transpose() * direction;
    Vec3 corner;
    for (int i = 0; i < 3; ++i) corner[i] = std::abs(local[i]) < 1e-9 ? 0 : std::copysign(half_b[i], local[i]);
    return corner;
  };
  const auto corner_a = [&](const Vec3& direction) {
    Vec3 corner;
    for (int i = 0; i < 3; ++i) corner[i] = std::abs(direction[i]) < 1e-9 ? 0 : std::copysign(half_a[i], direction[i]);
    return corner;
  };
  if (axis < 3) {
    const Vec3 normal = std::copysign(1.0, t[axis]) * Vec3::Unit(axis);
    return {-best, normal, pose_b * corner_b(-normal) - best / 2 * normal};
  }
  if (axis < 6) {
    const Vec3 normal = std::copysign(1.0, in_b[axis - 3]) * r.col(axis - 3);
    return {-best, normal, corner_a(normal) + best / 2 * normal};
  }
  const int i = (axis - 6) / 3, j = (axis - 6) % 3;
  Vec3 normal = Vec3::Unit(i).cross(r.col(j)).normalized();
  if (normal.dot(t) < 0) normal = -normal;
  Vec3 on_a = corner_a(normal), on_b = corner_b(-normal);
  on_a[i] = -half_a[i];
  on_b[j] = -half_b[j];
  const ConvexDistance near =
      segment_distance(on_a, 2 * half_a[i] * Vec3::Unit(i), pose_b * on_b, 2 * half_b[j] * r.col(j));
  return {-best, normal, (near.on_a + near.on_b) / 2};
}

}  // namespace plumb::referee
