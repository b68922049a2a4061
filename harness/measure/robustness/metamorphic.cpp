// Metamorphic measures: the truth is an exact symmetry of mechanics. The scene and its transformed copy run side by
// side; what the copy does, transformed back, must be what the scene does.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include "measure/instruments/args.hpp"
#include "measure/instruments/series.hpp"
#include "measure/instruments/standing.hpp"
#include "measure/instruments/transform.hpp"
#include "measure/robustness/robustness.hpp"
#include "scene/generators.hpp"

namespace plumb::harness {
namespace {

using referee::vec;
using referee::Vec3;

/// From the copy's world to the scene's: where, and when, s.
using WayBack = std::function<Vec3(const Vec3&, double)>;

/// Largest distance of any body's centre between the scene and its copy at any step.
double follow(Simulation& original, Simulation& copy, const WayBack& back) {
  double worst = 0;
  while (original.advance() && copy.advance())
    for (std::size_t i = 0; i < original.poses().size(); ++i)
      worst =
          largest(worst, (back(vec(copy.poses()[i].position), copy.time()) - vec(original.poses()[i].position)).norm());
  if (original.steps() != copy.steps()) return not_measured;
  return worst;
}

/// Metric "deviation". An engine that refuses the copy, whose numbers are all legal, has not done the same either.
void follow(MeasureContext& context, const Scene& copied, const WayBack& back) {
  Simulation original = context.simulate(context.scene());
  try {
    Simulation copy = context.simulate(copied);
    context.deviation("deviation", follow(original, copy, back) / box_side);
  } catch (const Error& error) {
    if (error.code() != PLUMB_E_INVALID_ARGUMENT) throw;
    original.run();
    context.deviation("deviation", not_measured, std::string("the copy was refused: ") + error.what());
  }
}

/// Steps two simulations of one scene together; true while every state is the same, bit for bit.
bool same_bits(Simulation& one, Simulation& other) {
  bool same = true;
  while (one.advance() && other.advance()) same = same && one.state_hash() == other.state_hash();
  return same;
}

/// A shuffle by a fixed rule (Fisher, Yates), other for every seed; statics stay where they are.
std::vector<std::size_t> shuffled(const Scene& scene, std::uint64_t seed) {
  std::vector<std::size_t> order(scene.bodies.size()), moving;
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = 0; i < order.size(); ++i)
    if (scene.bodies[i].desc.motion == PLUMB_DYNAMIC) moving.push_back(i);
  SplitMix64 random(seed);
  for (std::size_t i = moving.size(); i > 1; --i) std::swap(order[moving[i - 1]], order[moving[random.next() % i]]);
  return order;
}

bool in_place(const Scene& scene, std::span<const PoseRow> poses) {
  for (std::size_t i = 0; i < poses.size(); ++i)
    if (!((vec(poses[i].position) - vec(scene.bodies[i].desc.pose.position)).norm() <= box_side / 2)) return false;
  return true;
}

}  // namespace

void measure_similarity(MeasureContext& context) {
  const double factor = arg_number(context.scene(), "factor");
  const auto back = [&](const Vec3& x, double) -> Vec3 { return x / factor; };
  follow(context, scaled(context.scene(), factor), back);
}

void measure_mass_scaling(MeasureContext& context) {
  const Scene copy = heavier(context.scene(), arg_number(context.scene(), "factor"));
  follow(context, copy, [](const Vec3& x, double) { return x; });
}

void measure_translation(MeasureContext& context) {
  const Vec3 offset(arg_number(context.scene(), "offset"), 0, 0);
  const auto back = [&](const Vec3& x, double) -> Vec3 { return x - offset; };
  follow(context, translated(context.scene(), offset), back);
}

void measure_rotation(MeasureContext& context) {
  const std::vector<double> axis = arg_numbers(context.scene(), "axis");
  const referee::Quat turn(
      Eigen::AngleAxisd(arg_number(context.scene(), "angle"), Vec3(axis.at(0), axis.at(1), axis.at(2)).normalized()));
  const auto back = [&](const Vec3& x, double) -> Vec3 { return turn.conjugate() * x; };
  follow(context, rotated(context.scene(), turn), back);
}

void measure_galilean(MeasureContext& context) {
  const std::vector<double> numbers = arg_numbers(context.scene(), "velocity");
  const Vec3 velocity(numbers.at(0), numbers.at(1), numbers.at(2));
  const auto back = [&](const Vec3& x, double t) -> Vec3 { return x - t * velocity; };
  follow(context, boosted(context.scene(), velocity), back);
}

void measure_repeat(MeasureContext& context) {
  const Scene& scene = context.scene();
  const auto orders = static_cast<std::uint64_t>(arg_number(scene, "orders"));
  Simulation first = context.simulate(scene);
  {
    Simulation again = context.simulate(scene);
    context.expect("repeats", same_bits(first, again), true, "two worlds side by side");
  }
  const std::uint32_t threads = std::min(context.backend().info().max_threads, 4u);
  if (threads > 1) {
    SimulationOptions options = context.options();
    options.threads = threads;
    Simulation alone = context.simulate(scene), many = context.simulate(scene, options);
    context.expect("threads", same_bits(alone, many), true);
  }
  const bool stands = in_place(scene, first.poses());
  double square = 0, outcomes = 0;
  for (std::uint64_t seed = 1; seed <= orders; ++seed) {
    const std::vector<std::size_t> order = shuffled(scene, seed);
    const Scene copied = permuted(scene, order);
    Simulation copy = context.simulate(copied);
    copy.run();
    if (in_place(copied, copy.poses()) != stands) ++outcomes;
    for (std::size_t i = 0; i < order.size(); ++i)
      square += (vec(copy.poses()[i].position) - vec(first.poses()[order[i]].position)).squaredNorm() /
                static_cast<double>(order.size() * orders);
  }
  context.deviation("other_outcomes", outcomes);
  context.deviation("order_deviation", std::sqrt(square) / box_side);
}

}  // namespace plumb::harness
