// When two shapes that move and turn come to touch within a step.
//
// Conservative advancement (Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996, section 2.3): the
// plane that parts the shapes, and how fast points may cross it, give a time before which nothing happens; from there
// it goes on, until the gap is small or the step is over. Turning counts by the furthest point of a shape.
#pragma once

#include "continuous/way.hpp"
#include "narrowphase/distance.hpp"

namespace plumb::impulse {

/// A shape on a body that moves.
struct MovingShape {
  const Shape* shape;
  Frame frame;  ///< in the body's principal frame
  Way way;

  [[nodiscard]] PLUMB_HD ShapePose pose(Real t) const {
    const Quat body = normalized(way.turn(t) * way.orientation);
    return {rotate(body, frame.position), body * frame.orientation};
  }
  /// The furthest that a point of it is from the body's centre of mass.
  [[nodiscard]] PLUMB_HD Real reach() const { return shape->reach + length(frame.position); }
};

struct Impact {
  Real time;  ///< s since the start of the step
  Real gap;   ///< that is left then, m
};

/// apart: from a's centre of mass to b's at the start. False where they do not come within `close` of each other before
/// `end`, or are so near at the start that it is the narrow phase's to see to.
PLUMB_HD inline bool find_impact(const MovingShape& a, const MovingShape& b, const Vec& apart, Real end, Real close,
                                 const Hulls& hulls, Impact& impact) {
  constexpr int kMostAdvances = 200;  // after them the impact is put where the search has come, which is before it
  const Real turning = length(a.way.angular) * a.reach() + length(b.way.angular) * b.reach();
  const Vec approach = a.way.linear - b.way.linear;
  impact.time = 0;
  for (int round = 0; round < kMostAdvances; ++round) {
    const Real t = impact.time;
    const ShapePose pose_a = a.pose(t), pose_b = b.pose(t);
    const Mat axes_a = to_matrix(pose_a.orientation);
    PlacedPair<Real> pair;
    pair.a = *a.shape;
    pair.b = *b.shape;
    pair.turn = to_matrix(conjugate(pose_a.orientation) * pose_b.orientation);
    pair.shift = multiply_transposed(axes_a, apart - t * approach + pose_b.offset - pose_a.offset);
    pair.hulls = hulls;
    const ShapeGap<Real> gap = shape_gap(pair);
    impact.gap = gap.cores_overlap ? Real(0) : max(gap.distance, Real(0));
    if (impact.gap <= close) return t > 0;
    const Real speed = dot(approach, axes_a * gap.normal) + turning;
    if (!(speed > 0)) return false;
    const Real next = t + (impact.gap - close / 2) / speed;
    if (!(next < end)) return false;
    if (!(next > t)) return t > 0;
    impact.time = next;
  }
  return true;
}

}  // namespace plumb::impulse
