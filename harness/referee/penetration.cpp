#include "referee/penetration.hpp"

#include "referee/convex_penetration.hpp"

namespace plumb::referee {

namespace {

bool has_triangles(const Shape& shape) {
  return shape.type() == PLUMB_TRIANGLE_MESH || shape.type() == PLUMB_HEIGHT_FIELD;
}

// The half space y <= 0 against what has a lowest point.
Penetration plane_penetration(const Shape& other, const Pose& pose) {
  Vec3 lowest(0, infinity, 0);
  if (other.convex()) {
    lowest = pose * other.support(-pose.rotation.row(1).transpose());
  } else {
    for (const Shape::Triangle& triangle : other.triangles())
      for (const Vec3& corner : triangle)
        if (const Vec3 p = pose * corner; p.y() < lowest.y()) lowest = p;
  }
  return {-lowest.y(), Vec3::UnitY(), {lowest.x(), lowest.y() / 2, lowest.z()}};
}

// b is placed in a's frame; a's type comes first in the rule that applies.
bool ordered_penetration(const Shape& a, const Shape& b, const Pose& pose_b, Apart apart, Penetration& result) {
  if (a.type() == PLUMB_COMPOUND) {
    for (const Shape::Child& child : a.children()) {
      const Penetration one = penetration(*child.shape, child.pose, b, pose_b, apart);
      if (one.depth > result.depth) result = one;
    }
    return true;
  }
  if (b.type() == PLUMB_COMPOUND) return false;
  if (a.type() == PLUMB_PLANE) {
    if (b.type() != PLUMB_PLANE) result = plane_penetration(b, pose_b);
    return true;
  }
  if (b.type() == PLUMB_PLANE) return false;
  if (has_triangles(a)) {
    if (b.convex()) result = mesh_penetration(a, b, pose_b, apart);
    return true;
  }
  if (has_triangles(b)) return false;
  result = convex_penetration(a, b, pose_b, apart);
  return true;
}

}  // namespace

Penetration penetration(const Shape& a, const Pose& pose_a, const Shape& b, const Pose& pose_b, Apart apart) {
  Penetration result{-infinity, Vec3::UnitY(), Vec3::Zero()};
  if (ordered_penetration(a, b, pose_b.seen_from(pose_a), apart, result))
    return {result.depth, pose_a.rotation * result.normal, pose_a * result.point};
  ordered_penetration(b, a, pose_a.seen_from(pose_b), apart, result);
  return {result.depth, -(pose_b.rotation * result.normal), pose_b * result.point};
}

}  // namespace plumb::referee
