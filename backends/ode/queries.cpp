// Rays and overlaps: temporary geoms against the space. ODE has no casts of shapes.
#include <algorithm>
#include <array>
#include <limits>

#include "plumb/assert.hpp"
#include "plumb/backend/hit_collector.hpp"
#include "world.hpp"

namespace plumb::ode {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
/// Of one ray with one geom (a height field gives several), and of one overlap.
constexpr int most_points = 16;

thread_local std::vector<PlumbHit> found;

std::uint32_t child_of(const GeomTag& tag, const dContactGeom& point) {
  if (tag.body->shape->type != PLUMB_TRIANGLE_MESH) return tag.placed.child;
  const int side = point.g1 == tag.placed.geom ? point.side1 : point.side2;
  return side < 0 ? 0 : static_cast<std::uint32_t>(side);
}

/// One query on its way through the space: the nearest hit of each body.
struct Search {
  const PlumbFilter& filter;
  std::uint32_t query;
  dGeomID probe;
  PlumbVec3 direction;  ///< of a ray, unit
  double length;        ///< of a ray, m; 0 for overlaps
  std::size_t first;    ///< of this query's hits

  static void near(void* self, dGeomID one, dGeomID two) {
    Search& search = *static_cast<Search*>(self);
    search.meet(one == search.probe ? two : one);
  }

  void meet(dGeomID geom) const {
    const GeomTag& tag = tag_of(geom);
    if (tag.body->sensor || !may_touch(filter, tag.body->filter)) return;
    if (length > 0 && dGeomGetClass(geom) == dConvexClass) return meet_hull(tag, geom);
    std::array<dContactGeom, most_points> points;
    const int wanted = length > 0 ? most_points : 1 | static_cast<int>(CONTACTS_UNIMPORTANT);
    const int count = dCollide(probe, geom, wanted, points.data(), sizeof(dContactGeom));
    if (count == 0) return;
    if (length > 0) {
      keep(ray_hit(tag, *std::min_element(points.begin(), points.begin() + count,
                                          [](const auto& x, const auto& y) { return x.depth < y.depth; })));
    } else {
      keep({tag.body->handle,
            query,
            child_of(tag, points[0]),
            0,
            {unknown, unknown, unknown},
            {unknown, unknown, unknown}});
    }
  }

  /// ODE's own rays (0.16) miss most hulls: here the planes of the faces cut the ray (Cyrus and Beck 1978). One that
  /// starts inside hits at once.
  void meet_hull(const GeomTag& tag, dGeomID geom) const {
    const Shape& whole = *tag.body->shape;
    const Shape& hull = whole.type == PLUMB_COMPOUND ? *whole.children[tag.placed.child].shape : whole;
    dVector3 start, along, p, d;
    dGeomRayGet(probe, start, along);
    dGeomGetPosRelPoint(geom, start[0], start[1], start[2], p);
    dGeomVectorFromWorld(geom, direction.x, direction.y, direction.z, d);
    PLUMB_ASSERT(!hull.planes.empty() && hull.planes.size() % 4 == 0);
    double enter = 0, leave = length;
    const dReal* entered = nullptr;
    for (std::size_t i = 0; i < hull.planes.size(); i += 4) {
      const dReal* plane = &hull.planes[i];
      const double below = plane[3] - dCalcVectorDot3(plane, p), speed = dCalcVectorDot3(plane, d);
      if (speed == 0 && below < 0) return;
      if (speed > 0) leave = std::min(leave, below / speed);
      if (speed < 0 && below / speed > enter) {
        enter = below / speed;
        entered = plane;
      }
    }
    if (enter > leave) return;
    dVector3 normal = {-direction.x, -direction.y, -direction.z};
    if (entered != nullptr) dGeomVectorToWorld(geom, entered[0], entered[1], entered[2], normal);
    const PlumbVec3 at = {start[0] + enter * direction.x, start[1] + enter * direction.y,
                          start[2] + enter * direction.z};
    keep({tag.body->handle, query, tag.placed.child, enter / length, at, vec(normal)});
  }

  [[nodiscard]] PlumbHit ray_hit(const GeomTag& tag, const dContactGeom& point) const {
    PlumbVec3 normal = vec(point.normal);
    // ODE's meshes and shapes disagree about the sign; the surface that was hit looks at the ray.
    if (dot(normal, direction) > 0) normal = scale(-1, normal);
    return {tag.body->handle, query, child_of(tag, point), point.depth / length, vec(point.pos), normal};
  }

  void keep(const PlumbHit& hit) const {
    PLUMB_ASSERT(hit.query == query && hit.fraction >= 0);
    for (std::size_t i = first; i < found.size(); ++i) {
      if (found[i].body != hit.body) continue;
      if (hit.fraction < found[i].fraction) found[i] = hit;
      return;
    }
    found.push_back(hit);
  }
};

/// All points of contact of a shape on its way through the space.
struct Touches {
  const PlumbFilter& filter;
  std::uint32_t query;
  dGeomID probe;
  std::vector<PlumbPenetration>& found;

  static void near(void* self, dGeomID one, dGeomID two) {
    Touches& touches = *static_cast<Touches*>(self);
    touches.meet(one == touches.probe ? two : one);
  }
  void meet(dGeomID geom) const {
    const GeomTag& tag = tag_of(geom);
    if (tag.body->sensor || !may_touch(filter, tag.body->filter)) return;
    std::array<dContactGeom, most_points> points;
    const int count = dCollide(probe, geom, most_points, points.data(), sizeof(dContactGeom));
    for (int i = 0; i < count; ++i) {
      const dContactGeom& point = points[static_cast<std::size_t>(i)];
      found.push_back({tag.body->handle, query, child_of(tag, point), std::max(point.depth, 0.0), vec(point.pos),
                       vec(point.normal)});
    }
  }
};

bool nearer(const PlumbHit& x, const PlumbHit& y) {
  return x.fraction != y.fraction ? x.fraction < y.fraction : slot_of(x.body) < slot_of(y.body);
}

/// A shape meets what is in a space, as Search or Touches has it.
template <class Meeting>
void meet_all(const Shape& shape, const PlumbPose& pose, dSpaceID space, Meeting& meeting) {
  std::vector<PlacedGeom> geoms;
  make_geoms(shape, nullptr, geoms);
  for (const PlacedGeom& geom : geoms) {
    place_geom(geom, pose);
    meeting.probe = geom.geom;
    dSpaceCollide2(geom.geom, reinterpret_cast<dGeomID>(space), &meeting, &Meeting::near);
    dGeomDestroy(geom.geom);
  }
}

struct TemporaryRay {
  TemporaryRay() : geom(dCreateRay(nullptr, 1)) {
    dGeomRaySetFirstContact(geom, 0);
    dGeomRaySetBackfaceCull(geom, 0);
    dGeomRaySetClosestHit(geom, 1);
  }
  TemporaryRay(const TemporaryRay&) = delete;
  TemporaryRay& operator=(const TemporaryRay&) = delete;
  ~TemporaryRay() { dGeomDestroy(geom); }
  dGeomID geom;
};

}  // namespace

Hits World::cast_rays(PlumbHitMode mode, std::span<const PlumbRay> rays) {
  const std::scoped_lock lock(query_mutex_);
  return inside_ode([&]() -> Hits {
    found.clear();
    const TemporaryRay temporary;
    for (std::uint32_t i = 0; i < rays.size(); ++i) {
      const PlumbRay& ray = rays[i];
      const double reach = length(ray.translation);
      const PlumbVec3 along = scale(1 / reach, ray.translation);
      dGeomRaySetLength(temporary.geom, reach);
      dGeomRaySet(temporary.geom, ray.origin.x, ray.origin.y, ray.origin.z, along.x, along.y, along.z);
      Search search{ray.filter, i, temporary.geom, along, reach, found.size()};
      dSpaceCollide2(temporary.geom, reinterpret_cast<dGeomID>(space_), &search, &Search::near);
      const auto begin = found.begin() + static_cast<std::ptrdiff_t>(search.first);
      std::sort(begin, found.end(), nearer);
      if (mode == PLUMB_HIT_CLOSEST) {
        if (begin == found.end()) found.push_back({0, i, 0, 0, {0, 0, 0}, {0, 0, 0}});
        found.resize(search.first + 1);
      }
    }
    return {PLUMB_OK, found};
  });
}

Hits World::cast_shapes(PlumbHitMode, std::span<const PlumbCast>) {
  throw Error(PLUMB_E_UNSUPPORTED, "ODE has no casts of shapes");
}

Hits World::overlap_shapes(std::span<const PlumbOverlap> overlaps) {
  const std::scoped_lock lock(query_mutex_);
  return inside_ode([&]() -> Hits {
    found.clear();
    for (std::uint32_t i = 0; i < overlaps.size(); ++i) {
      Search search{overlaps[i].filter, i, nullptr, {}, 0, found.size()};
      meet_all(*slots_.shapes[slot_of(overlaps[i].shape)], overlaps[i].pose, space_, search);
      std::sort(found.begin() + static_cast<std::ptrdiff_t>(search.first), found.end(), nearer);
    }
    return {PLUMB_OK, found};
  });
}

Penetrations World::penetrations(std::span<const PlumbOverlap> overlaps) {
  const std::scoped_lock lock(query_mutex_);
  return inside_ode([&]() -> Penetrations {
    thread_local std::vector<PlumbPenetration> touches;
    touches.clear();
    for (std::uint32_t i = 0; i < overlaps.size(); ++i) {
      Touches meeting{overlaps[i].filter, i, nullptr, touches};
      meet_all(*slots_.shapes[slot_of(overlaps[i].shape)], overlaps[i].pose, space_, meeting);
    }
    return {PLUMB_OK, backend::deepest_of_bodies(touches)};
  });
}

}  // namespace plumb::ode
