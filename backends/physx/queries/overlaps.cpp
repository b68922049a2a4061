// Whom a shape overlaps, how deep, and who is near it.
#include <algorithm>
#include <tuple>

#include "queries/search.hpp"

namespace plumb::px {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

/// A convex shape of a query at its place; base: what results are told from.
struct Placed {
  Placed(const Shape& shape, const PlumbPose& pose)
      : geometry(shape.pieces.front().geometry.any()),
        at(transform(pose, "pose.position") * shape.pieces.front().at),
        leaf(geometry, PxTransform(PxVec3(0), at.q)) {}

  [[nodiscard]] PlumbVec3 place(const PxVec3& from_here) const {
    return backend::add(to_plumb(at.p), to_plumb(from_here));
  }

  const PxGeometry& geometry;
  PxTransform at;
  Leaf leaf;
};

/// Calls on_hit(part, child, between) for all leaves of bodies that are up to so far away.
template <class OnHit>
void find_within(const PxScene& scene, const Placed& at, double distance, const PlumbFilter& filter, OnHit on_hit) {
  const auto sees = seen_by(filter);
  PxBounds3 bounds;
  PxGeometryQuery::computeGeomBounds(bounds, at.geometry, at.at);
  bounds.fattenFast(static_cast<float>(distance));
  find_near(scene, bounds, sees, [&](const Part& part, const PxShape& shape, const PxRigidActor& actor) {
    for_leaves(shape.getGeometry(), PxShapeExt::getGlobalPose(shape, actor), bounds, at.at.p,
               [&](const Leaf& leaf, PxU32 face) {
                 const Between apart = between(at.leaf, leaf);
                 if (apart.distance <= distance) on_hit(part, child_of(part, face), apart);
               });
  });
}

PlumbClosest nobody(std::uint32_t probe) {
  return {0, probe, 0, kNone, {kNone, kNone, kNone}, {kNone, kNone, kNone}, {kNone, kNone, kNone}};
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
    find_within(
        *scene_, Placed(shape(overlap.shape), overlap.pose), 0, overlap.filter,
        [&](const Part& part, std::uint32_t child, const Between&) { found.add_overlap(part.body->handle, child); });
  });
}

Penetrations World::penetrations(std::span<const PlumbOverlap> overlaps) {
  thread_local std::vector<PlumbPenetration> rows;
  rows.clear();
  for (std::uint32_t i = 0; i < overlaps.size(); ++i) {
    const Placed at(shape(overlaps[i].shape), overlaps[i].pose);
    find_within(*scene_, at, 0, overlaps[i].filter, [&](const Part& part, std::uint32_t child, const Between& apart) {
      rows.push_back({part.body->handle, i, child, -apart.distance, at.place(apart.on_a), to_plumb(-apart.normal)});
    });
  }
  return {PLUMB_OK, backend::deepest_of_bodies(rows)};
}

ClosestBodies World::closest_bodies(PlumbHitMode mode, std::span<const PlumbProbe> probes) {
  thread_local std::vector<PlumbClosest> rows;
  rows.clear();
  for (std::uint32_t i = 0; i < probes.size(); ++i) {
    const std::size_t first = rows.size();
    const Placed at(shape(probes[i].shape), probes[i].pose);
    const double most = probes[i].most_distance;
    // The nearest alone is looked for further and further away.
    for (double distance = mode == PLUMB_HIT_ALL ? most : std::min(most, 1.0);;
         distance = std::min(most, 4 * distance)) {
      find_within(*scene_, at, distance, probes[i].filter,
                  [&](const Part& part, std::uint32_t child, const Between& apart) {
                    PlumbClosest row = nobody(i);
                    row.body = part.body->handle;
                    row.child = child;
                    row.distance = std::max(apart.distance, 0.0);
                    if (apart.distance > 0) {
                      row.on_probe = at.place(apart.on_a);
                      row.on_body = at.place(apart.on_b);
                      row.normal = to_plumb(apart.normal);
                    }
                    rows.push_back(row);
                  });
      if (rows.size() > first || distance >= most) break;
    }
    keep_nearest(rows, first);
    if (mode == PLUMB_HIT_ALL) continue;
    if (rows.size() == first) rows.push_back(nobody(i));
    rows.resize(first + 1);
  }
  return {PLUMB_OK, rows};
}

}  // namespace plumb::px
