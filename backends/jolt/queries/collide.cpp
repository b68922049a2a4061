// Collision without a step: two posed shapes.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/CollisionDispatch.h>
#include <Jolt/Physics/Collision/ManifoldBetweenTwoFaces.h>

#include <algorithm>

#include "queries/search.hpp"

namespace plumb::jolt {
namespace {

thread_local std::vector<PlumbPairPoint> pair_points;

/// m: who is further away is not looked for.
constexpr double kFurthest = 1e4;

/// The points of a hit as a step would make them, none deeper than the two are in each other, and with them the
/// deepest.
void add_points(const JPH::CollideShapeResult& hit, const Between& apart, const PlumbVec3& base) {
  constexpr double same = 1e-5;  // m
  JPH::ContactPoints on_a, on_b;
  JPH::ManifoldBetweenTwoFaces(apart.on_a, apart.on_b, apart.normal, JPH::cDefaultCollisionTolerance, hit.mShape1Face,
                               hit.mShape2Face, on_a, on_b JPH_IF_DEBUG_RENDERER(, JPH::RVec3::sZero()));
  if (on_a.size() > 4) JPH::PruneContactPoints(apart.normal, on_a, on_b JPH_IF_DEBUG_RENDERER(, JPH::RVec3::sZero()));
  const double most = -apart.distance;
  bool told = false;
  const auto add = [&](JPH::Vec3Arg a, JPH::Vec3Arg b, double depth) {
    told = told || depth >= most - same;
    pair_points.push_back(
        {backend::add(base, to_plumb(0.5f * (a + b))), to_plumb(apart.normal), std::min(depth, most), 0});
  };
  for (JPH::uint i = 0; i < on_a.size(); ++i)
    add(on_a[i], on_b[i], static_cast<double>((on_a[i] - on_b[i]).Dot(apart.normal)));
  if (!told) add(apart.on_a, apart.on_b, most);
}

/// NaN: nothing is so near.
double collide_within(double most, const Shape& a, const Shape& b, const PlumbPosedPair& pair) {
  const PlumbVec3& base = pair.pose_a.position;
  const JPH::Mat44 at_a = centre_transform(*a.jolt, pair.pose_a, base),
                   at_b = centre_transform(*b.jolt, pair.pose_b, base);
  double distance = std::numeric_limits<double>::quiet_NaN();
  auto collector = each<JPH::CollideShapeCollector>([&](auto&, const JPH::CollideShapeResult& hit) {
    const Between apart = between({*a.jolt, at_a, hit.mSubShapeID1}, {*b.jolt, at_b, hit.mSubShapeID2});
    if (!(distance <= apart.distance)) distance = apart.distance;
    if (apart.distance <= 0) add_points(hit, apart, base);
  });
  JPH::CollideShapeSettings how = within(most);
  how.mCollectFacesMode = JPH::ECollectFacesMode::CollectFaces;
  JPH::CollisionDispatch::sCollideShapeVsShape(a.jolt, b.jolt, JPH::Vec3::sOne(), JPH::Vec3::sOne(), at_a, at_b, {}, {},
                                               how, collector);
  return distance;
}

double collide_shapes(const Shape& a, const Shape& b, const PlumbPosedPair& pair, double rounding) {
  const double near = collide_within(rounding, a, b, pair);
  return std::isnan(near) ? collide_within(kFurthest, a, b, pair) : near;
}

bool is_surface(PlumbShapeType type) {
  return type == PLUMB_TRIANGLE_MESH || type == PLUMB_HEIGHT_FIELD || type == PLUMB_PLANE;
}

}  // namespace

PlumbResult World::collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                                 std::span<const PlumbPairPoint>& points) {
  pair_points.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t first = pair_points.size();
    const Shape &a = shape(pairs[i].shape_a), &b = shape(pairs[i].shape_b);
    const bool knows = !is_surface(a.type) || !is_surface(b.type);
    const double distance =
        knows ? collide_shapes(a, b, pairs[i], rounding()) : std::numeric_limits<double>::quiet_NaN();
    results[i] = {distance, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(pair_points.size() - first)};
  }
  points = pair_points;
  return PLUMB_OK;
}

}  // namespace plumb::jolt
