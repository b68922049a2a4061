// Measures of towers, pyramids, and a box on a box.
#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/drift.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/instruments/standing.hpp"
#include "measure/stacking/stacking.hpp"

namespace plumb::harness {
namespace {

constexpr double still = 0.01;  // m/s: slower is at rest

/// How much lower than at the start a body is, m.
double sink_of(const Scene& scene, std::span<const PoseRow> poses, std::size_t body) {
  return scene.bodies[body].desc.pose.position.y - poses[body].position.y;
}

double sideways(const Scene& scene, std::span<const PoseRow> poses, std::size_t body) {
  const PlumbVec3 &now = poses[body].position, &start = scene.bodies[body].desc.pose.position;
  return std::hypot(now.x - start.x, now.z - start.z);
}

}  // namespace

bool tower_stands(const Scene& scene, std::span<const PoseRow> poses, const std::vector<std::size_t>& boxes) {
  const double height = static_cast<double>(boxes.size()) * box_side;
  return sink_of(scene, poses, boxes.back()) <= height / 10;
}

bool tower_is_intact(const Scene& scene, std::span<const PoseRow> poses, const std::vector<std::size_t>& boxes) {
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    referee::Vec3 now = referee::vec(poses[boxes[i]].position);
    referee::Vec3 start = referee::vec(scene.bodies[boxes[i]].desc.pose.position);
    if (i > 0) {
      now -= referee::vec(poses[boxes[i - 1]].position);
      start -= referee::vec(scene.bodies[boxes[i - 1]].desc.pose.position);
    }
    if (!((now - start).norm() <= box_side / 2)) return false;
  }
  return true;
}

void measure_tower(MeasureContext& context) {
  const auto [scene, impulses] = with_wanted(context, PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES);
  const std::vector<std::size_t> boxes = arg_bodies(scene, "boxes");
  const double height = static_cast<double>(boxes.size()) * box_side, g = std::abs(scene.gravity.y);
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  ImpulseAccount account(simulation);
  Survival standing, intact;
  RestWatch rest(scene.seconds);
  double drift = 0, depth = 0;
  simulation.run([&](Simulation& now) {
    rest.add(now);
    standing.add(now.time(), tower_stands(scene, now.poses(), boxes));
    intact.add(now.time(), tower_is_intact(scene, now.poses(), boxes));
    for (const std::size_t box : boxes) drift = largest(drift, sideways(scene, now.poses(), box));
    if (!in_last_second(now)) return;
    depth = largest(depth, view.penetration(now.poses()).max);
    if (impulses) account.add(now);
  });
  add_survival(context, standing, simulation.time());
  context.compare("intact", intact.time(), simulation.time(), simulation.time());
  const std::span<const PoseRow> poses = simulation.poses();
  const double sink = sink_of(scene, poses, boxes.back());
  context.add({"sink", sink, 0.0, std::abs(sink) / height, std::nullopt, ""});
  context.deviation("drift", drift / box_side);
  context.deviation("depth", depth / box_side);
  double most_tilt = 0;
  for (const std::size_t box : boxes) most_tilt = largest(most_tilt, tilt_of(poses[box]));
  context.deviation("tilt", most_tilt);
  double weight = 0;
  for (const std::size_t box : boxes) weight += view.masses()[box].mass * g;
  context.deviation("kinetic_energy", view.energy(simulation).kinetic() / (weight * box_side));
  rest.add_to(context);
  if (impulses) add_ground_force(context, account, view.total_mass());
}

void measure_pyramid(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> boxes = arg_bodies(scene, "boxes");
  const auto base = static_cast<std::size_t>(std::lround(arg_number(scene, "base")));
  if (boxes.size() != base * (base + 1) / 2)
    throw UsageError("scene " + scene.id + ": a pyramid of this base has another number of boxes");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  const auto in_place = [&](std::size_t box) {
    return distance_from_start(scene, simulation.poses(), box) <= box_side / 2;
  };
  Survival survival;
  RestWatch rest(scene.seconds);
  double drift = 0;
  simulation.run([&](Simulation& now) {
    rest.add(now);
    survival.add(now.time(), survival.whole() && std::all_of(boxes.begin(), boxes.end(), in_place));
    for (const std::size_t box : boxes) drift = largest(drift, sideways(scene, now.poses(), box));
  });
  add_survival(context, survival, simulation.time());
  const auto kept = static_cast<double>(std::count_if(boxes.begin(), boxes.end(), in_place));
  context.deviation("drift", drift / box_side);
  rest.add_to(context);
  context.compare("in_place", kept, static_cast<double>(boxes.size()), static_cast<double>(boxes.size()));

  // The scene is its own mirror image: box i of a row answers to the i-th from the row's other end.
  double asymmetry = 0;
  std::size_t first = 0;
  for (std::size_t row = 0; row < base; first += base - row, ++row) {
    for (std::size_t i = 0; i < base - row; ++i) {
      const referee::Vec3 here = referee::vec(simulation.poses()[boxes[first + i]].position);
      const referee::Vec3 there = referee::vec(simulation.poses()[boxes[first + base - row - 1 - i]].position);
      asymmetry = largest(asymmetry, (here - there.cwiseProduct(referee::Vec3(-1, 1, 1))).norm());
    }
  }
  context.deviation("asymmetry", asymmetry / box_side);
  const DepthSummary depth = depth_summary(view.penetration(simulation.poses()));
  context.deviation("depth", depth.max / box_side);
  context.deviation("depth_p99", depth.p99 / box_side);
}

void measure_mass_ratio(MeasureContext& context) {
  const auto [scene, impulses] = with_wanted(context, PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES);
  const std::size_t lower = arg_body(scene, "lower"), upper = arg_body(scene, "upper");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  ImpulseAccount account(simulation);
  Survival survival;
  double settled = 0;
  simulation.run([&](Simulation& now) {
    survival.add(now.time(), tower_is_intact(scene, now.poses(), {lower, upper}));
    for (const std::size_t body : {lower, upper})
      if (!(referee::vec(now.velocities()[body].linear).norm() <= still)) settled = now.time();
    if (impulses && in_last_second(now)) account.add(now);
  });
  add_survival(context, survival, simulation.time());
  context.deviation("depth", view.penetration(simulation.poses()).max / box_side);
  context.deviation("settling", settled);
  if (!impulses) return;
  const double load = view.masses()[upper].mass * std::abs(scene.gravity.y);
  context.compare("load", account.between(lower, upper).normal, load, load);
  add_ground_force(context, account, view.total_mass());
}

}  // namespace plumb::harness
