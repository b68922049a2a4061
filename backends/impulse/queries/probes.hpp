// The three kinds of queries as kernels ask them: where a query starts, how far it goes, and whether and where it meets
// a shape. All have the same members.
#pragma once

#include <limits>

#include "geometry/shape_box.hpp"
#include "narrowphase/distance.hpp"
#include "plumb/queries.h"
#include "queries/query_scene.hpp"

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
};

/// The way that a query goes.
struct Course {
  Vec64 along = {0, 0, 0};  ///< unit, or 0
  double length = 0;        ///< m; infinite where it is beyond all numbers

  PLUMB_HD Course() {}
  PLUMB_HD explicit Course(const PlumbVec3& translation) {
    const Vec64 t = to_vec64(translation), m = abs(t);
    const double most = max(m.x, max(m.y, m.z));
    const Vec64 scaled = {t.x / most, t.y / most, t.z / most};
    const double n = impulse::length(scaled);
    along = {scaled.x / n, scaled.y / n, scaled.z / n};
    length = most * n;
  }
  [[nodiscard]] PLUMB_HD double fraction(double at) const { return length > 0 ? min(at / length, 1.0) : 0.0; }
};

/// A ray sees shapes as solid: one that starts inside hits at once, and its normal is against the ray.
struct RayProbe {
  using Row = PlumbRay;
  Vec64 start;
  Course course;
  ProxyFilter filter;

  PLUMB_HD RayProbe(const QueryScene& /*scene*/, const PlumbRay& ray)
      : start(to_vec64(ray.origin)), course(ray.translation), filter(to_proxy_filter(ray.filter)) {}
  [[nodiscard]] PLUMB_HD Box carried(const QueryScene& /*scene*/) const { return {{0, 0, 0}, {0, 0, 0}}; }

  PLUMB_HD bool meets(const QueryScene& scene, const Target& target, double most, Meeting& meeting) const {
    const Vec64 from = start - target.place;
    const Vec64 beside = from - dot(from, course.along) * course.along;
    const double reach = static_cast<double>(target.shape.reach) * (1 + 0x1p-10);
    if (dot(beside, beside) > reach * reach) return false;
    LinePart part;
    if (!cross_shape(target.shape, scene.hulls, rotate_back(target.turn, from), rotate_back(target.turn, course.along),
                     part))
      return false;
    if (part.leave < 0 || part.enter > most) return false;
    meeting.at_start = false;
    meeting.at = max(part.enter, 0.0);
    meeting.normal = part.enter < 0 ? -course.along : rotate(target.turn, part.normal);
    meeting.position = start + meeting.at * course.along;
    return true;
  }
};

/// The cast or overlapped shape and the target's, seen from the target.
PLUMB_HD inline PlacedPair<double> place_pair(const QueryScene& scene, const Target& target, const Shape& shape,
                                              const Vec64& place, const Quat64& turn) {
  return {target.shape, shape, to_matrix(conjugate(target.turn) * turn), rotate_back(target.turn, place - target.place),
          scene.hulls};
}
PLUMB_HD inline Box box_about(const QueryScene& scene, const Shape& shape, const Quat64& turn) {
  const Box box = shape_box(shape, to_numbers<Real>(turn), scene.hulls);
  const Vec rounding = (8 * kEpsilon) * (abs(box.low) + abs(box.high));
  return {box.low - rounding, box.high + rounding};
}

struct CastProbe {
  using Row = PlumbCast;
  Vec64 start;
  Course course;
  ProxyFilter filter;
  Shape shape;
  Quat64 turn;

  PLUMB_HD CastProbe(const QueryScene& scene, const PlumbCast& cast)
      : start(to_vec64(cast.pose.position)),
        course(cast.translation),
        filter(to_proxy_filter(cast.filter)),
        shape(scene.shapes[row_of(cast.shape)]),
        turn(to_quat64(cast.pose.orientation)) {}
  [[nodiscard]] PLUMB_HD Box carried(const QueryScene& scene) const { return box_about(scene, shape, turn); }

  PLUMB_HD bool meets(const QueryScene& scene, const Target& target, double most, Meeting& meeting) const {
    CastTouch<double> touch;
    if (!cast_shape(place_pair(scene, target, shape, start, turn), rotate_back(target.turn, course.along), most, touch))
      return false;
    meeting.at = touch.at;
    meeting.at_start = touch.at_start;
    if (touch.at_start) return true;
    meeting.normal = rotate(target.turn, touch.normal);
    meeting.position = target.place + rotate(target.turn, touch.on_a);
    return true;
  }
};

struct OverlapProbe {
  using Row = PlumbOverlap;
  Vec64 start;
  Course course;
  ProxyFilter filter;
  Shape shape;
  Quat64 turn;

  PLUMB_HD OverlapProbe(const QueryScene& scene, const PlumbOverlap& overlap)
      : start(to_vec64(overlap.pose.position)),
        filter(to_proxy_filter(overlap.filter)),
        shape(scene.shapes[row_of(overlap.shape)]),
        turn(to_quat64(overlap.pose.orientation)) {}
  [[nodiscard]] PLUMB_HD Box carried(const QueryScene& scene) const { return box_about(scene, shape, turn); }

  PLUMB_HD bool meets(const QueryScene& scene, const Target& target, double /*most*/, Meeting& meeting) const {
    if (!shapes_overlap(place_pair(scene, target, shape, start, turn))) return false;
    constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
    meeting = {0, {kUnknown, kUnknown, kUnknown}, {kUnknown, kUnknown, kUnknown}, false};
    return true;
  }
};

}  // namespace plumb::impulse
