// Measure of what the inner edges of a triangulated plane do to bodies that slide or roll over it.
#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "measure/robustness/robustness.hpp"

namespace plumb::harness {

void measure_inner_edges(MeasureContext& context) {
  constexpr double landing = 0.25;  // s, after which all that is left of being set down has died
  const Scene& scene = context.scene();
  const std::vector<std::size_t> bodies = arg_bodies(scene, "bodies");
  const double friction = arg_number(scene, "friction"), speed = arg_number(scene, "speed"), g = -scene.gravity.y;
  const bool slides = arg_number(scene, "slides") != 0;
  Simulation simulation = context.simulate(scene);
  double rise = 0;
  simulation.run([&](Simulation& now) {
    if (now.time() < landing) return;
    for (const std::size_t body : bodies) rise = largest(rise, std::abs(now.velocities()[body].linear.y));
  });
  // What slides stops; what rolls goes on.
  const double truth = slides ? speed * speed / (2 * friction * g) : speed * simulation.time();
  const double scheme = slides ? truth - speed * scene.dt / 2 : truth;
  double sum = 0, worst = 0, worst_of_scheme = 0, aside = 0;
  for (const std::size_t body : bodies) {
    const referee::Vec3 heading = referee::vec(scene.bodies[body].desc.linear_velocity).normalized();
    const referee::Vec3 way =
        referee::vec(simulation.poses()[body].position) - referee::vec(scene.bodies[body].desc.pose.position);
    const double distance = way.dot(heading);
    sum += distance;
    worst = largest(worst, std::abs(distance - truth) / truth);
    worst_of_scheme = largest(worst_of_scheme, std::abs(distance - scheme) / truth);
    aside = largest(aside, (way - distance * heading).norm() / truth);
  }
  context.add(
      {"distance", sum / static_cast<double>(bodies.size()), truth, worst, worst_of_scheme, "error of the worst body"});
  context.deviation("rise", rise / speed);
  context.deviation("aside", aside);
}

}  // namespace plumb::harness
