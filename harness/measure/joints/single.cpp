// Measures of single joints and of what they drive: a falling plank, a spring, a cantilever, a four-bar linkage, a
// universal joint, a figure in free space.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "measure/instruments/args.hpp"
#include "measure/instruments/reactions.hpp"
#include "measure/instruments/referee_view.hpp"
#include "measure/instruments/series.hpp"
#include "measure/joints/joints.hpp"
#include "truth/mechanisms.hpp"

namespace plumb::harness {
namespace {}  // namespace

void measure_toppling(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t plank = arg_body(scene, "plank");
  const double length = arg_number(scene, "length"), start = arg_number(scene, "start");
  const double g = std::abs(scene.gravity.y), level = std::numbers::pi / 2;
  Simulation simulation = context.simulate(scene);
  Series angle, speed;
  const auto observe = [&](Simulation& now) {
    angle.add(now.time(), start - turn_about_z(scene, now.poses(), plank));
    speed.add(now.time(), -now.velocities()[plank].angular.z);
  };
  observe(simulation);
  simulation.run(observe);
  const std::vector<double> passes = angle.crossings(level);
  const bool fell = !passes.empty();
  const double time = truth::toppling_time(g, length, start), fast = truth::toppling_speed(g, length, start);
  context.compare("time", fell ? passes.front() : not_measured, time, time);
  context.compare("speed", fell ? speed.at(passes.front()) : not_measured, fast, fast);
}

void measure_spring(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t bob = arg_body(scene, "bob");
  const double rest = arg_number(scene, "rest"), frequency = arg_number(scene, "frequency");
  const double damping_ratio = arg_number(scene, "damping_ratio");
  const bool sags = arg_text(scene, "task") == "sag";
  Simulation simulation = context.simulate(scene);
  Series stretch;
  const auto observe = [&](Simulation& now) {
    stretch.add(now.time(), referee::vec(now.poses()[bob].position).norm() - rest);
  };
  observe(simulation);
  simulation.run(observe);
  if (sags) {
    const double omega = 2 * std::numbers::pi * frequency, sag = referee::vec(scene.gravity).norm() / (omega * omega);
    return context.compare("sag", stretch.back().value, sag, sag);
  }
  const double start = stretch[0].value, truth = truth::damped_oscillation(frequency, damping_ratio, start, 1);
  context.compare("place", stretch.at(1), truth, truth);
  // From the start, which is a maximum, to the last one.
  const auto tops = stretch.maxima();
  const double count = static_cast<double>(tops.size());
  const double decrement = tops.empty() ? not_measured : std::log(start / tops.back().value) / count;
  context.compare("decrement", decrement, truth::logarithmic_decrement(damping_ratio),
                  truth::logarithmic_decrement(damping_ratio));
}

void measure_cantilever(MeasureContext& context) {
  auto [scene, reactions] = with_wanted(context, PLUMB_NEED_JOINT_REACTIONS);
  const std::vector<std::size_t> cubes = arg_bodies(scene, "cubes");
  const std::size_t root = arg_joint(scene, "root");
  const double length = arg_number(scene, "length");
  reactions = reactions && tells_reaction(context, root);
  if (!reactions) scene.needs = context.scene().needs;
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  ReactionAccount account(root);
  const std::size_t tip = cubes.back();
  const double level = scene.bodies[tip].desc.pose.position.y;
  double sag = 0;
  simulation.run([&](Simulation& now) {
    sag = largest(sag, std::abs(level - now.poses()[tip].position.y));
    if (reactions && now.time() > scene.seconds - 1 + scene.dt / 2) account.add(now);
  });
  context.deviation("sag", sag / length);
  const double moment = view.total_mass() * std::abs(scene.gravity.y) * length / 2;
  if (reactions) context.compare("root_moment", account.torque().norm(), moment, moment);
}

void measure_four_bar(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t crank = arg_body(scene, "crank"), rocker = arg_body(scene, "rocker");
  const std::vector<double> bars = arg_numbers(scene, "lengths");
  if (bars.size() != 4)
    throw UsageError("scene " + scene.id + ": lengths of four_bar are crank, coupler, rocker and ground");
  const double start = arg_number(scene, "start"), speed = arg_number(scene, "speed");
  const auto rocker_at = [&](double angle) {
    return truth::four_bar_rocker(bars[0], bars[1], bars[2], bars[3], angle);
  };
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  Unwrapped turned;
  double worst = 0, gap = 0, angle = start;
  simulation.run([&](Simulation& now) {
    angle = start + turned(turn_about_z(scene, now.poses(), crank));
    const double rocked = rocker_at(start) + turn_about_z(scene, now.poses(), rocker);
    worst = largest(worst, std::abs(std::remainder(rocked - rocker_at(angle), 2 * std::numbers::pi)));
    gap = largest(gap, view.joint_gap(now.poses()));
  });
  context.deviation("rocker", worst * degrees);
  context.deviation("gap", gap / bars[0]);
  const double driven = speed * simulation.time();
  context.compare("crank_angle", angle - start, driven, driven);
}

void measure_universal(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t first = arg_body(scene, "first"), second = arg_body(scene, "second");
  const double bend = arg_number(scene, "bend");
  const auto turn = [&](Simulation& now, std::size_t body, const referee::Vec3& axis) {
    const referee::Quat start = referee::quat(scene.bodies[body].desc.pose.orientation);
    const referee::Quat turned = referee::quat(now.poses()[body].orientation) * start.conjugate();
    return 2 * std::atan2(turned.vec().dot(axis), turned.w());
  };
  const referee::Vec3 in = referee::Vec3::UnitX(), out(std::cos(bend), std::sin(bend), 0);
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  double worst = 0, least = not_measured, most = not_measured, gap = 0;
  simulation.run([&](Simulation& now) {
    const double difference = turn(now, second, out) - truth::universal_turn(bend, turn(now, first, in));
    worst = largest(worst, std::abs(std::remainder(difference, 2 * std::numbers::pi)));
    gap = largest(gap, view.joint_gap(now.poses()));
    const double ratio =
        referee::vec(now.velocities()[second].angular).dot(out) / referee::vec(now.velocities()[first].angular).dot(in);
    least = std::isnan(least) ? ratio : std::min(least, ratio);
    most = std::isnan(most) ? ratio : std::max(most, ratio);
  });
  context.deviation("angle", worst * degrees);
  context.compare("slowest", least, std::cos(bend), std::cos(bend));
  context.compare("fastest", most, 1 / std::cos(bend), 1 / std::cos(bend));
  context.deviation("gap", gap);
}

void measure_free_figure(MeasureContext& context) {
  const Scene& scene = context.scene();
  const RefereeView view(scene);
  Simulation simulation = context.simulate(scene);
  referee::Vec3 first_linear = referee::Vec3::Zero(), first_angular = referee::Vec3::Zero();
  double linear = 0, angular = 0, linear_sum = 0, angular_sum = 0, gap = 0;
  const auto observe = [&](Simulation& now) {
    const std::vector<referee::BodyState> states = view.states(now);
    const referee::Vec3 p = referee::linear_momentum(states), l = referee::angular_momentum(states);
    if (now.steps() == 0) {
      first_linear = p;
      first_angular = l;
    }
    double sum = 0;
    for (const referee::BodyState& state : states)
      sum += (state.centre().cross(state.momentum()) + state.spin()).norm();
    linear_sum = largest(linear_sum, referee::sum_of_momenta(states));
    angular_sum = largest(angular_sum, sum);
    linear = largest(linear, (p - first_linear).norm());
    angular = largest(angular, (l - first_angular).norm());
    gap = largest(gap, view.joint_gap(now.poses()));
  };
  observe(simulation);
  simulation.run(observe);
  context.deviation("momentum", linear / linear_sum);
  context.deviation("angular_momentum", angular / angular_sum);
  context.deviation("gap", gap);
}

}  // namespace plumb::harness
