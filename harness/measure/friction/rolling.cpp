// Measures of friction that turns bodies: rolling and spinning to a stop.
#include <algorithm>
#include <cmath>

#include "measure/friction/friction.hpp"
#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "truth/contacts.hpp"

namespace plumb::harness {

void measure_slide_to_roll(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double radius = arg_number(scene, "radius"), friction = arg_number(scene, "friction");
  const double speed = arg_number(scene, "speed"), g = -scene.gravity.y;
  const truth::SlideToRoll truth =
      truth::slide_to_roll(g, friction, arg_number(scene, "inertia_factor"), speed, arg_number(scene, "surface_spin"));
  Simulation simulation = context.simulate(scene);
  const double start = simulation.poses()[body].position.x;
  Series slip, velocity, way;
  const auto observe = [&](Simulation& now) {
    const VelocityRow& row = now.velocities()[body];
    slip.add(now.time(), row.linear.x + radius * row.angular.z);  // rolling along +x turns about -z
    velocity.add(now.time(), row.linear.x);
    way.add(now.time(), now.poses()[body].position.x - start);
  };
  observe(simulation);
  simulation.run(observe);

  const double end = velocity.back().time;
  const double time = slip.end_of_fall().value_or(not_measured);
  const bool rolls = time < end - 0.5;
  // A few steps later, because the last slip ends within a step or two.
  const double settled = time + 4 * scene.dt;
  const double rolling = rolls ? velocity.at(settled) : not_measured;
  context.compare("rolling_speed", rolling, truth.speed, truth.speed);
  context.compare("rolling_time", time, truth.time, truth.time);
  compare_biased(context, "rolling_distance", rolls ? way.at(time) : not_measured, truth.distance, truth.distance,
                 truth.distance - friction * g * truth.time * scene.dt / 2);
  context.deviation("loss", rolls ? std::abs(1 - velocity.back().value / rolling) / (end - settled) : not_measured);
  context.deviation("slip", std::abs(slip.back().value) / speed);
}

void measure_roll_down(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double radius = arg_number(scene, "radius"), slope = arg_number(scene, "slope"), g = -scene.gravity.y;
  const truth::RollDown truth =
      truth::roll_down(g, slope, arg_number(scene, "friction"), arg_number(scene, "inertia_factor"));
  const referee::Vec3 downhill(-std::cos(slope), -std::sin(slope), 0);
  Simulation simulation = context.simulate(scene);
  const referee::Vec3 start = referee::vec(simulation.poses()[body].position);
  simulation.run();
  const double t = simulation.time();
  const double distance = (referee::vec(simulation.poses()[body].position) - start).dot(downhill);
  const double expected = truth.acceleration * t * t / 2;
  compare_biased(context, "distance", distance, expected, expected, expected * (1 + scene.dt / t));
  const VelocityRow& row = simulation.velocities()[body];
  const double ratio =
      radius * row.angular.z / referee::vec(row.linear).dot(downhill);  // downhill is -x: turns about +z
  context.compare("slip_ratio", ratio, truth.turning / truth.acceleration, 1);
}

void measure_spin_stop(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double side = arg_number(scene, "side"), friction = arg_number(scene, "friction"),
               spin = arg_number(scene, "spin");
  const double g = -scene.gravity.y;
  const truth::SpinStop corners = truth::spin_stop(g, friction, side, truth::corner_lever(side), spin);
  const truth::SpinStop spread = truth::spin_stop(g, friction, side, truth::uniform_lever(side), spin);
  Simulation simulation = context.simulate(scene);
  const referee::Vec3 start = referee::vec(simulation.poses()[body].position);
  Series rate;
  Unwrapped unwrap;
  double yaw = 0, drift = 0;
  const auto observe = [&](Simulation& now) {
    const referee::Vec3 x = referee::quat(now.poses()[body].orientation) * referee::Vec3::UnitX();
    yaw = unwrap(std::atan2(-x.z(), x.x()));
    rate.add(now.time(), now.velocities()[body].angular.y);
    const referee::Vec3 moved = referee::vec(now.poses()[body].position) - start;
    drift = largest(drift, std::hypot(moved.x(), moved.z()));
  };
  observe(simulation);
  simulation.run(observe);
  const double time = rate.end_of_fall().value_or(not_measured);
  // Which model the engine has is not an error: it is held against the nearer one, and the note says which.
  const bool nearer_corners = std::abs(time - corners.time) < std::abs(time - spread.time);
  const truth::SpinStop& truth = nearer_corners ? corners : spread;
  const std::string note = nearer_corners ? "weight on the four corners" : "weight spread evenly";
  context.compare("stop_time", time, truth.time, truth.time, note);
  context.compare("stop_angle", yaw, truth.angle, truth.angle, note);
  context.deviation("drift", drift / side);
}

}  // namespace plumb::harness
