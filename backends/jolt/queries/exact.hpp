// How far apart two parts of shapes are, as they are: Jolt's collision rounds the edges of what has a convex radius.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Geometry/Plane.h>
#include <Jolt/Physics/Collision/Shape/ConvexShape.h>

#include "jolt_math.hpp"

namespace plumb::jolt {

/// A convex shape, a triangle or a plane in a common frame: a core, and a radius about it.
class Leaf {
 public:
  /// The part of a shape whose centre of mass is there. The shape outlives the leaf.
  Leaf(const JPH::Shape& shape, JPH::Mat44Arg centre, JPH::SubShapeID part);
  Leaf(const Leaf&) = delete;
  Leaf& operator=(const Leaf&) = delete;

  [[nodiscard]] JPH::Vec3 GetSupport(JPH::Vec3Arg direction) const;  ///< of the core; Jolt's templates call it so
  [[nodiscard]] float radius() const { return support_ == nullptr ? 0 : support_->GetConvexRadius(); }
  [[nodiscard]] bool is_plane() const { return is_plane_; }
  [[nodiscard]] const JPH::Plane& plane() const { return plane_; }
  void move(JPH::Vec3Arg by);

 private:
  JPH::Mat44 at_ = JPH::Mat44::sIdentity();
  const JPH::ConvexShape::Support* support_ = nullptr;  ///< null: a triangle or a plane
  JPH::ConvexShape::SupportBuffer buffer_;
  JPH::Vec3 corners_[3]{};
  JPH::Plane plane_;
  bool is_plane_ = false;
};

struct Between {
  double distance = 0;   ///< m, below 0: how deep they overlap
  JPH::Vec3 on_a, on_b;  ///< m: of their surfaces
  JPH::Vec3 normal;      ///< unit, from a to b
};

/// Not of two planes, or two triangles that overlap.
[[nodiscard]] Between between(const Leaf& a, const Leaf& b);

}  // namespace plumb::jolt
