// The three kinds of queries as kernels ask them: where a query starts, how far it goes, and whether and where it meets
// a shape. All have the same members. Each comes for scenes of spheres, boxes, capsules and hulls alone, and for all.
#pragma once

#include <limits>

#include "narrowphase/convex/distance.hpp"
#include "plumb/queries.h"
#include "queries/line_surface.hpp"
#include "queries/query_scene.hpp"
#include "queries/surface_pairs.hpp"

namespace plumb::impulse {

PLUMB_HD inline Vec64 to_vec64(const PlumbVec3& v) { return {v.x, v.y, v.z}; }
PLUMB_HD inline PlumbVec3 to_plumb_vec3(const Vec64& v) { return {v.x, v.y, v.z}; }
PLUMB_HD inline Quat64 to_quat64(const PlumbQuat& q) { return normalized(Quat64{q.x, q.y, q.z, q.w}); }
PLUMB_HD inline std::uint32_t row_of(std::uint64_t handle) { return static_cast<std::uint32_t>(handle); }
PLUMB_HD inline ProxyFilter to_proxy_filter(const PlumbFilter& f) { return {~0U, f.category, f.mask, f.group, 0}; }

/// Where a query meets a shape.
struct Meeting {
  double at;  ///< along the way, m
  Vec64 position, normal;
  bool at_start;  ///< of a cast: the shapes overlap there; position and normal are not known yet
  std::uint32_t child;
};

/// Triangles of meshes have numbers; those of height fields are not told.
PLUMB_HD inline std::uint32_t child_at(const Target& target, std::uint32_t triangle) {
  return target.shape.type == ShapeType::kMesh ? triangle : 0U;
}

/// The way that a query goes.
struct QueryWay {
  Vec64 along = {0, 0, 0};  ///< unit, or 0
  double length = 0;        ///< m; infinite where it is beyond all numbers

  PLUMB_HD QueryWay() {}
  PLUMB_HD explicit QueryWay(const PlumbVec3& translation) {
    const Vec64 t = to_vec64(translation), m = abs(t);
    const double most = max(m.x, max(m.y, m.z));
    const Vec64 scaled = {t.x / most, t.y / most, t.z / most};
    const double n = impulse::length(scaled);
    along = {scaled.x / n, scaled.y / n, scaled.z / n};
    length = most * n;
  }
  [[nodiscard]] PLUMB_HD double fraction(double at) const { return length > 0 ? min(at / length, 1.0) : 0.0; }
};

/// A ray sees convex shapes and planes as solid: one that starts inside hits at once, and its normal is against the
/// ray. Surfaces have two sides; the normal is that of the side which the ray comes to.
template <Kinds kKinds>
struct RayProbe {
  using Row = PlumbRay;
  Vec64 start;
  QueryWay course;
  ProxyFilter filter;

  PLUMB_HD RayProbe(const QueryScene& /*scene*/, const PlumbRay& ray)
      : start(to_vec64(ray.origin)), course(ray.translation), filter(to_proxy_filter(ray.filter)) {}
  [[nodiscard]] PLUMB_HD Box carried(const QueryScene& /*scene*/) const { return {{0, 0, 0}, {0, 0, 0}}; }

  PLUMB_HD bool meets(const QueryScene& scene, const Target& target, double most, Meeting& meeting) const {
    const Vec64 from = start - target.place;
    meeting.at_start = false;
    meeting.child = target.child;
    LinePart part;
    if (kKinds == Kinds::kAll && target.shape.type == ShapeType::kPlane) {
      if (!cross_plane(rotate_back(target.turn, from), rotate_back(target.turn, course.along), part)) return false;
    } else {
      const Vec64 beside = from - dot(from, course.along) * course.along;
      const double reach = static_cast<double>(target.shape.reach) * (1 + 0x1p-10);
      if (dot(beside, beside) > reach * reach) return false;
      const Vec64 p = rotate_back(target.turn, from), d = rotate_back(target.turn, course.along);
      if (kKinds == Kinds::kAll && is_surface(target.shape.type))
        return meets_surface(scene, target, p, d, most, meeting);
      if (!cross_convex<kKinds == Kinds::kAll>(target.shape, scene.hulls, p, d, part)) return false;
    }
    if (part.leave < 0 || part.enter > most) return false;
    meeting.at = max(part.enter, 0.0);
    meeting.normal = part.enter < 0 ? -course.along : rotate(target.turn, part.normal);
    meeting.position = start + meeting.at * course.along;
    return true;
  }

 private:
  PLUMB_HD PLUMB_OUT_OF_LINE bool meets_surface(const QueryScene& scene, const Target& target, const Vec64& p,
                                                const Vec64& d, double most, Meeting& meeting) const {
    bool met = false;
    with_surface(scene.surfaces, target.shape, [&](const auto& on) {
      SurfaceCross cross;
      met = cross_surface(on, p, d, most, cross);
      if (!met) return;
      meeting.at = cross.at;
      meeting.normal = rotate(target.turn, normal_against(on.triangle(cross.triangle), d));
      meeting.child = child_at(target, cross.triangle);
    });
    meeting.position = start + meeting.at * course.along;
    return met;
  }
};

/// The cast or overlapped shape and the target's, seen from the target.
PLUMB_HD inline PlacedPair<double> place_pair(const QueryScene& scene, const Target& target, const Shape& shape,
                                              const Vec64& place, const Quat64& turn) {
  return {target.shape, shape, to_matrix(conjugate(target.turn) * turn), rotate_back(target.turn, place - target.place),
          scene.hulls};
}

template <Kinds kKinds>
struct CastProbe {
  using Row = PlumbCast;
  Vec64 start;
  QueryWay course;
  ProxyFilter filter;
  Shape shape;
  Quat64 turn;

  PLUMB_HD CastProbe(const QueryScene& scene, const PlumbCast& cast)
      : start(to_vec64(cast.pose.position)),
        course(cast.translation),
        filter(to_proxy_filter(cast.filter)),
        shape(scene.shapes[row_of(cast.shape)]),
        turn(to_quat64(cast.pose.orientation)) {}
  [[nodiscard]] PLUMB_HD Box carried(const QueryScene& scene) const { return box_about(shape, turn, scene.hulls); }

  PLUMB_HD bool meets(const QueryScene& scene, const Target& target, double most, Meeting& meeting) const {
    CastTouch<double> touch;
    meeting.child = target.child;
    if (!touches(place_pair(scene, target, shape, start, turn), scene, target, most, touch, meeting.child))
      return false;
    meeting.at = touch.at;
    meeting.at_start = touch.at_start;
    if (touch.at_start) return true;
    meeting.normal = rotate(target.turn, touch.normal);
    meeting.position = target.place + rotate(target.turn, touch.on_a);
    return true;
  }

 private:
  PLUMB_HD bool touches(const PlacedPair<double>& pair, const QueryScene& scene, const Target& target, double most,
                        CastTouch<double>& touch, std::uint32_t& child) const {
    const Vec64 along = rotate_back(target.turn, course.along);
    if (kKinds == Kinds::kAll && target.shape.type == ShapeType::kPlane) return plane::cast(pair, along, most, touch);
    if (kKinds == Kinds::kFew || !is_surface(target.shape.type)) return cast_shape(pair, along, most, touch);
    std::uint32_t triangle;
    if (!cast_at_surface(scene.surfaces, pair, conjugate(target.turn) * turn, along, most, touch, triangle))
      return false;
    child = child_at(target, triangle);
    return true;
  }
};

template <Kinds kKinds>
struct OverlapProbe {
  using Row = PlumbOverlap;
  Vec64 start;
  QueryWay course;
  ProxyFilter filter;
  Shape shape;
  Quat64 turn;

  PLUMB_HD OverlapProbe(const QueryScene& scene, const PlumbOverlap& overlap)
      : start(to_vec64(overlap.pose.position)),
        filter(to_proxy_filter(overlap.filter)),
        shape(scene.shapes[row_of(overlap.shape)]),
        turn(to_quat64(overlap.pose.orientation)) {}
  [[nodiscard]] PLUMB_HD Box carried(const QueryScene& scene) const { return box_about(shape, turn, scene.hulls); }

  PLUMB_HD bool meets(const QueryScene& scene, const Target& target, double /*most*/, Meeting& meeting) const {
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    meeting = {0, {kUnknown, kUnknown, kUnknown}, {kUnknown, kUnknown, kUnknown}, false, target.child};
    const PlacedPair<double> pair = place_pair(scene, target, shape, start, turn);
    if (kKinds == Kinds::kAll && target.shape.type == ShapeType::kPlane) return plane::lowest(pair).y <= 0;
    if (kKinds == Kinds::kFew || !is_surface(target.shape.type)) return shapes_overlap(pair);
    std::uint32_t triangle;
    if (!overlaps_surface(scene.surfaces, pair, conjugate(target.turn) * turn, triangle)) return false;
    meeting.child = child_at(target, triangle);
    return true;
  }
};

}  // namespace plumb::impulse
