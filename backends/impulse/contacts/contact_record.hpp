// Contacts as the host is told of them: a manifold with places in the world.
#pragma once

#include "bodies/body.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

struct ContactRecord {
  Pair pair;    ///< of proxies
  Pair bodies;  ///< their bodies' slots
  Vec normal;
  std::uint32_t count;
  std::uint32_t triangle[kManifoldPoints];  ///< of a surface; else 0
  std::uint32_t feature[kManifoldPoints];
  Position position[kManifoldPoints];  ///< at detection
  Real separation[kManifoldPoints];    ///< likewise
  Real normal_impulse[kManifoldPoints];
  Vec tangent_impulse[kManifoldPoints];
};

struct DescribeContacts {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const Displacement* displacements;
  const StepImpulses* impulses;  ///< null: not asked for
  ContactRecord* records;

  PLUMB_HD void operator()(std::uint32_t row) const {
    const std::uint32_t candidate = cache.candidate[row];
    const Manifold& found = cache.found[candidate];
    const CachedManifold& kept = cache.kept[row];
    ContactRecord& record = records[row];
    record.pair = cache.pairs[candidate];
    record.normal = found.normal;
    record.count = found.count;
    const Proxy& a = proxies.rows[record.pair.a];
    const bool has_triangles = has_surface(proxies, record.pair);
    record.bodies = {a.body, proxies.rows[record.pair.b].body};
    const Displacement& moved_by = displacements[a.body];
    const Quat orientation = conjugate(moved_by.rotation) * bodies.orientation[a.body];
    const Position origin = moved(bodies.position[a.body], rotate(orientation, a.frame.position) - moved_by.linear);
    for (std::uint32_t p = 0; p < found.count; ++p) {
      record.triangle[p] = has_triangles ? cache.point_triangles[candidate].of[p] : 0;
      record.feature[p] = found.points[p].feature;
      record.position[p] = moved(origin, found.points[p].position);
      record.separation[p] = found.points[p].separation;
      record.normal_impulse[p] = impulses == nullptr ? 0 : impulses[row].normal[p];
      record.tangent_impulse[p] = impulses == nullptr
                                      ? Vec{0, 0, 0}
                                      : impulses[row].tangent[0][p] * kept.tangent +
                                            impulses[row].tangent[1][p] * cross(kept.normal, kept.tangent);
    }
  }
};

}  // namespace plumb::impulse
