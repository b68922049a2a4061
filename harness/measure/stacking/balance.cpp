// Measures of stacks at the edge of balance: a run on either side of an exact critical value.
#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/instruments/standing.hpp"
#include "measure/stacking/stacking.hpp"
#include "truth/structures.hpp"

namespace plumb::harness {
void measure_overhang(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> blocks = arg_bodies(scene, "blocks");
  const double share = arg_number(scene, "share");
  const PlumbVec3 half = scene.shapes[*scene.bodies[blocks.back()].shape].desc.half_extents;
  Simulation simulation = context.simulate(scene);
  Survival survival;
  simulation.run([&](Simulation& now) {
    survival.add(now.time(), std::all_of(blocks.begin(), blocks.end(), [&](std::size_t block) {
                   return distance_from_start(scene, now.poses(), block) <= half.y;
                 }));
  });
  context.expect("stands", survival.whole(), share <= 1);
  context.add({"survival", survival.time(), std::nullopt, 0, std::nullopt, ""});
  double moved = 0;
  for (const std::size_t block : blocks) moved = largest(moved, distance_from_start(scene, simulation.poses(), block));
  if (share <= 1) context.deviation("creep", moved / (2 * half.x));
}

void measure_four_spheres(MeasureContext& context) {
  const auto [scene, impulses] = with_wanted(context, PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES);
  const std::size_t top = arg_body(scene, "top"), ground = arg_body(scene, "ground");
  const std::vector<std::size_t> base = arg_bodies(scene, "base");
  const double radius = scene.shapes[*scene.bodies[top].shape].desc.radius;
  const truth::FourSpheres truth = truth::four_spheres();
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  ImpulseAccount account(simulation);
  Survival survival;
  simulation.run([&](Simulation& now) {
    survival.add(now.time(), distance_from_start(scene, now.poses(), top) <= radius / 5);
    if (impulses && in_last_second(now)) account.add(now);
  });
  const bool should_stand = arg_number(scene, "friction") >= truth.critical_friction;
  context.expect("stands", survival.whole(), should_stand);
  context.add({"survival", survival.time(), std::nullopt, 0, std::nullopt, ""});
  if (!should_stand || !impulses) return;
  const double weight = view.masses()[top].mass * std::abs(scene.gravity.y);
  double normal = 0, friction = 0, carried = 0;
  for (const std::size_t sphere : base) {
    const auto count = static_cast<double>(base.size());
    normal += account.between(sphere, top).normal / count;
    friction += account.between(sphere, top).tangent / count;
    carried += account.between(ground, sphere).normal / count;
  }
  context.compare("normal_force", normal, truth.normal * weight, truth.normal * weight);
  context.compare("friction_force", friction, truth.friction * weight, truth.friction * weight);
  context.compare("ground_force", carried, truth.ground * weight, truth.ground * weight);
}

}  // namespace plumb::harness
