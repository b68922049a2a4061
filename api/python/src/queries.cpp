// Questions to a world that change nothing: rays, casts, overlaps, closest bodies, collision of pairs, and what the
// engine sees.
#include "world.hpp"

namespace plumb::python {
namespace {

py::array cast_rays(World& world, PlumbHitMode mode, const py::array& rows) {
  const auto& queries = world.extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES);
  const auto rays = rows_of<PlumbRay>(rows, "rays");
  std::vector<PlumbHit> hits;
  world.call_unlocked(Tag::query, "queries.rays", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(hits, [&](PlumbHit* out, std::uint32_t capacity, std::uint32_t* count) {
      return queries.rays(self, mode, rays.data(), sizeof(PlumbRay), count_of(rays.size()), out, capacity, count);
    });
  });
  return array_of(hits);
}

py::array cast_shapes(World& world, PlumbHitMode mode, const py::array& rows) {
  const auto& queries = world.extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES);
  const auto casts = rows_of<PlumbCast>(rows, "casts");
  std::vector<PlumbHit> hits;
  world.call_unlocked(Tag::query, "queries.casts", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(hits, [&](PlumbHit* out, std::uint32_t capacity, std::uint32_t* count) {
      return queries.casts(self, mode, casts.data(), sizeof(PlumbCast), count_of(casts.size()), out, capacity, count);
    });
  });
  return array_of(hits);
}

py::array turning_casts(World& world, PlumbHitMode mode, const py::array& rows) {
  const auto& queries = world.extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES);
  if (!has(queries, &PlumbQueriesTable::turning_casts))
    throw Error(PLUMB_E_UNSUPPORTED, "queries.turning_casts: the backend is older than it");
  const auto casts = rows_of<PlumbTurningCast>(rows, "casts");
  std::vector<PlumbHit> hits;
  world.call_unlocked(Tag::query, "queries.turning_casts", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(hits, [&](PlumbHit* out, std::uint32_t capacity, std::uint32_t* count) {
      return queries.turning_casts(self, mode, casts.data(), sizeof(PlumbTurningCast), count_of(casts.size()), out,
                                   capacity, count);
    });
  });
  return array_of(hits);
}

py::array overlap_shapes(World& world, const py::array& rows) {
  const auto& queries = world.extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES);
  const auto overlaps = rows_of<PlumbOverlap>(rows, "overlaps");
  std::vector<PlumbHit> hits;
  world.call_unlocked(Tag::query, "queries.overlaps", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(hits, [&](PlumbHit* out, std::uint32_t capacity, std::uint32_t* count) {
      return queries.overlaps(self, overlaps.data(), sizeof(PlumbOverlap), count_of(overlaps.size()), out, capacity,
                              count);
    });
  });
  return array_of(hits);
}

py::array penetrations(World& world, const py::array& rows) {
  const auto& queries = world.extension<PlumbQueriesTable>(PLUMB_EXT_QUERIES);
  if (!has(queries, &PlumbQueriesTable::penetrations))
    throw Error(PLUMB_E_UNSUPPORTED, "queries.penetrations: the backend is older than it");
  const auto overlaps = rows_of<PlumbOverlap>(rows, "overlaps");
  std::vector<PlumbPenetration> found;
  world.call_unlocked(Tag::query, "queries.penetrations", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(found, [&](PlumbPenetration* out, std::uint32_t capacity, std::uint32_t* count) {
      return queries.penetrations(self, overlaps.data(), sizeof(PlumbOverlap), count_of(overlaps.size()), out, capacity,
                                  count);
    });
  });
  return array_of(found);
}

py::array closest_bodies(World& world, PlumbHitMode mode, const py::array& rows) {
  const auto& closest = world.extension<PlumbClosestTable>(PLUMB_EXT_CLOSEST);
  const auto probes = rows_of<PlumbProbe>(rows, "probes");
  std::vector<PlumbClosest> found;
  world.call_unlocked(Tag::query, "closest.bodies", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(found, [&](PlumbClosest* out, std::uint32_t capacity, std::uint32_t* count) {
      return closest.bodies(self, mode, probes.data(), sizeof(PlumbProbe), count_of(probes.size()), out, capacity,
                            count);
    });
  });
  return array_of(found);
}

std::pair<py::array, py::array> collide_pairs(World& world, const py::array& rows) {
  const auto& collide = world.extension<PlumbCollideTable>(PLUMB_EXT_COLLIDE);
  const auto pairs = rows_of<PlumbPosedPair>(rows, "pairs");
  std::vector<PlumbPairResult> results(pairs.size());
  std::vector<PlumbPairPoint> points;
  world.call_unlocked(Tag::query, "collide.pairs", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(points, [&](PlumbPairPoint* out, std::uint32_t capacity, std::uint32_t* count) {
      return collide.pairs(self, pairs.data(), sizeof(PlumbPosedPair), count_of(pairs.size()), results.data(), out,
                           capacity, count);
    });
  });
  return {array_of(results), array_of(points)};
}

/// A function of the debug table, which may be shorter than ours.
template <auto member, class Row>
py::array look(World& world, const char* name) {
  const auto& debug = world.extension<PlumbDebugTable>(PLUMB_EXT_DEBUG);
  if (!has(debug, member)) throw Error(PLUMB_E_UNSUPPORTED, std::string(name) + ": the backend is older than it");
  std::vector<Row> rows;
  world.call(Tag::world, name, [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(rows, [&](Row* out, std::uint32_t capacity, std::uint32_t* count) {
      return (debug.*member)(self, out, capacity, count);
    });
  });
  return array_of(rows);
}

}  // namespace

void bind_queries(WorldClass& world) {
  using Debug = PlumbDebugTable;
  world.def("cast_rays", &cast_rays)
      .def("cast_shapes", &cast_shapes)
      .def("turning_casts", &turning_casts)
      .def("overlap_shapes", &overlap_shapes)
      .def("penetrations", &penetrations)
      .def("closest_bodies", &closest_bodies)
      .def("collide_pairs", &collide_pairs)
      .def("debug_pairs", [](World& self) { return look<&Debug::pairs, PlumbDebugPair>(self, "debug.pairs"); })
      .def("debug_boxes", [](World& self) { return look<&Debug::boxes, PlumbDebugBox>(self, "debug.boxes"); })
      .def("debug_axes", [](World& self) { return look<&Debug::axes, PlumbDebugAxis>(self, "debug.axes"); })
      .def("debug_bodies", [](World& self) { return look<&Debug::bodies, PlumbDebugBody>(self, "debug.bodies"); })
      .def("debug_constraints",
           [](World& self) { return look<&Debug::constraints, PlumbDebugConstraint>(self, "debug.constraints"); });
}

}  // namespace plumb::python
