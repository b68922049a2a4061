// Measures of rods that lean: Painleve's, which no finite force can carry on, and a ladder.
#include <algorithm>
#include <cmath>

#include "measure/friction/friction.hpp"
#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "truth/limit_analysis.hpp"

namespace plumb::harness {
namespace {

/// Largest distance of an impulse of the last step from its cone, N s; -1 when none is known.
double worst_cone(Simulation& simulation, const RefereeView& view) {
  const Scene& scene = simulation.scene();
  const std::vector<referee::BodyState> states = view.states(simulation);
  std::vector<referee::ContactSample> samples;
  for (const PlumbContact& contact : simulation.contacts()) {
    std::size_t a = 0, b = 0;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
      if (simulation.handle(i) == contact.body_a) a = i;
      if (simulation.handle(i) == contact.body_b) b = i;
    }
    const double friction = std::sqrt(scene.bodies[a].desc.material.friction * scene.bodies[b].desc.material.friction);
    samples.push_back({&contact, &states[a], &states[b], friction});
  }
  const referee::Scale scale = referee::scale_of(view.total_mass(), referee::vec(scene.gravity).norm(), scene.dt, 1.0);
  const referee::ContactQuality quality = referee::contact_quality(samples, scale);
  return quality.contacts > quality.without_impulse ? quality.cone_distance_max * scale.impulse : -1;
}

}  // namespace

void measure_painleve(MeasureContext& context) {
  const auto [scene, impulses] = with_wanted(context, PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES);
  const double length = arg_number(scene, "length");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  const double start = view.energy(simulation).total();
  const double momentum = referee::linear_momentum(view.states(simulation)).norm();
  double highest = start, depth = 0, cone = -1;
  simulation.run([&](Simulation& now) {
    highest = largest(highest, view.energy(now).total());
    depth = largest(depth, view.penetration(now.poses()).max);
    if (impulses) cone = largest(cone, worst_cone(now, view));
  });
  context.expect("finite", simulation.finite() && std::isfinite(highest), true);
  context.deviation("energy_rise", highest / start - 1);
  context.deviation("depth", depth / length);
  if (cone >= 0) context.deviation("cone", cone / momentum);
}

void measure_ladder(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t ladder = arg_body(scene, "ladder");
  const double length = arg_number(scene, "length");
  const double critical = truth::ladder_slope(length, arg_number(scene, "radius"), arg_number(scene, "friction"));
  Simulation simulation = context.simulate(scene);
  const referee::Vec3 start = referee::vec(simulation.poses()[ladder].position);
  double way = 0;
  simulation.run(
      [&](Simulation& now) { way = largest(way, (referee::vec(now.poses()[ladder].position) - start).norm()); });
  context.expect("stands", way <= length / 20, arg_number(scene, "slope") >= critical);
  context.deviation("way", way / length);
}

}  // namespace plumb::harness
