// Collision without a step: two posed shapes.
#include <PxImmediateMode.h>

#include <algorithm>

#include "queries/search.hpp"

namespace plumb::px {
namespace {

thread_local std::vector<PlumbPairPoint> pair_points;

/// What PhysX makes contacts in, and keeps nothing of.
class Scratch final : public PxCacheAllocator {
 public:
  PxU8* allocateCacheData(PxU32 bytes) override {
    kept_.emplace_back((bytes + 31) / 16);
    const auto address = reinterpret_cast<std::uintptr_t>(kept_.back().data());
    return reinterpret_cast<PxU8*>((address + 15) / 16 * 16);
  }

 private:
  struct Block {
    double bytes[2];
  };
  std::vector<std::vector<Block>> kept_;
};

/// Points of two convex shapes as a step would make them, from a to b.
struct Recorder final : immediate::PxContactRecorder {
  bool recordContacts(const PxContactPoint* contacts, PxU32 count, PxU32) override {
    points.insert(points.end(), contacts, contacts + count);
    return true;
  }
  std::vector<PxContactPoint> points;
};

/// None deeper than the two are in each other, and with them the deepest.
void add_points(const PxGeometry& a, const PxTransform& at_a, const PxGeometry& b, const PxTransform& at_b,
                const Between& apart, const PlumbVec3& base) {
  constexpr double same = 1e-5;  // m
  const double most = -apart.distance;
  const PlumbVec3 normal = to_plumb(apart.normal);
  bool told = false;
  const auto add = [&](const PlumbVec3& position, double depth) {
    told = told || depth >= most - same;
    pair_points.push_back({backend::add(base, position), normal, std::min(depth, most), 0});
  };
  Scratch scratch;
  Recorder recorder;
  const PxGeometry *first = &a, *second = &b;
  PxCache cache;
  (void)immediate::PxGenerateContacts(&first, &second, &at_a, &at_b, &cache, 1, recorder, 0.001f, 0.001f, 1, scratch);
  for (const PxContactPoint& point : recorder.points)
    if (point.separation <= 0 && -backend::dot(to_plumb(point.normal), normal) > 0.99)
      add(to_plumb(point.point), -static_cast<double>(point.separation));
  if (!told) add(backend::scale(0.5, backend::add(to_plumb(apart.on_a), to_plumb(apart.on_b))), most);
}

/// Of triangles each has its deepest point.
void add_point(const Between& apart, const PlumbVec3& base) {
  const PlumbVec3 middle = backend::scale(0.5, backend::add(to_plumb(apart.on_a), to_plumb(apart.on_b)));
  pair_points.push_back({backend::add(base, middle), to_plumb(apart.normal), -apart.distance, 0});
}

PxBounds3 bounds_of(const PxGeometry& geometry, const PxTransform& at, double within) {
  PxBounds3 bounds;
  PxGeometryQuery::computeGeomBounds(bounds, geometry, at);
  bounds.fattenFast(static_cast<float>(within));
  return bounds;
}

/// The nearest of those whose bounds are so near; NaN for nothing. base: places are told from it, and points are kept.
double collide_pieces(const Piece& a, const PxTransform& at_a, const Piece& b, const PxTransform& at_b, double within,
                      const PlumbVec3& base) {
  const PxGeometry &first = a.geometry.any(), &second = b.geometry.any();
  double distance = std::numeric_limits<double>::quiet_NaN();
  const auto near = [&](const Between& apart, bool convex) {
    if (!(distance <= apart.distance)) distance = apart.distance;
    if (apart.distance > 0) return;
    convex ? add_points(first, at_a, second, at_b, apart, base) : add_point(apart, base);
  };
  if (is_surface(first)) {
    const Leaf other(second, at_b);
    for_leaves(first, at_a,
               other.is_plane() ? PxBounds3::centerExtents(PxVec3(0), PxVec3(1e6f)) : bounds_of(second, at_b, within),
               PxVec3(0), [&](const Leaf& leaf, PxU32) { near(between(leaf, other), false); });
    return distance;
  }
  const Leaf other(first, at_a);
  for_leaves(second, at_b,
             other.is_plane() ? PxBounds3::centerExtents(PxVec3(0), PxVec3(1e6f)) : bounds_of(first, at_a, within),
             PxVec3(0), [&](const Leaf& leaf, PxU32) { near(between(other, leaf), !is_surface(second)); });
  return distance;
}

bool knows(const Piece& a, const Piece& b) {
  const auto flat = [](const Piece& piece) {
    return is_surface(piece.geometry.any()) || piece.is(PxGeometryType::ePLANE);
  };
  return !flat(a) || !flat(b);
}

double collide_shapes(const Shape& a, const Shape& b, const PlumbPosedPair& pair) {
  const PlumbVec3& base = pair.pose_a.position;
  const auto placed = [&](const PlumbPose& pose) {
    return transform({backend::sub(pose.position, base), pose.orientation}, "position of a shape");
  };
  const PxTransform at_a = placed(pair.pose_a), at_b = placed(pair.pose_b);
  const auto look = [&](double within) {
    double distance = std::numeric_limits<double>::quiet_NaN();
    for (const Piece& of_a : a.pieces)
      for (const Piece& of_b : b.pieces) {
        if (!knows(of_a, of_b)) continue;
        const double apart = collide_pieces(of_a, at_a * of_a.at, of_b, at_b * of_b.at, within, base);
        if (!(distance <= apart) && !std::isnan(apart)) distance = apart;
      }
    return distance;
  };
  double within = 0.01, distance = look(within);
  for (; std::isnan(distance) && within < 1e5; distance = look(within)) within *= 30;
  return distance > within ? look(distance) : distance;  // bounds are nearer than what is in them
}

}  // namespace

PlumbResult World::collide_pairs(std::span<const PlumbPosedPair> pairs, std::span<PlumbPairResult> results,
                                 std::span<const PlumbPairPoint>& points) {
  pair_points.clear();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const std::size_t first = pair_points.size();
    const double distance = collide_shapes(shape(pairs[i].shape_a), shape(pairs[i].shape_b), pairs[i]);
    results[i] = {distance, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(pair_points.size() - first)};
  }
  points = pair_points;
  return PLUMB_OK;
}

}  // namespace plumb::px
