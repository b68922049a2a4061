// Distance of two convex sets by their support functions (GJK). Inner part of penetration.hpp.
#pragma once

#include "referee/shape.hpp"

namespace plumb::referee {

/// A convex set in some frame: a shape's core, or a polytope. Does not own.
struct ConvexView {
  const Shape* shape;  ///< null when polytope is set
  const Polytope* polytope;
  Pose pose;

  [[nodiscard]] Vec3 support(const Vec3& direction) const {
    const Vec3 local = pose.rotation.transpose() * direction;
    return pose * (shape != nullptr ? shape->core_support(local) : polytope->corners[polytope->support(local)]);
  }
};

struct ConvexDistance {
  double distance;  ///< m; 0 when they overlap or touch
  Vec3 on_a, on_b;  ///< nearest points; meaningless when distance is 0
};

/// To rounding between flat features; within 1e-7 of the size where a cylinder's round side is nearest. Distances below
/// 1e-13 of the size are 0.
[[nodiscard]] ConvexDistance convex_distance(const ConvexView& a, const ConvexView& b);

/// Nearest points of two segments from p to p + d (Ericson 2005, Real-Time Collision Detection, 5.1.9). Lengths may be
/// 0.
[[nodiscard]] ConvexDistance segment_distance(const Vec3& p, const Vec3& d, const Vec3& q, const Vec3& e);

}  // namespace plumb::referee
