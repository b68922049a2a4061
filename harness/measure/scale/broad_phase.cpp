// Measure of the broad phase alone: the pairs of bounding boxes that an engine finds, against the referee's.
#include <algorithm>
#include <cmath>
#include <set>
#include <unordered_map>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "measure/scale/scale.hpp"
#include "referee/world_penetration.hpp"
#include "scene/generators.hpp"

namespace plumb::harness {
namespace {

using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Anywhere in a cube about the origin; or in so many clumps of it, each tight.
void place(Scene& scene, const std::vector<std::size_t>& bodies, double extent, std::size_t clumps,
           std::uint64_t seed) {
  constexpr double tight = 0.5;  // of the extent that the bodies of a clump would have among themselves
  SplitMix64 random(seed);
  const auto within = [&](double side) {
    const auto coordinate = [&] { return side * (random.uniform() - 0.5); };
    const double x = coordinate(), y = coordinate(), z = coordinate();
    return referee::Vec3(x, y, z);
  };
  std::vector<referee::Vec3> centres(std::max<std::size_t>(clumps, 1), referee::Vec3::Zero());
  if (clumps > 0)
    for (referee::Vec3& centre : centres) centre = within(3 * extent);
  const double side = clumps > 0 ? tight * extent / std::cbrt(static_cast<double>(clumps)) : extent;
  for (std::size_t i = 0; i < bodies.size(); ++i)
    scene.bodies[bodies[i]].desc.pose.position = referee::plain(centres[i % centres.size()] + within(side));
}

/// Pairs of boxes that overlap by more than a hair, so that no rounding to float32 decides.
std::vector<Pair> overlapping(const std::vector<referee::PosedShape>& shapes) {
  constexpr double hair = 1e-3;  // m
  std::vector<Pair> pairs = referee::bounding_pairs(shapes);
  std::erase_if(pairs, [&](const Pair& pair) {
    const referee::Aabb a = shapes[pair.first].shape->bounds(shapes[pair.first].pose);
    const referee::Aabb b = shapes[pair.second].shape->bounds(shapes[pair.second].pose);
    return (a.high.cwiseMin(b.high) - a.low.cwiseMax(b.low)).minCoeff() < hair;
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace

void measure_broad_phase(MeasureContext& context) {
  Scene scene = context.scene();
  place(scene, arg_bodies(scene, "boxes"), arg_number(scene, "extent"),
        static_cast<std::size_t>(arg_number(scene, "clumps")), static_cast<std::uint64_t>(arg_number(scene, "seed")));
  Simulation simulation = context.simulate(scene);
  IDebug* debug = simulation.world().debug();
  if (debug == nullptr) throw Error(PLUMB_E_UNSUPPORTED, "pairs of the broad phase");
  std::vector<referee::ShapePtr> shapes;
  for (std::size_t i = 0; i < scene.shapes.size(); ++i) shapes.push_back(shape_of(scene, i));
  const auto posed = [&] {
    std::vector<referee::PosedShape> rows(scene.bodies.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i] = {shapes[*scene.bodies[i].shape].get(),
                 referee::pose(simulation.poses()[i].position, simulation.poses()[i].orientation), true};
    return rows;
  };
  // Engines tell the pairs of before the step or of after it: what overlaps at both times must be there.
  const std::vector<Pair> before = overlapping(posed());
  simulation.run();
  const std::vector<Pair> after = overlapping(posed());
  std::vector<Pair> truth;
  std::set_intersection(before.begin(), before.end(), after.begin(), after.end(), std::back_inserter(truth));

  std::unordered_map<PlumbBody, std::uint32_t> index;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) index[simulation.handle(i)] = static_cast<std::uint32_t>(i);
  std::span<const PlumbDebugPair> told;
  check(simulation.world(), debug->candidate_pairs(told));
  std::set<Pair> found;
  for (const PlumbDebugPair& pair : told) found.insert(std::minmax(index.at(pair.body_a), index.at(pair.body_b)));
  const auto missing =
      std::count_if(truth.begin(), truth.end(), [&](const Pair& pair) { return !found.contains(pair); });
  const auto pairs = static_cast<double>(truth.size());
  context.deviation("missing", static_cast<double>(missing));
  context.add({"pairs", pairs, std::nullopt, 0, std::nullopt, ""});
  context.add({"candidates", static_cast<double>(found.size()) / pairs, std::nullopt, 0, std::nullopt, ""});
  context.add({"step_time", simulation.statistics().step_ms.front(), std::nullopt, 0, std::nullopt, ""});
}

}  // namespace plumb::harness
