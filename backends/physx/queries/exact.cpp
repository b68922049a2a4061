#include "queries/exact.hpp"

#include <extensions/PxCustomGeometryExt.h>

namespace plumb::px {
namespace {

/// m: who is further away is not looked for.
constexpr float kFurthest = 1e8f;

Between of_plane(const PxTransform& plane, const Leaf& other) {
  const PxVec3 normal = plane.q.getBasisVector0();
  const PxVec3 lowest = other.furthest(-normal);
  const float distance = (lowest - plane.p).dot(normal);
  return {static_cast<double>(distance), lowest - distance * normal, lowest, normal};
}

/// The way out along a direction, if it is less than what was known.
void try_way(const Leaf& a, const Leaf& b, const PxVec3& way, Between& best) {
  const PxVec3 normal = way.getNormalized();
  const PxVec3 on_a = a.furthest(normal), on_b = b.furthest(-normal);
  const auto depth = static_cast<double>((on_a - on_b).dot(normal));
  if (normal.isZero() || !(depth < -best.distance)) return;
  best = {-depth, on_a, on_a - static_cast<float>(depth) * normal, normal};
}

/// PhysX's searches for the least way out end beside it now and then: of what each of them finds the least is taken, at
/// its full length.
Between within_each_other(const Leaf& a, const Leaf& b, const PxVec3& found) {
  Between best{-std::numeric_limits<double>::infinity(), a.at().p, b.at().p, PxVec3(0, 1, 0)};
  try_way(a, b, found, best);
  for (const Leaf* leaf : {&a, &b}) {
    if (leaf->geometry() != nullptr) continue;
    try_way(a, b, leaf->across(), best);
    try_way(a, b, -leaf->across(), best);
  }
  PxVec3 out;
  float depth = 0;
  if (a.geometry() != nullptr && b.geometry() != nullptr &&
      PxGeometryQuery::computePenetration(out, depth, *a.geometry(), a.at(), *b.geometry(), b.at()))
    try_way(a, b, -out, best);
  return best;
}

Between turned(const Between& b) { return {b.distance, b.on_b, b.on_a, -b.normal}; }

}  // namespace

PxVec3 TriangleSupport::supportLocal(const PxVec3& direction) const {
  const PxVec3* best = corners;
  for (const PxVec3& corner : corners)
    if (corner.dot(direction) > best->dot(direction)) best = &corner;
  return *best;
}

Leaf::Leaf(const PxGeometry& geometry, const PxTransform& at)
    : at_(at), geometry_(&geometry), convex_(geometry), is_plane_(geometry.getType() == PxGeometryType::ePLANE) {
  if (geometry.getType() == PxGeometryType::eCUSTOM)
    cylinder_ = static_cast<const PxCustomGeometryExt::CylinderCallbacks*>(
        static_cast<const PxCustomGeometry&>(geometry).callbacks);
}

Leaf::Leaf(const PxTriangle& triangle) : at_(triangle.verts[0]), is_triangle_(true) {
  for (int i = 0; i < 3; ++i) triangle_.corners[i] = triangle.verts[i] - at_.p;
}

const PxGjkQuery::Support& Leaf::support() const {
  if (is_triangle_) return triangle_;
  if (cylinder_ != nullptr) return *cylinder_;
  return convex_;
}

PxVec3 Leaf::across() const {
  return (triangle_.corners[1] - triangle_.corners[0]).cross(triangle_.corners[2] - triangle_.corners[0]);
}

PxVec3 Leaf::furthest(const PxVec3& direction) const {
  const PxVec3 core = at_.transform(support().supportLocal(at_.rotateInv(direction)));
  return core + support().getMargin() * direction;
}

Between between(const Leaf& a, const Leaf& b) {
  if (a.is_plane()) return of_plane(a.at(), b);
  if (b.is_plane()) return turned(of_plane(b.at(), a));
  PxVec3 on_a, on_b, axis;
  float separation = 0;
  if (!PxGjkQuery::proximityInfo(a.support(), b.support(), a.at(), b.at(), kFurthest, 1, on_a, on_b, axis, separation))
    return {static_cast<double>(kFurthest), a.at().p, b.at().p, PxVec3(0, 1, 0)};
  if (separation < 0) return within_each_other(a, b, -axis);
  return {static_cast<double>(separation), on_a, on_b, -axis};  // PhysX's leads from b to a
}

}  // namespace plumb::px
