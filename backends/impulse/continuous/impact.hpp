// When two shapes that move and turn come to touch within a step.
//
// Conservative advancement (Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996, section 2.3): the
// plane that parts the shapes, and how fast points may cross it, give a time before which nothing happens; from there
// it goes on, until the gap is small or the step is over. Turning counts by the furthest point of a shape.
#pragma once

#include "bodies/moving_shape.hpp"
#include "narrowphase/convex/distance.hpp"
#include "narrowphase/triangle/triangle_core.hpp"

namespace plumb::impulse {

struct Impact {
  Real time;  ///< since the start of the way, in units of its end: of a step s
  Real gap;   ///< that is left then, m
};
enum class Course {
  kMiss,   ///< they do not come near each other
  kNear,   ///< they are so near at the start that it is the narrow phase's to see to
  kImpact  ///< they come near each other within the step
};

/// What parts two shapes.
struct PartingPlane {
  Real gap;    ///< 0 where they overlap
  Vec normal;  ///< unit, from A to B, world axes
};

/// approach: of A's centre of mass towards B's, m/s; turning: what turns add to the speed of any point, m/s. What comes
/// within `close` is near. part(t): the PartingPlane at time t.
template <class Part>
PLUMB_HD Course advance(const Vec& approach, Real turning, Real end, Real close, const Part& part, Impact& impact) {
  constexpr int kMostAdvances = 200;  // after them the impact is put where the search has come, which is before it
  impact.time = 0;
  for (int round = 0; round < kMostAdvances; ++round) {
    const Real t = impact.time;
    const PartingPlane plane = part(t);
    impact.gap = plane.gap;
    if (impact.gap <= close) return t > 0 ? Course::kImpact : Course::kNear;
    const Real speed = dot(approach, plane.normal) + turning;
    if (!(speed > 0)) return Course::kMiss;
    const Real next = t + (impact.gap - close / 2) / speed;
    if (!(next < end)) return Course::kMiss;
    if (!(next > t)) return t > 0 ? Course::kImpact : Course::kNear;
    impact.time = next;
  }
  return Course::kImpact;
}

/// Of two convex shapes. apart: from a's centre of mass to b's at the start.
PLUMB_HD inline Course find_impact(const MovingShape& a, const MovingShape& b, const Vec& apart, Real end, Real close,
                                   const Hulls& hulls, Impact& impact) {
  const Real turning = length(a.way.angular) * a.reach() + length(b.way.angular) * b.reach();
  const Vec approach = a.way.linear - b.way.linear;
  const auto part = [&](Real t) {
    const ShapePose pose_a = a.pose(t), pose_b = b.pose(t);
    const Mat axes_a = to_matrix(pose_a.orientation);
    PlacedPair<Real> pair;
    pair.a = *a.shape;
    pair.b = *b.shape;
    pair.turn = to_matrix(conjugate(pose_a.orientation) * pose_b.orientation);
    pair.shift = multiply_transposed(axes_a, apart - t * approach + pose_b.offset - pose_a.offset);
    pair.hulls = hulls;
    const ShapeGap<Real> gap = shape_gap(pair);
    if (gap.cores_overlap) return PartingPlane{0, {0, 0, 0}};
    return PartingPlane{max(gap.distance, Real(0)), axes_a * gap.normal};
  };
  return advance(approach, turning, end, close, part, impact);
}

/// Of a triangle of the surface a, and the convex shape b.
PLUMB_HD inline Course find_impact_on_triangle(const MovingShape& a, const Triangle& triangle, const MovingShape& b,
                                               const Vec& apart, Real end, Real close, const Hulls& hulls,
                                               Impact& impact) {
  const Vec &first = triangle.at[0], along = triangle.at[1] - first, beside = triangle.at[2] - first;
  const Real furthest = length(first) + max(length(along), length(beside)) + length(a.frame.position);
  const Real turning = length(a.way.angular) * furthest + length(b.way.angular) * b.reach();
  const Vec approach = a.way.linear - b.way.linear;
  const auto part = [&](Real t) {
    const ShapePose pose_a = a.pose(t), pose_b = b.pose(t);
    const Mat axes_a = to_matrix(pose_a.orientation);
    const PlacedPair<Real> placed = {*a.shape, *b.shape, to_matrix(conjugate(pose_a.orientation) * pose_b.orientation),
                                     multiply_transposed(axes_a, apart - t * approach + pose_b.offset - pose_a.offset),
                                     hulls};
    const TrianglePair<Real> pair(triangle, placed, first);
    Simplex<Real> simplex;
    const CoreGap<Real> gap = core_gap(pair, simplex, kHuge);
    if (gap.overlap) return PartingPlane{0, {0, 0, 0}};
    return PartingPlane{max(gap.distance - core_radius(*b.shape), Real(0)), axes_a * gap.normal};
  };
  return advance(approach, turning, end, close, part, impact);
}

/// Of a plane, which does not move, and the convex shape b.
PLUMB_HD inline Course find_impact_on_plane(const MovingShape& a, const MovingShape& b, const Vec& apart, Real end,
                                            Real close, const Hulls& hulls, Impact& impact) {
  const ShapePose pose_a = a.pose(0);
  const Vec normal = rotate(pose_a.orientation, Vec{0, 1, 0});
  const auto part = [&](Real t) {
    const ShapePose pose_b = b.pose(t);
    const Vec lowest =
        rotate(pose_b.orientation, core_support(*b.shape, hulls, rotate_back(pose_b.orientation, -normal)));
    const Vec at = apart + t * b.way.linear + pose_b.offset - pose_a.offset + lowest;
    return PartingPlane{max(dot(at, normal) - core_radius(*b.shape), Real(0)), normal};
  };
  return advance(-b.way.linear, length(b.way.angular) * b.reach(), end, close, part, impact);
}

}  // namespace plumb::impulse
