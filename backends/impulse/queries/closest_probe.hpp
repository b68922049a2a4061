// How far a shape of the world is from one that is looked around, and where: what a query for the closest asks of a
// proxy. As the probes of probes.hpp it comes for scenes of spheres, boxes, capsules and hulls alone, and for all.
#pragma once

#include <limits>

#include "plumb/closest.h"
#include "queries/closest_search.hpp"
#include "queries/probes.hpp"

namespace plumb::impulse {

/// A place that is not told.
PLUMB_HD inline PlumbVec3 nowhere() {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  return {kUnknown, kUnknown, kUnknown};
}

/// The nearest point of a plane or surface; false where it is further away than `most`. turn: of B.
PLUMB_HD PLUMB_OUT_OF_LINE inline bool gap_to_surface(const Surfaces& surfaces, const SurfacePair& pair,
                                                      const Quat64& turn, double most, ShapeGap<double>& gap,
                                                      std::uint32_t& triangle) {
  surface::NearestTriangle nearest;
  nearest.gap.distance = most;
  const Box about = box_about(pair.b, turn, pair.hulls);
  const Vec at = to_numbers<Real>(pair.shift), rounding = (4 * kEpsilon) * abs(at);
  with_surface(surfaces, pair.a, [&](const auto& on) {
    surface::find_nearest(on, Box{at + about.low - rounding, at + about.high + rounding}, pair, nearest);
  });
  gap = nearest.gap;
  triangle = nearest.triangle;
  return triangle != kNoCorner;
}

template <Kinds kKinds>
struct ClosestProbe {
  using Row = PlumbProbe;
  Vec64 start;
  ProxyFilter filter;
  Shape shape;
  Quat64 turn;
  double most;  ///< m

  PLUMB_HD ClosestProbe(const QueryScene& scene, const PlumbProbe& probe)
      : start(to_vec64(probe.pose.position)),
        filter(to_proxy_filter(probe.filter)),
        shape(scene.shapes[row_of(probe.shape)]),
        turn(to_quat64(probe.pose.orientation)),
        most(probe.most_distance) {}
  [[nodiscard]] PLUMB_HD BoxAround around(const QueryScene& scene) const {
    return {start - scene.origin, box_about(shape, turn, scene.hulls), most};
  }

  /// Of a target that is no further away than `enough` all but the probe's number; false: it is further away.
  PLUMB_HD bool finds(const QueryScene& scene, const Target& target, double enough, PlumbClosest& row) const {
    const PlacedPair<double> pair = place_pair(scene, target, shape, start, turn);
    ShapeGap<double> gap;
    row.child = target.child;
    if (!gap_of(scene, target, pair, enough, gap, row.child)) return false;
    row.body = scene.ids[target.body];
    row.distance = 0;
    row.on_probe = row.on_body = row.normal = nowhere();
    if (gap.cores_overlap || !(gap.distance > 0)) return true;
    row.distance = gap.distance;
    row.on_probe = to_plumb_vec3(target.place + rotate(target.turn, gap.on_b));
    row.on_body = to_plumb_vec3(target.place + rotate(target.turn, gap.on_a));
    row.normal = to_plumb_vec3(-rotate(target.turn, gap.normal));
    return true;
  }

 private:
  /// Seen from the target, which is A.
  PLUMB_HD bool gap_of(const QueryScene& scene, const Target& target, const PlacedPair<double>& pair, double enough,
                       ShapeGap<double>& gap, std::uint32_t& child) const {
    if (kKinds == Kinds::kAll && target.shape.type == ShapeType::kPlane) {
      const Vec64 lowest = plane::lowest(pair);
      gap = {false, lowest.y, {0, 1, 0}, {lowest.x, 0, lowest.z}, lowest};
      return lowest.y <= enough;
    }
    if (is_beyond(pair.shift, gap)) return gap.distance <= enough;
    if (kKinds == Kinds::kFew || !is_surface(target.shape.type)) return convex_gap(pair, enough, gap);
    std::uint32_t triangle;
    if (!gap_to_surface(scene.surfaces, pair, conjugate(target.turn) * turn, enough, gap, triangle)) return false;
    child = child_at(target, triangle);
    return true;
  }
  PLUMB_HD static bool convex_gap(const PlacedPair<double>& pair, double enough, ShapeGap<double>& gap) {
    if (length(pair.shift) - pair.reach() * (1 + 0x1p-10) > enough) return false;
    Simplex<double> simplex;
    const CoreGap<double> core = core_gap(pair, simplex, enough + pair.radii());
    gap = to_shape_gap(pair, core);
    return gap.cores_overlap || gap.distance <= enough;
  }
};

}  // namespace plumb::impulse
