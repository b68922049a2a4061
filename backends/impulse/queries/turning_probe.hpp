// A cast of a shape that turns on its way, as kernels ask it: with the members of the probes of probes.hpp.
#pragma once

#include "queries/probes.hpp"
#include "queries/turning_cast.hpp"

namespace plumb::impulse {

template <Kinds kKinds>
struct TurningProbe {
  using Row = PlumbTurningCast;
  Vec64 start;
  QueryWay course;  ///< where there is no translation, of length 1 and along nothing
  ProxyFilter filter;
  Shape shape;
  Quat64 turn;
  Vec64 axis = {0, 0, 0};  ///< unit, or 0
  double angle = 0;        ///< rad, all along the way

  PLUMB_HD TurningProbe(const QueryScene& scene, const PlumbTurningCast& cast)
      : start(to_vec64(cast.pose.position)),
        filter(to_proxy_filter(cast.filter)),
        shape(scene.shapes[row_of(cast.shape)]),
        turn(to_quat64(cast.pose.orientation)) {
    const PlumbVec3 &t = cast.translation, &r = cast.rotation;
    if (t.x != 0 || t.y != 0 || t.z != 0)
      course = QueryWay(t);
    else
      course.length = 1;
    if (r.x == 0 && r.y == 0 && r.z == 0) return;
    const QueryWay rotation(r);
    axis = rotation.along;
    angle = rotation.length;
  }

  /// All that the shape can reach about its origin: its box, and how far it can turn out of that.
  [[nodiscard]] PLUMB_HD Box carried(const QueryScene& scene) const {
    return reached(box_about(shape, turn, scene.hulls));
  }

  PLUMB_HD bool meets(const QueryScene& scene, const Target& target, double most, Meeting& meeting) const {
    CastTouch<double> touch;
    meeting.child = target.child;
    if (!touches(scene, target, most, touch, meeting.child)) return false;
    meeting.at = touch.at;
    meeting.at_start = touch.at_start;
    if (touch.at_start) return true;
    meeting.normal = rotate(target.turn, touch.normal);
    meeting.position = target.place + rotate(target.turn, touch.on_a);
    return true;
  }

 private:
  [[nodiscard]] PLUMB_HD Box reached(const Box& box) const {
    const Real all = shape.reach * (1 + 8 * kEpsilon), out = min(static_cast<Real>(angle), kPi) * all;
    const Vec most = {all, all, all}, more = {out, out, out};
    return {max(box.low - more, -most), min(box.high + more, most)};
  }
  PLUMB_HD bool touches(const QueryScene& scene, const Target& target, double most, CastTouch<double>& touch,
                        std::uint32_t& child) const {
    const SurfacePair pair = place_pair(scene, target, shape, start, turn);
    const TurningWay way = {rotate_back(target.turn, course.along), rotate_back(target.turn, axis),
                            angle / course.length, course.length, conjugate(target.turn) * turn};
    if (kKinds == Kinds::kAll && target.shape.type == ShapeType::kPlane)
      return cast_turning(pair, way, most, PartingPlaneBelow{}, touch);
    if (kKinds == Kinds::kFew || !is_surface(target.shape.type)) return meets_convex(pair, way, most, touch);
    std::uint32_t triangle;
    const Box about = reached(box_about(shape, way.at_start, scene.hulls));
    if (!cast_turning_at_surface(scene.surfaces, pair, way, about, most, touch, triangle)) return false;
    child = child_at(target, triangle);
    return true;
  }
  PLUMB_HD PLUMB_OUT_OF_LINE static bool meets_convex(const SurfacePair& pair, const TurningWay& way, double most,
                                                      CastTouch<double>& touch) {
    ShapeGap<double> beyond;
    if (is_beyond(pair.shift, beyond)) return false;
    return cast_turning(pair, way, most, PartingPair{}, touch);
  }
};

}  // namespace plumb::impulse
