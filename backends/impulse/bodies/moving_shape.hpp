// A shape on its way through a step.
#pragma once

#include "bodies/way.hpp"

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
PLUMB_HD inline MovingShape moving_shape(const Bodies& bodies, const Proxies& proxies, const StepParameters& step,
                                         std::uint32_t proxy) {
  const Proxy& row = proxies.rows[proxy];
  return {&proxies.shapes[row.shape], row.frame, way_through_step(bodies, step, row.body)};
}

}  // namespace plumb::impulse
