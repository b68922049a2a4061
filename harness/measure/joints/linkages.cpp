// Measures of sliders and closed linkages.
#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/joints/joints.hpp"
#include "truth/structures.hpp"

namespace plumb::harness {
namespace {

void slope(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = scene.body("sled");
  const double angle = arg_number(scene, "slope"), g = std::abs(scene.gravity.y);
  const referee::Vec3 axis(std::cos(angle), -std::sin(angle), 0);
  const referee::Vec3 start = referee::vec(scene.bodies[body].desc.pose.position);
  const referee::Quat upright = referee::quat(scene.bodies[body].desc.pose.orientation);
  Simulation simulation = context.simulate(scene);
  double off_axis = 0, turned = 0;
  simulation.run([&](Simulation& now) {
    const referee::Vec3 way = referee::vec(now.poses()[body].position) - start;
    off_axis = largest(off_axis, (way - way.dot(axis) * axis).norm());
    turned = largest(turned, referee::quat(now.poses()[body].orientation).angularDistance(upright));
  });
  const double seconds = simulation.time(), acceleration = g * std::sin(angle);
  const double truth = acceleration * seconds * seconds / 2;
  const double distance = (referee::vec(simulation.poses()[body].position) - start).dot(axis);
  compare_biased(context, "distance", distance, truth, truth, acceleration * seconds * (seconds + scene.dt) / 2);
  context.deviation("off_axis", off_axis);
  context.deviation("turned", turned);
}

void slider_crank(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t crank = scene.body("crank"), piston = scene.body("piston");
  const double crank_length = arg_number(scene, "crank_length"), rod_length = arg_number(scene, "rod_length");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  double worst = 0, gap = 0;
  Unwrapped unwrap;
  double angle = 0;
  simulation.run([&](Simulation& now) {
    angle = unwrap(turn_about_z(scene, now.poses(), crank));
    const double truth = truth::slider_crank(crank_length, rod_length, angle);
    worst = largest(worst, std::abs(now.poses()[piston].position.x - truth));
    gap = largest(gap, view.joint_gap(now.poses()));
  });
  context.deviation("piston", worst / rod_length);
  context.deviation("gap", gap / rod_length);
  const double driven = scene.joints.front().desc.motors[3].target_velocity * simulation.time();
  context.compare("crank_angle", angle, driven, driven);
}

}  // namespace

void measure_slider(MeasureContext& context) {
  const std::string& mechanism = arg_text(context.scene(), "mechanism");
  if (mechanism == "slope") return slope(context);
  if (mechanism == "crank") return slider_crank(context);
  throw UsageError("scene " + context.scene().id + ": mechanism of slider is slope or crank, not " + mechanism);
}

void measure_parallelogram(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t crank = arg_body(scene, "crank");
  const double length = arg_number(scene, "length"), amplitude = arg_number(scene, "amplitude");
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  Series angle;
  double gap = 0, lost = 0;
  const double start = view.energy(simulation).total();
  const double swing = view.total_mass() * std::abs(scene.gravity.y) * length;
  const auto observe = [&](Simulation& now) {
    angle.add(now.time(), amplitude + turn_about_z(scene, now.poses(), crank));
    gap = largest(gap, view.joint_gap(now.poses()));
    lost = largest(lost, std::abs(view.energy(now).total() - start));
  };
  observe(simulation);
  simulation.run(observe);
  const std::vector<double> passes = angle.crossings(0);
  const std::size_t halves = passes.size() < 3 ? 0 : (passes.size() - 1) / 2 * 2;
  const double period = halves > 0 ? 2 * (passes[halves] - passes[0]) / static_cast<double>(halves) : not_measured;
  const double truth = truth::parallelogram_period(std::abs(scene.gravity.y), length, amplitude);
  context.compare("period", period, truth, truth);
  context.deviation("gap", gap / length);
  context.deviation("energy_drift", lost / swing);
}

}  // namespace plumb::harness
