// Measures of impacts among equal spheres without gravity: a row of them, and a pair that meets off centre.
#include <algorithm>
#include <cmath>

#include "measure/collision/collision.hpp"
#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "truth/contacts.hpp"

namespace plumb::harness {

void measure_cradle(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> balls = arg_bodies(scene, "balls");
  const bool touching = arg_number(scene, "touching") != 0;
  const double speed = scene.bodies[balls.front()].desc.linear_velocity.x;
  Simulation simulation = context.simulate(scene);
  simulation.run();
  const std::vector<double> sequential = truth::sequential_row(balls.size());
  const std::vector<double> simultaneous = truth::simultaneous_row(balls.size(), 1);
  double off_sequential = 0, off_simultaneous = 0, energy = 0;
  referee::Vec3 momentum = referee::Vec3::Zero();
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const referee::Vec3 v = referee::vec(simulation.velocities()[balls[i]].linear) / speed;
    off_sequential = largest(off_sequential, (v - sequential[i] * referee::Vec3::UnitX()).norm());
    off_simultaneous = largest(off_simultaneous, (v - simultaneous[i] * referee::Vec3::UnitX()).norm());
    energy += v.squaredNorm();
    momentum += v;
  }
  if (touching) {
    const bool in_turn = off_sequential < off_simultaneous;
    context.deviation("off_sequential", off_sequential, in_turn ? "the nearer answer" : "");
    context.deviation("off_simultaneous", off_simultaneous, in_turn ? "" : "the nearer answer");
  } else {
    context.deviation("off", off_sequential);
  }
  context.add({"energy_gain", energy - 1, 0.0, std::isnan(energy) ? energy : std::max(0.0, energy - 1), std::nullopt,
               "only a gain is an error"});
  context.deviation("momentum", (momentum - referee::Vec3::UnitX()).norm());
}

void measure_glancing_pair(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t runner = arg_body(scene, "runner"), target = arg_body(scene, "target");
  const double speed = scene.bodies[runner].desc.linear_velocity.x;
  const truth::GlancingImpact truth = truth::glancing_impact(arg_number(scene, "angle"), 1);
  Simulation simulation = context.simulate(scene);
  simulation.run();
  const referee::Vec3 a = referee::vec(simulation.velocities()[runner].linear) / speed;
  const referee::Vec3 b = referee::vec(simulation.velocities()[target].linear) / speed;
  context.deviation("velocity_runner", (a - truth.runner).norm());
  context.deviation("velocity_target", (b - truth.target).norm());
  context.compare("energy", a.squaredNorm() + b.squaredNorm(), 1, 1);
}

}  // namespace plumb::harness
