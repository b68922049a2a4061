// Measures of a motor and of a limit.
#include <algorithm>
#include <array>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "measure/joints/joints.hpp"
#include "truth/structures.hpp"

namespace plumb::harness {
namespace {}  // namespace

void measure_motor(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t disc = arg_body(scene, "disc");
  const double torque = arg_number(scene, "torque"), target = arg_number(scene, "target");
  const double load = arg_number(scene, "load"), start = scene.bodies[disc].desc.angular_velocity.z;
  Simulation simulation = context.simulate(scene);
  const double inertia = state_of(simulation, disc, mass_of_body(scene, disc)).inertia()(2, 2);
  Unwrapped unwrap;
  double angle = 0;
  while (true) {
    if (load != 0) simulation.write(PLUMB_FIELD_TORQUE, disc, std::array{0.0, 0.0, -load});
    if (!simulation.advance()) break;
    angle = unwrap(turn_about_z(scene, simulation.poses(), disc));
  }
  // The motor gives all its torque until it has reached its target, and then what the load takes.
  const double seconds = simulation.time(), acceleration = (torque - load) / inertia;
  const double driving = std::min(seconds, (target - start) / acceleration);
  const double speed = start + acceleration * driving;
  const double truth = start * driving + acceleration * driving * driving / 2 + target * (seconds - driving);
  const double bias = acceleration * driving * scene.dt / 2;
  context.compare("speed", simulation.velocities()[disc].angular.z, speed, speed);
  compare_biased(context, "angle", angle, truth, truth, truth + bias);
}

void measure_limit_stop(MeasureContext& context) {
  constexpr double before = 0.25 / degrees;  // the stop counts as reached here: an engine need not go beyond it
  const Scene& scene = context.scene();
  const std::size_t rod = arg_body(scene, "rod");
  const double length = arg_number(scene, "length"), stop = arg_number(scene, "stop"), g = std::abs(scene.gravity.y);
  Simulation simulation = context.simulate(scene);
  Series fallen;
  double fastest = 0, deepest = 0;
  const auto observe = [&](Simulation& now) {
    fallen.add(now.time(), -turn_about_z(scene, now.poses(), rod));
    fastest = largest(fastest, -now.velocities()[rod].angular.z);
    deepest = largest(deepest, fallen.back().value - stop);
  };
  observe(simulation);
  simulation.run(observe);
  const std::vector<double> hits = fallen.crossings(stop - before);
  const double hit = hits.empty() ? not_measured : hits.front();
  context.compare("hit_time", hit, truth::falling_rod_time(g, length, stop - before), 1);
  const double speed = truth::falling_rod_speed(g, length, stop);
  context.compare("hit_speed", fastest, speed, speed);
  context.deviation("overshoot", deepest * degrees);
  context.compare("rest_angle", fallen.back().value * degrees, stop * degrees, 1);
}

}  // namespace plumb::harness
