// Measures of chains: with a heavy tip, in their slowest mode, and at rest between two points.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/instruments/args.hpp"
#include "measure/instruments/reactions.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/instruments/standing.hpp"
#include "measure/joints/joints.hpp"
#include "truth/structures.hpp"

namespace plumb::harness {
void measure_heavy_chain(MeasureContext& context) {
  const std::string& motion = arg_text(context.scene(), "motion");
  const bool hanging = motion == "hanging";
  if (!hanging && motion != "swinging")
    throw UsageError("scene " + context.scene().id + ": motion of heavy_chain is swinging or hanging, not " + motion);
  auto [scene, reactions] = with_wanted(context, PLUMB_NEED_JOINT_REACTIONS);
  const std::size_t top = arg_joint(scene, "top"), tip = arg_body(scene, "tip");
  reactions = reactions && hanging && tells_reaction(context, top);
  if (!reactions) scene.needs = context.scene().needs;
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  ReactionAccount account(top);
  double gap = 0;
  simulation.run([&](Simulation& now) {
    gap = largest(gap, view.joint_gap(now.poses()));
    if (reactions && in_last_second(now)) account.add(now);
  });
  context.deviation("gap", gap);
  context.deviation("end_gap", view.joint_gap(simulation.poses()));
  if (!hanging) return;
  context.deviation("sink", distance_from_start(scene, simulation.poses(), tip));
  const double weight = view.total_mass() * std::abs(scene.gravity.y);
  if (reactions) context.compare("tension", account.force().norm(), weight, weight);
}

void measure_chain_mode(MeasureContext& context) {
  Scene scene = context.scene();
  const std::vector<std::size_t> rods = arg_bodies(scene, "rods");
  const double length = arg_number(scene, "length"), tip_mass = arg_number(scene, "tip_mass");
  const double rod_mass = scene.bodies[rods.front()].desc.mass, g = std::abs(scene.gravity.y);
  const truth::ChainMode mode = truth::chain_modes(g, rods.size(), rod_mass, length, tip_mass).front();
  std::vector<double> angles = mode.shape;
  for (double& angle : angles) angle *= arg_number(scene, "amplitude");
  place_rods(scene, rods, length, referee::Vec3::Zero(), -referee::Vec3::UnitY(), angles);
  const referee::Vec3 last = referee::vec(scene.bodies[rods.back()].desc.pose.position);
  const referee::Quat turn = referee::quat(scene.bodies[rods.back()].desc.pose.orientation);
  if (tip_mass > 0)
    scene.bodies[arg_body(scene, "tip")].desc.pose.position =
        referee::plain(last - length / 2 * (turn * referee::Vec3::UnitY()));

  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  Series aside;
  double gap = 0;
  const auto observe = [&](Simulation& now) {
    aside.add(now.time(), now.poses()[rods.back()].position.x);
    gap = largest(gap, view.joint_gap(now.poses()));
  };
  observe(simulation);
  simulation.run(observe);
  const std::vector<double> passes = aside.crossings(0);
  const std::size_t halves = passes.size() < 3 ? 0 : (passes.size() - 1) / 2 * 2;  // an even number: whole swings
  const double period = halves > 0 ? 2 * (passes[halves] - passes[0]) / static_cast<double>(halves) : not_measured;
  const double truth = 2 * std::numbers::pi / mode.frequency;
  context.compare("period", period, truth, truth);
  const auto swings = aside.maxima();
  const double kept = swings.empty() ? 0 : swings.back().value / aside[0].value;
  context.compare("amplitude_kept", kept, 1, 1);
  context.deviation("gap", gap / length);
}

void measure_catenary(MeasureContext& context) {
  auto [scene, reactions] = with_wanted(context, PLUMB_NEED_JOINT_REACTIONS);
  const std::vector<std::size_t> planks = arg_bodies(scene, "planks");
  const std::size_t end = arg_joint(scene, "end");
  const double length = arg_number(scene, "length"), g = std::abs(scene.gravity.y);
  reactions = reactions && tells_reaction(context, end);
  if (!reactions) scene.needs = context.scene().needs;
  const truth::Catenary truth =
      truth::catenary(g, planks.size(), scene.bodies[planks.front()].desc.mass, length, arg_number(scene, "span"));
  std::vector<double> angles = truth.slopes;
  for (double& angle : angles) angle = -angle;
  place_rods(scene, planks, length, referee::Vec3::Zero(), referee::Vec3::UnitX(), angles);
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  ReactionAccount account(end);
  double gap = 0;
  simulation.run([&](Simulation& now) {
    gap = largest(gap, view.joint_gap(now.poses()));
    if (reactions && in_last_second(now)) account.add(now);
  });
  // A joint hangs where the right end of its plank is.
  double sag = 0, worst = 0;
  for (std::size_t i = 0; i + 1 < planks.size(); ++i) {
    const PoseRow& pose = simulation.poses()[planks[i]];
    const referee::Vec3 joint =
        referee::vec(pose.position) + referee::quat(pose.orientation) * referee::Vec3(length / 2, 0, 0);
    sag = largest(sag, -joint.y());
    worst = largest(worst, std::abs(-joint.y() - truth.depths[i + 1]));
  }
  context.compare("sag", sag, truth.sag(), truth.sag());
  context.deviation("heights", worst / truth.sag());
  context.deviation("gap", gap / length);
  if (reactions) context.compare("end_force", account.force().norm(), truth.end_force, truth.end_force);
}

}  // namespace plumb::harness
