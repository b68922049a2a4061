#include "queries/exact.hpp"

#include <Jolt/Geometry/ConvexSupport.h>
#include <Jolt/Geometry/EPAPenetrationDepth.h>
#include <Jolt/Physics/Collision/Shape/MeshShape.h>
#include <Jolt/Physics/Collision/Shape/PlaneShape.h>
#include <Jolt/Physics/Collision/TransformedShape.h>

namespace plumb::jolt {
namespace {

constexpr float kTolerance = 1e-6f;

Between of_plane(const JPH::Plane& plane, const Leaf& other) {
  const JPH::Vec3 normal = plane.GetNormal();
  const JPH::Vec3 lowest = other.GetSupport(-normal) - other.radius() * normal;
  const float distance = plane.SignedDistance(lowest);
  return {static_cast<double>(distance), lowest - distance * normal, lowest, normal};
}

Between turned(const Between& b) { return {b.distance, b.on_b, b.on_a, -b.normal}; }

/// Their cores are apart.
Between apart(const Leaf& a, const Leaf& b, JPH::Vec3Arg on_a, JPH::Vec3Arg on_b) {
  const JPH::Vec3 way = on_b - on_a;
  const float length = way.Length();
  const JPH::Vec3 normal = way / length;
  return {static_cast<double>(length) - static_cast<double>(a.radius()) - static_cast<double>(b.radius()),
          on_a + a.radius() * normal, on_b - b.radius() * normal, normal};
}

/// Their cores overlap, as the search has found. The depth is the way out along the normal that it tells.
Between within_each_other(JPH::EPAPenetrationDepth& search, const Leaf& a, const Leaf& b) {
  JPH::Vec3 way = JPH::Vec3::sAxisX(), on_a = JPH::Vec3::sZero(), on_b = JPH::Vec3::sZero();
  const JPH::AddConvexRadius<Leaf> whole_a(a, a.radius()), whole_b(b, b.radius());
  if (!search.GetPenetrationDepthStepEPA(whole_a, whole_b, kTolerance, way, on_a, on_b))
    return {0, on_a, on_b, JPH::Vec3::sAxisY()};
  const JPH::Vec3 normal = way.NormalizedOr(JPH::Vec3::sAxisY());
  const float depth = (whole_a.GetSupport(normal) - whole_b.GetSupport(-normal)).Dot(normal);
  return {-static_cast<double>(depth), on_a, on_b, normal};
}

}  // namespace

Leaf::Leaf(const JPH::Shape& shape, JPH::Mat44Arg centre, JPH::SubShapeID part) {
  const JPH::Shape* at = &shape;
  JPH::SubShapeID rest = part;
  at_ = centre;
  while (at->GetType() == JPH::EShapeType::Compound || at->GetType() == JPH::EShapeType::Decorated) {
    JPH::SubShapeID below;
    const JPH::TransformedShape inner = at->GetSubShapeTransformedShape(
        rest, at_.GetTranslation(), at_.GetRotation().GetQuaternion(), JPH::Vec3::sOne(), below);
    at = inner.mShape;
    at_ = JPH::Mat44::sRotationTranslation(inner.mShapeRotation, JPH::Vec3(inner.mShapePositionCOM));
    rest = below;
  }
  if (at->GetType() == JPH::EShapeType::Convex) {
    support_ = static_cast<const JPH::ConvexShape*>(at)->GetSupportFunction(JPH::ConvexShape::ESupportMode::Default,
                                                                            buffer_, JPH::Vec3::sOne());
  } else if (at->GetType() == JPH::EShapeType::Plane) {
    is_plane_ = true;
    plane_ = static_cast<const JPH::PlaneShape*>(at)->GetPlane().GetTransformed(at_);
  } else {
    JPH::Shape::SupportingFace corners;
    at->GetSupportingFace(rest, JPH::Vec3::sAxisY(), JPH::Vec3::sOne(), at_, corners);
    for (JPH::uint i = 0; i < 3; ++i) corners_[i] = corners[i];
  }
}

JPH::Vec3 Leaf::GetSupport(JPH::Vec3Arg direction) const {
  if (support_ != nullptr) return at_ * support_->GetSupport(at_.Multiply3x3Transposed(direction));
  return JPH::TriangleConvexSupport(corners_[0], corners_[1], corners_[2]).GetSupport(direction);
}

void Leaf::move(JPH::Vec3Arg by) {
  at_.SetTranslation(at_.GetTranslation() + by);
  for (JPH::Vec3& corner : corners_) corner += by;
  plane_ = plane_.GetTransformed(JPH::Mat44::sTranslation(by));
}

Between between(const Leaf& a, const Leaf& b) {
  if (a.is_plane()) return of_plane(a.plane(), b);
  if (b.is_plane()) return turned(of_plane(b.plane(), a));
  JPH::Vec3 way = JPH::Vec3::sAxisX(), on_a = JPH::Vec3::sZero(), on_b = JPH::Vec3::sZero();
  JPH::GJKClosestPoint distance;
  if (distance.GetClosestPoints(a, b, kTolerance, FLT_MAX, way, on_a, on_b) > 0) return apart(a, b, on_a, on_b);
  JPH::EPAPenetrationDepth search;
  way = JPH::Vec3::sAxisX();
  (void)search.GetPenetrationDepthStepGJK(a, 0, b, 0, kTolerance, way, on_a, on_b);
  return within_each_other(search, a, b);
}

}  // namespace plumb::jolt
