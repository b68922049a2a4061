// Whom a shape overlaps, how deep, and who is near it.
#include <algorithm>
#include <tuple>

#include "queries/exact.hpp"
#include "queries/search.hpp"

namespace plumb::jolt {
namespace {

/// Jolt's place of a shape is that of its centre of mass; base: what results are told from.
struct Placed {
  Placed(const Shape& of, const PlumbPose& pose)
      : shape(*of.jolt),
        base(position(pose.position, "pose.position")),
        centre(JPH::RMat44::sTranslation(base) * centre_transform(shape, pose, pose.position)),
        leaf(shape, centre_transform(shape, pose, pose.position), {}) {}

  const JPH::Shape& shape;
  JPH::RVec3 base;
  JPH::RMat44 centre;
  Leaf leaf;
};

/// Calls on_hit(part, between) for all parts of bodies that are up to so far away. rounding: by how much further Jolt
/// may find them.
template <class OnHit>
void find_near(const JPH::PhysicsSystem& system, const Placed& at, double distance, double rounding,
               const PlumbFilter& filter, OnHit on_hit) {
  auto collector = each<JPH::CollideShapeCollector>([&](auto&, const JPH::CollideShapeResult& hit) {
    const Part part(system, hit.mBodyID2, hit.mSubShapeID2);
    const Between apart = between(at.leaf, part.leaf(hit.mSubShapeID2, at.base));
    if (apart.distance <= distance) on_hit(part, apart);
  });
  system.GetNarrowPhaseQueryNoLock().CollideShape(&at.shape, JPH::Vec3::sOne(), at.centre, within(distance + rounding),
                                                  at.base, collector, {}, {}, Seen(filter));
}

PlumbClosest closest_of(const Part& part, const Between& apart, const PlumbVec3& base, std::uint32_t probe) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  PlumbClosest row{part.body.handle, probe, part.child, 0, {none, none, none}, {none, none, none}, {none, none, none}};
  if (apart.distance <= 0) return row;
  row.distance = apart.distance;
  row.on_probe = backend::add(base, to_plumb(apart.on_a));
  row.on_body = backend::add(base, to_plumb(apart.on_b));
  row.normal = to_plumb(apart.normal);
  return row;
}

PlumbClosest nobody(std::uint32_t probe) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {0, probe, 0, none, {none, none, none}, {none, none, none}, {none, none, none}};
}

/// Of each body the nearest part, the nearest body first.
void keep_nearest(std::vector<PlumbClosest>& rows, std::size_t first) {
  const auto begin = rows.begin() + static_cast<std::ptrdiff_t>(first);
  std::sort(begin, rows.end(), [](const PlumbClosest& a, const PlumbClosest& b) {
    return std::tuple(slot_of(a.body), a.distance, a.child) < std::tuple(slot_of(b.body), b.distance, b.child);
  });
  rows.erase(
      std::unique(begin, rows.end(), [](const PlumbClosest& a, const PlumbClosest& b) { return a.body == b.body; }),
      rows.end());
  std::sort(begin, rows.end(), [](const PlumbClosest& a, const PlumbClosest& b) {
    return std::tuple(a.distance, slot_of(a.body)) < std::tuple(b.distance, slot_of(b.body));
  });
}

}  // namespace

Hits World::overlap_shapes(std::span<const PlumbOverlap> overlaps) {
  return gather(PLUMB_HIT_ALL, overlaps, [&](const PlumbOverlap& overlap, backend::HitCollector& found) {
    find_near(system_, Placed(shape(overlap.shape), overlap.pose), 0, rounding(), overlap.filter,
              [&](const Part& part, const Between&) { found.add_overlap(part.body.handle, part.child); });
  });
}

Penetrations World::penetrations(std::span<const PlumbOverlap> overlaps) {
  thread_local std::vector<PlumbPenetration> rows;
  rows.clear();
  for (std::uint32_t i = 0; i < overlaps.size(); ++i) {
    const PlumbVec3& base = overlaps[i].pose.position;
    find_near(system_, Placed(shape(overlaps[i].shape), overlaps[i].pose), 0, rounding(), overlaps[i].filter,
              [&](const Part& part, const Between& apart) {
                rows.push_back({part.body.handle, i, part.child, -apart.distance,
                                backend::add(base, to_plumb(apart.on_a)), to_plumb(-apart.normal)});
              });
  }
  return {PLUMB_OK, backend::deepest_of_bodies(rows)};
}

ClosestBodies World::closest_bodies(PlumbHitMode mode, std::span<const PlumbProbe> probes) {
  thread_local std::vector<PlumbClosest> rows;
  rows.clear();
  for (std::uint32_t i = 0; i < probes.size(); ++i) {
    const std::size_t first = rows.size();
    find_near(system_, Placed(shape(probes[i].shape), probes[i].pose), probes[i].most_distance, rounding(),
              probes[i].filter, [&](const Part& part, const Between& apart) {
                rows.push_back(closest_of(part, apart, probes[i].pose.position, i));
              });
    keep_nearest(rows, first);
    if (mode == PLUMB_HIT_ALL) continue;
    if (rows.size() == first) rows.push_back(nobody(i));
    rows.resize(first + 1);
  }
  return {PLUMB_OK, rows};
}

}  // namespace plumb::jolt
