#include "referee/convex_penetration.hpp"

#include <algorithm>
#include <cmath>

#include "referee/convex_distance.hpp"
#include "referee/expanding_polytope.hpp"
#include "referee/polytope_penetration.hpp"

namespace plumb::referee {

namespace {

// The nearest point of a shape's surface to a point, and how far outside the point is.
struct Foot {
  double outside;  ///< m; below 0: inside
  Vec3 normal;     ///< unit, outward
};

Foot foot_on_box(const Vec3& half, const Vec3& p) {
  const Vec3 clamped = p.cwiseMax(-half).cwiseMin(half), gap = p - clamped;
  if (const double distance = gap.norm(); distance > 0) return {distance, gap / distance};
  int axis = 0;
  const double inside = (p.cwiseAbs() - half).maxCoeff(&axis);
  return {inside, std::copysign(1.0, p[axis]) * Vec3::Unit(axis)};
}

Foot foot_on_cylinder(double radius, double half_height, const Vec3& p) {
  const double across = std::hypot(p.x(), p.z());
  const Vec3 outward = across > 0 ? Vec3(p.x() / across, 0, p.z() / across) : Vec3::UnitX();
  const Vec3 up = std::copysign(1.0, p.y()) * Vec3::UnitY();
  const double beside = across - radius, above = std::abs(p.y()) - half_height;
  if (beside > 0 && above > 0) {
    const double distance = std::hypot(beside, above);
    return {distance, beside / distance * outward + above / distance * up};
  }
  return beside > above ? Foot{beside, outward} : Foot{above, up};
}

Penetration from_foot(const Foot& foot, double radius, const Vec3& centre) {
  return {radius - foot.outside, foot.normal, centre - (radius + foot.outside) / 2 * foot.normal};
}

// Spheres and capsules against each other.
Penetration rounded_pair(const Shape& a, const Shape& b, const Pose& pose_b) {
  const Vec3 along_a = 2 * a.half_height() * Vec3::UnitY(), along_b = 2 * b.half_height() * pose_b.rotation.col(1);
  const ConvexDistance near = segment_distance(-along_a / 2, along_a, pose_b.position - along_b / 2, along_b);
  Vec3 normal = near.on_b - near.on_a;
  if (near.distance > 0) {
    normal /= near.distance;
  } else {  // the axes cross: the way out is square to both
    normal = along_a.cross(along_b);
    if (normal.norm() <= 1e-12 * along_a.norm() * along_b.norm() || normal.norm() == 0) {
      const Vec3 axis = along_a.norm() > 0 ? along_a : along_b;
      normal = axis.norm() > 0 ? axis.unitOrthogonal() : Vec3::UnitY();
    }
    normal.normalize();
  }
  const double radii = a.radius() + b.radius();
  return {radii - near.distance, normal, (near.on_a + a.radius() * normal + near.on_b - b.radius() * normal) / 2};
}

// Both have cores (polytope, segment or point) that overlap, or at least one is a cylinder that the other overlaps.
Penetration overlapping_cores(const Shape& a, const Shape& b, const Pose& pose_b) {
  if (a.has_core() && b.has_core()) return polytope_penetration(a.core(), b.core(), pose_b);
  return expanding_polytope({&a, nullptr, Pose{}}, {&b, nullptr, pose_b});
}

Penetration by_cores(const Shape& a, const Shape& b, const Pose& pose_b, Apart apart) {
  const double radii = a.rounding() + b.rounding();
  const bool polytopes = a.has_core() && b.has_core();
  if (polytopes) {  // most pairs are settled by their axes alone
    const Penetration cores = polytope_penetration(a.core(), b.core(), pose_b);
    const bool apart_enough = -cores.depth > radii;
    if (radii == 0 && cores.depth >= 0) return cores;
    if (apart_enough && apart == Apart::lower_bound) return {cores.depth + radii, cores.normal, cores.point};
  }
  const ConvexDistance near = convex_distance({&a, nullptr, Pose{}}, {&b, nullptr, pose_b});
  // So near to each other GJK cannot tell round sides' distance from rounding; the expanding polytope can.
  const double too_near = polytopes ? 0 : 1e-6 * (a.radius() + a.half_height() + b.radius() + b.half_height());
  if (near.distance > too_near) {
    const Vec3 normal = (near.on_b - near.on_a) / near.distance;
    const Vec3 middle = (near.on_a + near.on_b + (a.rounding() - b.rounding()) * normal) / 2;
    return {radii - near.distance, normal, middle};
  }
  Penetration cores = overlapping_cores(a, b, pose_b);
  cores.depth += radii;
  cores.point += (a.rounding() - b.rounding()) / 2 * cores.normal;
  return cores;
}

}  // namespace

Penetration convex_penetration(const Shape& a, const Shape& b, const Pose& pose_b, Apart apart) {
  const auto rounded = [](const Shape& s) { return s.type() == PLUMB_SPHERE || s.type() == PLUMB_CAPSULE; };
  if (rounded(a) && rounded(b)) return rounded_pair(a, b, pose_b);
  if (b.type() == PLUMB_SPHERE && a.type() == PLUMB_BOX)
    return from_foot(foot_on_box(a.half_extents(), pose_b.position), b.radius(), pose_b.position);
  if (b.type() == PLUMB_SPHERE && a.type() == PLUMB_CYLINDER)
    return from_foot(foot_on_cylinder(a.radius(), a.half_height(), pose_b.position), b.radius(), pose_b.position);
  if (a.type() == PLUMB_SPHERE && !rounded(b)) {
    const Pose pose_a = pose_b.inverse();
    Penetration other = convex_penetration(b, a, pose_a, apart);
    return {other.depth, -(pose_b.rotation * other.normal), pose_b * other.point};
  }
  if (a.type() == PLUMB_BOX && b.type() == PLUMB_BOX) {
    const Penetration boxes = box_penetration(a.half_extents(), b.half_extents(), pose_b);
    if (boxes.depth >= 0 || apart == Apart::lower_bound) return boxes;
  }
  return by_cores(a, b, pose_b, apart);
}

}  // namespace plumb::referee
