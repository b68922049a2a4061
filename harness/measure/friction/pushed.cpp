// Measures of friction against forces that the host applies.
#include <algorithm>
#include <array>
#include <cmath>

#include "measure/friction/friction.hpp"
#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "truth/contacts.hpp"

namespace plumb::harness {

void measure_pushed_box(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t box = arg_body(scene, "box");
  const std::vector<std::size_t> balls = arg_bodies(scene, "balls");
  const double force = arg_number(scene, "force"), heading = arg_number(scene, "heading");
  const referee::Vec3 direction(std::sin(heading), 0, std::cos(heading));
  double balls_mass = 0;
  for (const std::size_t ball : balls) balls_mass += scene.bodies[ball].desc.mass;
  const truth::LoadedBox truth = truth::pushed_box(-scene.gravity.y, scene.bodies[box].desc.mass, balls_mass,
                                                   arg_number(scene, "friction"), force);
  Simulation simulation = context.simulate(scene);
  const referee::Vec3 push = force * direction;
  const std::array<double, 3> row{push.x(), push.y(), push.z()};
  double sum = 0, box_speed = 0, ball_speed = 0;
  while (true) {
    simulation.write(PLUMB_FIELD_FORCE, box, row);
    if (!simulation.advance()) break;
    const double t = simulation.time();
    const auto velocities = simulation.velocities();
    const referee::Vec3 v = referee::vec(velocities[box].linear);
    double square = 0;
    ball_speed = 0;
    for (const std::size_t ball : balls) {
      const referee::Vec3 u = referee::vec(velocities[ball].linear);
      square += (u - truth.ball * t * direction).squaredNorm() / static_cast<double>(balls.size());
      ball_speed += u.dot(direction) / static_cast<double>(balls.size());
    }
    box_speed = v.dot(direction);
    sum += (v - truth.box * t * direction).squaredNorm() + square;
  }
  const double t = simulation.time();
  context.deviation("squared_error", sum / static_cast<double>(simulation.steps()),
                    box_speed < 0.01 * truth.box * t ? "the box did not move" : "");
  context.compare("box_speed", box_speed, truth.box * t, truth.box * t);
  context.compare("ball_speed", ball_speed, truth.ball * t, truth.ball * t);
}

void measure_force_ramp(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double rate = arg_number(scene, "rate"), friction = arg_number(scene, "friction");
  const double mass = scene.bodies[body].desc.mass;
  const double onset = friction * mass * -scene.gravity.y / rate;
  Simulation simulation = context.simulate(scene);
  const double start = simulation.poses()[body].position.x;
  constexpr double moving = 1e-3;  // m/s
  double seen = not_measured, creep = 0;
  Series way;
  while (true) {
    // The mean force of the step: without it the ramp would lag by half a step.
    const std::array<double, 3> row{rate * (simulation.time() + scene.dt / 2), 0, 0};
    simulation.write(PLUMB_FIELD_FORCE, body, row);
    if (!simulation.advance()) break;
    const double x = simulation.poses()[body].position.x - start, v = simulation.velocities()[body].linear.x;
    way.add(simulation.time(), x);
    if (simulation.time() < 0.9 * onset) creep = largest(creep, std::abs(x));
    // After the onset v = rate t^2 / (2 m), which says how long ago it was. What moves and stops again has not begun.
    if (v <= moving) seen = not_measured;
    if (std::isnan(seen) && v > moving) seen = simulation.time() - std::sqrt(2 * mass * v / rate);
  }
  context.compare("onset", seen, onset, onset);
  const double truth = rate / (6 * mass);
  context.compare("distance", way.at(onset + 1), truth, truth);
  context.deviation("creep", creep);
}

}  // namespace plumb::harness
