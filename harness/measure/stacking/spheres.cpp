// Measure of many spheres without friction that fall on the ground and scatter.
#include <algorithm>

#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/stacking/stacking.hpp"

namespace plumb::harness {

void measure_sphere_lattice(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> spheres = arg_bodies(scene, "spheres");
  const double radius = scene.shapes[*scene.bodies[spheres.front()].shape].desc.radius;
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  double sum = 0, deepest = 0;
  referee::EnergyAccount energy;
  energy.add(view.energy(simulation).total());
  const double start = view.energy(simulation).total();
  simulation.run([&](Simulation& now) {
    const referee::WorldPenetration overlaps = view.penetration(now.poses());
    sum += overlaps.sum_of_squares;
    deepest = largest(deepest, overlaps.max);
    energy.add(view.energy(now).total());
  });
  context.deviation("overlap", sum / static_cast<double>(simulation.steps()));
  context.deviation("depth", deepest / radius);
  context.deviation("energy_injected", energy.injected() / start);
}

}  // namespace plumb::harness
