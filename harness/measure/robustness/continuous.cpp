// Measures of what is too fast or too thin for one look a step: rods that spin through a wall, a bullet among boxes.
#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/robustness/robustness.hpp"

namespace plumb::harness {

void measure_spinning_rod(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> rods = arg_bodies(scene, "rods");
  const double half = arg_number(scene, "half_length"), face = arg_number(scene, "wall"),
               thickness = arg_number(scene, "thickness");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  const double start = view.energy(simulation).kinetic();
  std::vector<bool> through(rods.size());
  double depth = 0;
  simulation.run([&](Simulation& now) {
    depth = largest(depth, view.penetration(now.poses()).max);
    for (std::size_t i = 0; i < rods.size(); ++i) {
      const PoseRow& pose = now.poses()[rods[i]];
      const referee::Vec3 reach = referee::quat(pose.orientation) * referee::Vec3(0, half, 0);
      if (!(pose.position.x + std::abs(reach.x()) <= face + thickness)) through[i] = true;
    }
  });
  for (std::size_t i = 0; i < rods.size(); ++i)
    if (!(simulation.poses()[rods[i]].position.x <= face + thickness / 2)) through[i] = true;
  context.deviation("passed", static_cast<double>(std::count(through.begin(), through.end(), true)));
  context.deviation("depth", depth / thickness);
  context.add(
      {"energy_after", view.energy(simulation).kinetic() / start, std::nullopt, 0, std::nullopt, "of the start's"});
}

void measure_bullet_stack(MeasureContext& context) {
  constexpr double moving = 1e-3;  // m/s: what a cube must have to have been hit
  const Scene& scene = context.scene();
  const std::vector<std::size_t> boxes = arg_bodies(scene, "boxes");
  std::vector<std::size_t> row{arg_body(scene, "bullet")};
  row.insert(row.end(), boxes.begin(), boxes.end());
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  const referee::Vec3 momentum = referee::linear_momentum(view.states(simulation));
  std::vector<double> hit(row.size(), not_measured);
  hit.front() = 0;
  double change = 0;
  simulation.run([&](Simulation& now) {
    change = largest(change, (referee::linear_momentum(view.states(now)) - momentum).norm());
    for (std::size_t i = 1; i < row.size(); ++i)
      if (std::isnan(hit[i]) && referee::vec(now.velocities()[row[i]].linear).norm() > moving) hit[i] = now.time();
  });
  double disorder = 0, slowest_fit = 0;
  const double common = momentum.norm() / view.total_mass();
  for (std::size_t i = 0; i < row.size(); ++i) {
    const referee::Vec3 velocity = referee::vec(simulation.velocities()[row[i]].linear);
    slowest_fit = largest(slowest_fit, (velocity - momentum / view.total_mass()).norm());
    if (i == 0) continue;
    if (!(simulation.poses()[row[i - 1]].position.x < simulation.poses()[row[i]].position.x)) ++disorder;
    if (hit[i] < hit[i - 1]) ++disorder;
  }
  context.deviation("momentum", change / momentum.norm());
  context.deviation("out_of_order", disorder);
  context.expect("hit", !std::isnan(hit[1]), true);
  context.deviation("common_speed", slowest_fit / common);
}

}  // namespace plumb::harness
