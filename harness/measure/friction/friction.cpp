// Measures of dry friction on blocks: inclines, sliding stops, tipping.

#include "measure/friction/friction.hpp"

#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "truth/contacts.hpp"

namespace plumb::harness {
namespace {

/// Turn of a body since its start about any axis, rad.
double turn_of(const Simulation& simulation, std::size_t body) {
  const auto start = referee::quat(simulation.scene().bodies[body].desc.pose.orientation);
  return referee::quat(simulation.poses()[body].orientation).angularDistance(start);
}

/// A block on an incline that falls toward -x, turned about the vertical by yaw. Above the angle of friction it slides
/// by a known way, below it must not creep.
void incline(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double slope = arg_number(scene, "slope"), friction = arg_number(scene, "friction"),
               side = arg_number(scene, "side");
  const double g = -scene.gravity.y, yaw = arg_number(scene, "yaw");
  const referee::Vec3 downhill(-std::cos(slope) * std::cos(yaw), -std::sin(slope), std::cos(slope) * std::sin(yaw));
  Simulation simulation = context.simulate(scene);
  const referee::Vec3 start = referee::vec(simulation.poses()[body].position);
  const auto moved = [&]() -> referee::Vec3 { return referee::vec(simulation.poses()[body].position) - start; };
  const bool must_slide = std::tan(slope) > friction;
  if (!must_slide) {
    double creep = 0;
    simulation.run([&](Simulation&) { creep = largest(creep, moved().norm()); });
    context.expect("slides", creep > 0.5 * side, false);
    context.deviation("creep", creep / side);
    return;
  }
  simulation.run();
  const double t = simulation.time();
  const double truth = truth::incline_slide(g, slope, friction, t);
  const double distance = moved().dot(downhill);
  // A tenth of the way tells sliding from creeping, and leaves the rest to the distance.
  context.expect("slides", distance > truth / 10, true);
  compare_biased(context, "distance", distance, truth, truth, truth * (1 + scene.dt / t));
}

/// Many blocks far apart slide to a stop in different directions: all by the same way.
void sliding_stop(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::vector<std::size_t> blocks = arg_bodies(scene, "blocks");
  const double friction = arg_number(scene, "friction"), speed = arg_number(scene, "speed"), g = -scene.gravity.y;
  Simulation simulation = context.simulate(scene);
  simulation.run();
  double sum = 0, least = std::numeric_limits<double>::infinity(), most = 0, turn = 0, aside = 0, fastest = 0;
  for (const std::size_t block : blocks) {
    const referee::Vec3 heading = referee::vec(scene.bodies[block].desc.linear_velocity).normalized();
    const referee::Vec3 way =
        referee::vec(simulation.poses()[block].position) - referee::vec(scene.bodies[block].desc.pose.position);
    const double distance = way.norm();
    sum += distance;
    least = std::min(least, distance);
    most = largest(most, distance);
    turn = largest(turn, turn_of(simulation, block));
    aside = largest(aside, (way - way.dot(heading) * heading).norm());
    fastest = largest(fastest, referee::vec(simulation.velocities()[block].linear).norm());
  }
  const double mean = sum / static_cast<double>(blocks.size());
  const double truth = speed * speed / (2 * friction * g), scheme = truth - speed * scene.dt / 2;
  const auto worst = [&](double expected) {
    return largest(std::abs(most - expected), std::abs(least - expected)) / truth;
  };
  context.add({"distance", mean, truth, worst(truth), worst(scheme), "error of the worst block"});
  context.deviation("spread", (most - least) / mean);
  context.deviation("turn", turn * degrees);
  context.deviation("aside", aside / truth);
  context.deviation("end_speed", fastest / speed);
}

/// A slender box on an incline either stands or topples: the diagonal's angle decides.
void tip_or_stand(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double slope = arg_number(scene, "slope"), width = arg_number(scene, "width"),
               height = arg_number(scene, "height");
  Simulation simulation = context.simulate(scene);
  double turn = 0;
  simulation.run([&](Simulation& now) { turn = largest(turn, turn_of(now, body)); });
  context.expect("topples", turn > 0.5, std::tan(slope) > width / height);
  context.deviation("turn", turn * degrees);
}

}  // namespace

std::span<const MeasureEntry> friction_measures() {
  using enum ArgumentType;
  static constexpr MeasureArgument incline_args[] = {
      {"body", body}, {"slope", number}, {"yaw", number}, {"friction", number}, {"side", number}};
  static constexpr MeasureArgument stop_args[] = {{"blocks", bodies}, {"friction", number}, {"speed", number}};
  static constexpr MeasureArgument tip_args[] = {
      {"body", body}, {"slope", number}, {"width", number}, {"height", number}};
  static constexpr MeasureArgument roll_args[] = {{"body", body},       {"radius", number}, {"inertia_factor", number},
                                                  {"friction", number}, {"speed", number},  {"surface_spin", number}};
  static constexpr MeasureArgument down_args[] = {
      {"body", body}, {"radius", number}, {"inertia_factor", number}, {"friction", number}, {"slope", number}};
  static constexpr MeasureArgument spin_args[] = {
      {"body", body}, {"side", number}, {"friction", number}, {"spin", number}};
  static constexpr MeasureArgument pushed_args[] = {
      {"box", body}, {"balls", bodies}, {"friction", number}, {"force", number}, {"heading", number}};
  static constexpr MeasureArgument ramp_args[] = {{"body", body}, {"friction", number}, {"rate", number}};
  static constexpr MeasureArgument belt_args[] = {
      {"belt", body}, {"box", body}, {"friction", number}, {"speed", number}, {"heading", number}};
  static constexpr MeasureArgument painleve_args[] = {{"rod", body}, {"length", number}};
  static constexpr MeasureArgument ladder_args[] = {
      {"ladder", body}, {"length", number}, {"radius", number}, {"slope", number}, {"friction", number}};
  static constexpr MeasureEntry entries[] = {
      {"incline", "whether a block slides, how far, or how it creeps", incline_args, incline},
      {"sliding_stop", "stopping distances of blocks in many directions", stop_args, sliding_stop},
      {"tip_or_stand", "whether a slender box topples", tip_args, tip_or_stand},
      {"slide_to_roll", "when and how fast a sliding body begins to roll", roll_args, measure_slide_to_roll},
      {"roll_down", "distance and slip of a body that rolls down an incline", down_args, measure_roll_down},
      {"spin_stop", "time and angle in which a spinning cube stops", spin_args, measure_spin_stop},
      {"pushed_box", "velocities of a pushed box and the balls on it", pushed_args, measure_pushed_box},
      {"force_ramp", "when a growing force moves a block, and how far", ramp_args, measure_force_ramp},
      {"conveyor", "how long and how far a box slips on a belt", belt_args, measure_conveyor},
      {"painleve", "laws that a rod keeps that no finite force can carry on", painleve_args, measure_painleve},
      {"ladder", "whether a ladder stands on the floor and against a wall", ladder_args, measure_ladder},
  };
  return entries;
}

}  // namespace plumb::harness
