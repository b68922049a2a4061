// The box of a proxy in the broad phase: its shape's, and how far it may come before the next look.
#pragma once

#include "bodies/body.hpp"
#include "bodies/step_parameters.hpp"
#include "bodies/way.hpp"
#include "geometry/shape_box.hpp"

namespace plumb::impulse {

/// How far who bounces looks ahead in any case, as a share of its reach.
constexpr Real kStruckShare = Real(0.02);

struct BoundProxies {
  Bodies bodies;
  Proxies proxies;
  const StepParameters* parameters;
  const std::uint32_t* list;
  Box* boxes;
  Real* margins;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t index = list[i];
    const Proxy& proxy = proxies.rows[index];
    if (proxy.shape == kNone) {  // nobody
      boxes[index] = {{1, 1, 1}, {-1, -1, -1}};
      margins[index] = 0;
      return;
    }
    const Shape& shape = proxies.shapes[proxy.shape];
    const ShapePose pose = shape_pose(proxy, bodies.orientation[proxy.body]);
    const Vec centre = between(parameters->origin, bodies.position[proxy.body]) + pose.offset;
    const Real margin = look_ahead(proxy, shape);
    const Box local = shape_box(shape, pose.orientation, proxies.hulls);
    margins[index] = margin;
    boxes[index] = {outward(centre + local.low, -margin), outward(centre + local.high, margin)};
    if (is_swept(proxy.body)) cover_way(proxy, shape, boxes[index]);
  }

 private:
  [[nodiscard]] PLUMB_HD bool is_swept(std::uint32_t body) const {
    const std::uint32_t flags = bodies.mass[body].flags;
    if ((flags & (kBodyContinuous | kBodySweeps)) == 0) return false;
    const Velocity& velocity = bodies.velocity[body];
    return (flags & kBodyContinuous) != 0 || length_squared(velocity.linear) > 0 ||
           length_squared(velocity.angular) > 0;
  }
  /// All that the shape passes in the step, turns as it may.
  PLUMB_HD void cover_way(const Proxy& proxy, const Shape& shape, Box& box) const {
    const Vec centre = between(parameters->origin, bodies.position[proxy.body]);
    const Vec end = centre + parameters->dt * way_through_step(bodies, *parameters, proxy.body).linear;
    const Real reach = shape.reach + length(proxy.frame.position);
    const Vec ball = {reach, reach, reach};
    const Vec low = min(centre, end) - ball, high = max(centre, end) + ball;
    box = {min(box.low, outward(low, 0)), max(box.high, outward(high, 0))};
  }
  /// How far a point of the shape may travel in the step: contacts nearer than that are foreseen. Not beyond the
  /// shape's own size, or the plane of a contact would stand for a body that is elsewhere. What bounces passes a blow
  /// on within the step, even where it only just does not touch; a ground does not.
  PLUMB_HD Real look_ahead(const Proxy& proxy, const Shape& shape) const {
    const Velocity& velocity = bodies.velocity[proxy.body];
    const BodyMass& mass = bodies.mass[proxy.body];
    const Real reach = shape.reach + length(proxy.frame.position);
    const Real dt = parameters->dt;
    const bool dynamic = (mass.flags & kBodyDynamic) != 0;
    const Real falls = dynamic ? abs(mass.gravity_scale) * length(parameters->gravity) : 0;
    const Real travel = dt * (length(velocity.linear) + reach * length(velocity.angular)) + dt * dt * falls;
    const Real struck = dynamic && proxy.material.restitution > 0 ? kStruckShare * shape.reach : Real(0);
    return min(travel + struck, shape.reach);
  }

  /// Moved by `by`, and a few units in the last place more, away from zero margin: rounding must not lose a touch.
  PLUMB_HD static Vec outward(const Vec& corner, Real by) {
    const Real side = by < 0 ? Real(-1) : Real(1);
    const auto move = [&](Real x) { return x + by + side * (4 * kEpsilon) * (abs(x) + abs(by)); };
    return {move(corner.x), move(corner.y), move(corner.z)};
  }
};

}  // namespace plumb::impulse
