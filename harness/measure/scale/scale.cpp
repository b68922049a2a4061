// Measure of throughput: many bodies, and the errors of the very run that was timed.
#include "measure/scale/scale.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "measure/instruments/args.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/instruments/standing.hpp"

namespace plumb::harness {
namespace {

/// Share of the stacks (equal runs of boxes) of which every box is within half a side of its start.
double standing(const Scene& scene, std::span<const PoseRow> poses, const std::vector<std::size_t>& boxes,
                std::size_t stack) {
  std::size_t whole = 0;
  for (std::size_t first = 0; first < boxes.size(); first += stack) {
    const auto in_place = [&](std::size_t box) {
      return (referee::vec(poses[box].position) - referee::vec(scene.bodies[box].desc.pose.position)).norm() <=
             box_side / 2;
    };
    const auto begin = boxes.begin() + static_cast<std::ptrdiff_t>(first);
    if (std::all_of(begin, begin + static_cast<std::ptrdiff_t>(stack), in_place)) ++whole;
  }
  return static_cast<double>(whole * stack) / static_cast<double>(boxes.size());
}

/// Bodies below the ground or further from the middle than `reach` (m).
double escaped(std::span<const PoseRow> poses, const std::vector<std::size_t>& boxes, double reach) {
  return static_cast<double>(std::count_if(boxes.begin(), boxes.end(), [&](std::size_t box) {
    const PlumbVec3& p = poses[box].position;
    return !(p.y > 0 && std::abs(p.x) <= reach && std::abs(p.z) <= reach);
  }));
}

void throughput(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> boxes = arg_bodies(scene, "boxes");
  const auto stack = static_cast<std::size_t>(arg_number(scene, "stack"));
  if (stack != 0 && boxes.size() % stack != 0)
    throw UsageError("scene " + scene.id + ": the boxes do not make whole stacks");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  referee::EnergyAccount energy;
  const double start = view.energy(simulation).total();  // above the ground, whose top is at height 0
  energy.add(start);
  simulation.run([&](Simulation& now) { energy.add(view.energy(now).total()); });

  const std::span<const PoseRow> poses = simulation.poses();
  const DepthSummary depth = depth_summary(view.penetration(poses));
  context.deviation("depth_max", depth.max / box_side);
  context.deviation("depth_p99", depth.p99 / box_side);
  context.deviation("depth_mean", depth.mean / box_side);
  context.deviation("energy_injected", energy.injected() / start);
  const referee::Energy end = view.energy(simulation);
  context.deviation("kinetic_energy", end.kinetic() / start);
  const double height = std::accumulate(boxes.begin(), boxes.end(), 0.0,
                                        [&](double sum, std::size_t box) { return sum + poses[box].position.y; }) /
                        static_cast<double>(boxes.size());
  context.add({"mean_height", height, std::nullopt, 0, std::nullopt, ""});
  context.add({"contacts", static_cast<double>(simulation.report().contacts), std::nullopt, 0, std::nullopt, ""});
  if (stack != 0) context.compare("standing", standing(scene, poses, boxes, stack), 1, 1);
  context.deviation("escaped", escaped(poses, boxes, arg_number(scene, "reach")));
}

}  // namespace

std::span<const MeasureEntry> scale_measures() {
  using enum ArgumentType;
  static constexpr MeasureArgument throughput_args[] = {{"boxes", bodies}, {"stack", number}, {"reach", number}};
  static constexpr MeasureArgument crowd_args[] = {{"size", number},
                                                   {"reach", number},
                                                   {"floor", number, may_be_left_out},
                                                   {"wave", number, may_be_left_out},
                                                   {"repeat", number, may_be_left_out},
                                                   {"stack", bodies, may_be_left_out},
                                                   {"launch", body, may_be_left_out},
                                                   {"launch_time", number, may_be_left_out},
                                                   {"speed", number, may_be_left_out},
                                                   {"drum", body, may_be_left_out},
                                                   {"rate", number, may_be_left_out},
                                                   {"radius", number, may_be_left_out},
                                                   {"length", number, may_be_left_out}};
  static constexpr MeasureArgument broad_args[] = {
      {"boxes", bodies}, {"extent", number}, {"clumps", number}, {"seed", number}};
  static constexpr MeasureEntry entries[] = {
      {"throughput", "depth, energy and order at the end of a large timed run", throughput_args, throughput},
      {"crowd", "depth, order and bounds of many bodies, driven or falling", crowd_args, measure_crowd},
      {"broad_phase", "pairs of bounding boxes against the referee's", broad_args, measure_broad_phase}};
  return entries;
}

}  // namespace plumb::harness
