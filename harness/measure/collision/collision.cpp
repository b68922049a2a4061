// Measures of bouncing under gravity.

#include "measure/collision/collision.hpp"

#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "truth/contacts.hpp"

namespace plumb::harness {
namespace {

/// Highest points after each of the first impacts, on the parabola through the samples. A ball that has stopped
/// bouncing stays where it ends.
std::vector<double> apexes(const Series& height, std::size_t count) {
  const auto tops = height.maxima();
  const auto impacts = height.minima();
  std::vector<double> found;
  for (std::size_t i = 0; i < count; ++i) {
    double highest = height.back().value;
    if (i < impacts.size()) {
      const double begin = impacts[i].time;
      const double end = i + 1 < impacts.size() ? impacts[i + 1].time : height.back().time;
      for (const SeriesPoint& top : tops)
        if (top.time > begin && top.time < end) highest = top.value;
    }
    found.push_back(highest);
  }
  return found;
}

void bounce_ladder(MeasureContext& context) {
  constexpr std::size_t rungs = 5;
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double radius = arg_number(scene, "radius"), restitution = arg_number(scene, "restitution");
  const double g = -scene.gravity.y;
  Simulation simulation = context.simulate(scene);
  const double fall = simulation.poses()[body].position.y - radius;
  Series height;
  double impact = not_measured;
  const auto observe = [&](Simulation& now) {
    const double y = now.poses()[body].position.y;
    // The first impact: where the parabola of the fall, which the last two samples of it carry on, meets the ground.
    if (std::isnan(impact) && height.size() > 0 && now.velocities()[body].linear.y > -0.5 * g * height.back().time) {
      const double above = height.back().value - radius;
      impact = height.back().time + above / (g * height.back().time);
    }
    height.add(now.time(), y);
  };
  observe(simulation);
  simulation.run(observe);
  const std::vector<double> tops = apexes(height, rungs);
  for (std::size_t i = 0; i < rungs; ++i) {
    const int n = static_cast<int>(i) + 1;
    context.compare("apex_" + std::to_string(n), tops[i] - radius, truth::bounce_apex(fall, restitution, n), fall);
  }
  const double truth = truth::bounce_impact(g, fall, restitution, 1);
  compare_biased(context, "first_impact", impact, truth, truth, truth - scene.dt / 2);
  context.deviation("energy_gain", std::max(0.0, *std::max_element(tops.begin(), tops.end()) - radius - fall) / fall);
}

void flat_bounce(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double half = arg_number(scene, "half_height");
  Simulation simulation = context.simulate(scene);
  const double start = simulation.poses()[body].position.y - half;
  double highest = 0, spin = 0;
  bool fallen = false;  // the start is not a bounce
  simulation.run([&](Simulation& now) {
    const double height = now.poses()[body].position.y - half;
    const VelocityRow& velocity = now.velocities()[body];
    fallen = fallen || height < 0.5 * start;
    if (fallen) highest = largest(highest, height);
    spin = largest(spin, referee::vec(velocity.angular).norm());
  });
  context.add({"rise", highest / start - 1, 0.0, std::max(0.0, highest / start - 1), std::nullopt,
               "only a rise above the start is an error"});
  context.deviation("spin", spin);
}

}  // namespace

std::span<const MeasureEntry> collision_measures() {
  using enum ArgumentType;
  static constexpr MeasureArgument ladder_args[] = {{"body", body}, {"radius", number}, {"restitution", number}};
  static constexpr MeasureArgument flat_args[] = {{"body", body}, {"half_height", number}};
  static constexpr MeasureArgument head_on_args[] = {{"a", body}, {"b", body}, {"restitution", number}};
  static constexpr MeasureArgument oblique_args[] = {
      {"body", body}, {"radius", number}, {"friction", number}, {"restitution", number}};
  static constexpr MeasureArgument cube_args[] = {
      {"body", body}, {"half", number}, {"friction", number}, {"restitution", number}};
  static constexpr MeasureArgument box_args[] = {
      {"body", body}, {"radius", number}, {"offset_x", number}, {"offset_z", number}, {"restitution", number}};
  static constexpr MeasureArgument cradle_args[] = {{"balls", bodies}, {"touching", number}};
  static constexpr MeasureArgument glancing_args[] = {{"runner", body}, {"target", body}, {"angle", number}};
  static constexpr MeasureArgument answers_args[] = {
      {"case", word}, {"pairs", number}, {"depth", number}, {"height", number}};
  static constexpr MeasureEntry entries[] = {
      {"bounce_ladder", "heights of the first five bounces", ladder_args, bounce_ladder},
      {"flat_bounce", "how far a box that falls flat rises again, and its spin", flat_args, flat_bounce},
      {"head_on", "velocities, momentum and energy after a head-on impact", head_on_args, measure_head_on},
      {"oblique_impact", "velocity and spin of a sphere after an oblique impact", oblique_args, measure_oblique_impact},
      {"tilted_cube", "velocity and spin of a cube that lands on an edge or a vertex", cube_args, measure_tilted_cube},
      {"sphere_on_box", "velocity and normal of a sphere that strikes a box's edge or corner", box_args,
       measure_sphere_on_box},
      {"cradle", "velocities, energy and momentum of a row of spheres that one runs into", cradle_args, measure_cradle},
      {"glancing_pair", "velocities of two spheres that meet off centre", glancing_args, measure_glancing_pair},
      {"static_answers", "depth, normal and points of boxes in each other, without a step", answers_args,
       measure_static_answers},
  };
  return entries;
}

}  // namespace plumb::harness
