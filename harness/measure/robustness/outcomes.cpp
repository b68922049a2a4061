// Measures that judge a scene by itself, run otherwise: in a mirror, with shorter steps, begun a hair elsewhere.
#include <algorithm>
#include <array>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/series.hpp"
#include "measure/instruments/statistics.hpp"
#include "measure/instruments/transform.hpp"
#include "measure/robustness/robustness.hpp"
#include "scene/generators.hpp"

namespace plumb::harness {
namespace {

using referee::vec;
using referee::Vec3;

using Positions = std::vector<Vec3>;

Positions positions_of(const Simulation& simulation) {
  Positions positions;
  for (const PoseRow& pose : simulation.poses()) positions.push_back(vec(pose.position));
  return positions;
}

/// RMS distance of all moving bodies.
double distance(const Scene& scene, const Positions& one, const Positions& other) {
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    if (scene.bodies[i].desc.motion != PLUMB_DYNAMIC) continue;
    squares += (one[i] - other[i]).squaredNorm();
    ++count;
  }
  return std::sqrt(squares / count);
}

/// The scene's needs and what it is made of: a file that serves several cases declares only what all of them need.
Scene with_own_needs(Scene scene) {
  if (!scene.joints.empty()) scene.needs |= PLUMB_NEED_JOINTS;
  const bool touches = std::any_of(scene.bodies.begin(), scene.bodies.end(),
                                   [](const SceneBody& body) { return body.desc.motion == PLUMB_STATIC; });
  if (touches) scene.needs |= PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;
  return scene;
}

}  // namespace

void measure_mirror(MeasureContext& context) {
  const Scene scene = with_own_needs(context.scene());
  Simulation original = context.simulate(scene), copy = context.simulate(mirrored(scene));
  double worst = 0;
  while (original.advance() && copy.advance())
    for (std::size_t i = 0; i < original.poses().size(); ++i) {
      Vec3 back = vec(copy.poses()[i].position);
      back.x() = -back.x();
      worst = largest(worst, (back - vec(original.poses()[i].position)).norm());
    }
  context.deviation("deviation", worst / arg_number(scene, "size"));
}

void measure_self_convergence(MeasureContext& context) {
  const Scene scene = with_own_needs(context.scene());
  const double size = arg_number(scene, "size");
  std::array<Positions, 3> ends;
  double scale = 1;
  for (Positions& end : ends) {
    Scene finer = scene;
    finer.dt = scene.dt * scale;
    Simulation simulation = context.simulate(finer);
    simulation.run();
    end = positions_of(simulation);
    scale /= 2;
  }
  const double coarse = distance(scene, ends[0], ends[1]) / size, fine = distance(scene, ends[1], ends[2]) / size;
  const Convergence order = convergence(coarse, fine);
  context.add({"order", order.order, 1.0, std::isnan(order.order) ? order.order : std::max(0.0, 1 - order.order),
               std::nullopt, "only an order below 1 is an error"});
  context.deviation("difference", coarse);
  context.deviation("richardson_error", order.error);
}

void measure_predictability(MeasureContext& context) {
  const Scene scene = with_own_needs(context.scene());
  const double size = arg_number(scene, "size"), nudge = arg_number(scene, "nudge");
  const auto seeds = static_cast<std::uint64_t>(arg_number(scene, "seeds"));
  Simulation first = context.simulate(scene);
  first.run();
  const Positions reference = positions_of(first);
  const auto height = [&](const Positions& end) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < end.size(); ++i)
      if (scene.bodies[i].desc.motion == PLUMB_DYNAMIC) sum += end[i].y(), ++count;
    return sum / count;
  };
  std::vector<double> heights{height(reference)};
  double worst = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SplitMix64 random(seed);
    Scene nudged = scene;
    for (SceneBody& body : nudged.bodies) {
      if (body.desc.motion != PLUMB_DYNAMIC) continue;
      PlumbVec3& p = body.desc.pose.position;
      p.x += nudge * (2 * random.uniform() - 1);
      p.z += nudge * (2 * random.uniform() - 1);
    }
    Simulation simulation = context.simulate(nudged);
    simulation.run();
    const Positions end = positions_of(simulation);
    worst = largest(worst, distance(scene, end, reference));
    heights.push_back(height(end));
  }
  const Spread spread = spread_of(heights);
  context.deviation("spread", worst / size);
  context.deviation("growth", growth_rate(nudge, worst, scene.seconds));
  context.add({"mean_height", spread.mean, std::nullopt, 0, std::nullopt, ""});
  context.deviation("height_spread", spread.deviation / size);
}

}  // namespace plumb::harness
