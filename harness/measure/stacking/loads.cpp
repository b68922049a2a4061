// Measures of loads out of proportion: a big cube on small ones, and a load that is taken away.
#include <algorithm>
#include <array>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/instruments/standing.hpp"
#include "measure/stacking/stacking.hpp"

namespace plumb::harness {

void measure_big_on_small(MeasureContext& context) {
  constexpr double side = 1;  // m, of a small cube
  const auto [scene, impulses] = with_wanted(context, PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES);
  const std::size_t big = arg_body(scene, "big");
  const std::vector<std::size_t> small = arg_bodies(scene, "small");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  ImpulseAccount account(simulation);
  Survival survival;
  double depth = 0;
  simulation.run([&](Simulation& now) {
    const auto in_place = [&](std::size_t body) { return distance_from_start(scene, now.poses(), body) <= side / 2; };
    survival.add(now.time(), in_place(big) && std::all_of(small.begin(), small.end(), in_place));
    if (!in_last_second(now)) return;
    depth = largest(depth, view.penetration(now.poses()).max);
    if (impulses) account.add(now);
  });
  add_survival(context, survival, simulation.time());
  context.deviation("depth", depth / side);
  context.deviation("tilt", tilt_of(simulation.poses()[big]));
  if (!impulses) return;
  const double half = view.masses()[big].mass * std::abs(scene.gravity.y) / 2;
  double worst = 0, carried = half;
  for (const std::size_t body : small) {
    const double force = account.between(body, big).normal;
    if (!(std::abs(force - half) <= worst)) worst = std::abs(force - half), carried = force;
  }
  context.compare("load", carried, half, half);
}

void measure_taken_load(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t load = arg_body(scene, "load");
  const std::vector<std::size_t> balls = arg_bodies(scene, "balls");
  const double radius = scene.shapes[*scene.bodies[load].shape].desc.radius, time = arg_number(scene, "time");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  Survival survival;
  while (simulation.time() < time - scene.dt / 2 && simulation.advance())
    survival.add(simulation.time(), std::all_of(balls.begin(), balls.end(), [&](std::size_t ball) {
                   return distance_from_start(scene, simulation.poses(), ball) <= radius / 2;
                 }));
  const double depth = view.penetration(simulation.poses()).max;
  const std::array<double, 7> away{arg_number(scene, "away"), radius, 0, 0, 0, 0, 1};
  simulation.write(PLUMB_FIELD_POSE, load, away);
  simulation.write(PLUMB_FIELD_VELOCITY, load, std::array<double, 6>{});
  double jump = 0;
  simulation.run([&](Simulation& now) {
    for (const std::size_t ball : balls) jump = largest(jump, now.velocities()[ball].linear.y);
  });
  context.deviation("jump", jump / std::sqrt(std::abs(scene.gravity.y) * radius));
  context.expect("stood", survival.whole(), true);
  context.deviation("depth_before", depth / radius);
}

}  // namespace plumb::harness
