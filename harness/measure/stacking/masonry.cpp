// Measures of what is built of loose blocks: arches, cards, walls. Whether they may stand is limit analysis.
#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/drift.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/instruments/standing.hpp"
#include "measure/stacking/stacking.hpp"
#include "truth/limit_analysis.hpp"

namespace plumb::harness {
namespace {

/// Runs the scene; how long all these bodies were within `reach` of their places.
Survival keep_places(Simulation& simulation, const std::vector<std::size_t>& bodies, double reach) {
  Survival survival;
  simulation.run([&](Simulation& now) {
    survival.add(now.time(), std::all_of(bodies.begin(), bodies.end(), [&](std::size_t body) {
                   return distance_from_start(now.scene(), now.poses(), body) <= reach;
                 }));
  });
  return survival;
}

double largest_way(const Simulation& simulation, const std::vector<std::size_t>& bodies) {
  double way = 0;
  for (const std::size_t body : bodies)
    way = largest(way, distance_from_start(simulation.scene(), simulation.poses(), body));
  return way;
}

/// How much lower than at the start a body is, m.
double sag_of(const Simulation& simulation, std::size_t body) {
  return simulation.scene().bodies[body].desc.pose.position.y - simulation.poses()[body].position.y;
}

void add_verdict(MeasureContext& context, const Survival& survival, bool should_stand) {
  context.expect("stands", survival.whole(), should_stand);
  context.add({"survival", survival.time(), std::nullopt, 0, std::nullopt, ""});
}

}  // namespace

void measure_voussoir_arch(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> stones = arg_bodies(scene, "stones");
  const double radius = arg_number(scene, "radius"), half = arg_number(scene, "thickness") * radius / 2;
  const truth::PlaneStructure arch =
      truth::voussoir_arch({stones.size(), radius - half, radius + half}, arg_number(scene, "friction"));
  Simulation simulation = context.simulate(scene);
  const Survival survival = keep_places(simulation, stones, radius / 20);
  add_verdict(context, survival, truth::can_stand(arch));
  const double sag = sag_of(simulation, stones[stones.size() / 2]);
  context.add({"sag", sag, 0.0, std::abs(sag) / radius, std::nullopt, ""});
}

void measure_catto_arch(MeasureContext& context) {
  constexpr double reach = 0.5;  // m, a quarter of a stone's thickness
  const Scene& scene = context.scene();
  const std::vector<std::size_t> stones = arg_bodies(scene, "stones");
  const auto boxes = static_cast<std::size_t>(arg_number(scene, "boxes"));
  const truth::PlaneStructure arch =
      truth::catto_arch(boxes, arg_number(scene, "wide") != 0, arg_number(scene, "friction"));
  Simulation simulation = context.simulate(scene);
  add_verdict(context, keep_places(simulation, stones, reach), truth::can_stand(arch));
  const double sag = sag_of(simulation, stones.back());
  context.deviation("sag", sag / scene.bodies[stones.back()].desc.pose.position.y);
}

void measure_cards(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> cards = arg_bodies(scene, "cards");
  const double lean = arg_number(scene, "lean"), length = arg_number(scene, "length");
  const bool frame = lean > 0;  // else a house, which stands
  const bool should_stand = !frame || arg_number(scene, "friction") >= truth::card_frame_friction(lean);
  Simulation simulation = context.simulate(scene);
  const Survival survival = keep_places(simulation, cards, length / 10);
  if (frame)
    context.expect("stands", survival.whole(), should_stand);
  else
    context.compare("survival", survival.time(), simulation.time(), simulation.time());
  if (should_stand) context.deviation("creep", largest_way(simulation, cards) / length);
}

void measure_masonry(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> blocks = arg_bodies(scene, "blocks");
  const double height = arg_number(scene, "height"), reach = arg_number(scene, "reach");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  Survival survival;
  RestWatch rest(scene.seconds);
  double half_way = not_measured;
  simulation.run([&](Simulation& now) {
    rest.add(now);
    const double way = largest_way(now, blocks);
    survival.add(now.time(), way <= reach);
    if (now.time() <= scene.seconds / 2 + scene.dt / 2) half_way = way;
  });
  context.compare("survival", survival.time(), simulation.time(), simulation.time());
  const double way = largest_way(simulation, blocks);
  context.deviation("drift", way / height);
  context.deviation("drift_rate", (way - half_way) / height / (scene.seconds / 2));
  context.deviation("depth", view.penetration(simulation.poses()).max / height);
  rest.add_to(context);
}

}  // namespace plumb::harness
