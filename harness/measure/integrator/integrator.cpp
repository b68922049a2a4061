// Measures of the integrator under constant forces: free fall, projectiles, a constant torque.
#include "measure/integrator/integrator.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"

namespace plumb::harness {
namespace {

/// Which textbook scheme gives this fall: each has a fingerprint under constant acceleration.
std::string scheme_of(double fall, double g, double seconds, double dt) {
  const struct {
    const char* name;
    double fall;
  } schemes[] = {{"semi-implicit Euler", g * seconds * (seconds + dt) / 2},
                 {"explicit Euler", g * seconds * (seconds - dt) / 2},
                 {"midpoint or Verlet", g * seconds * seconds / 2}};
  for (const auto& scheme : schemes)
    if (std::abs(fall - scheme.fall) < 0.05 * g * seconds * dt / 2) return scheme.name;
  return "no textbook scheme";
}

void free_fall(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  Simulation simulation = context.simulate(scene);
  const double start = simulation.poses()[body].position.y;
  simulation.run();
  const double g = -scene.gravity.y, seconds = simulation.time();
  const double fall = start - simulation.poses()[body].position.y;
  const double truth = g * seconds * seconds / 2;
  compare_biased(context, "drop", fall, truth, truth, g * seconds * (seconds + scene.dt) / 2,
                 scheme_of(fall, g, seconds, scene.dt));
  context.compare("speed", -simulation.velocities()[body].linear.y, g * seconds, g * seconds);
}

/// Fall with the damping dv/dt = -c v: v = g / c (1 - e^(-c t)).
void projectile(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t thrown = arg_body(scene, "thrown"), damped = arg_body(scene, "damped");
  const double g = -scene.gravity.y, c = scene.bodies[damped].desc.linear_damping;
  const PlumbVec3 v0 = scene.bodies[thrown].desc.linear_velocity;
  Simulation simulation = context.simulate(scene);
  const double start = simulation.poses()[thrown].position.y, damped_start = simulation.poses()[damped].position.y;
  Series height;
  height.add(0, 0);
  simulation.run([&](Simulation& now) { height.add(now.time(), now.poses()[thrown].position.y - start); });
  const double seconds = simulation.time(), dt = scene.dt;
  const double gravity_drop = g * seconds * seconds / 2;  // the part of the path that integration makes
  const auto apexes = height.maxima();
  const SeriesPoint apex = apexes.empty() ? SeriesPoint{not_measured, not_measured} : apexes.front();
  const double apex_time = v0.y / g, apex_height = v0.y * v0.y / (2 * g), euler_v = v0.y - g * dt / 2;
  compare_biased(context, "apex_time", apex.time, apex_time, apex_time, apex_time - dt / 2);
  compare_biased(context, "apex_height", apex.value, apex_height, gravity_drop, euler_v * euler_v / (2 * g));
  const double end = v0.y * seconds - gravity_drop;
  compare_biased(context, "end_height", height.back().value, end, gravity_drop, end - g * seconds * dt / 2);
  const double speed = g / c * (1 - std::exp(-c * seconds)), drop = (g * seconds - speed) / c;
  context.compare("damped_speed", -simulation.velocities()[damped].linear.y, speed, speed);
  context.compare("damped_drop", damped_start - simulation.poses()[damped].position.y, drop, gravity_drop);
}

/// A body about each of its principal axes gets the same torque for the whole run: w = torque t / I.
void spin_up(MeasureContext& context) {
  const Scene& scene = context.scene();
  const double torque = arg_number(scene, "torque");
  const std::array<const char*, 3> axes{"x", "y", "z"};
  Simulation simulation = context.simulate(scene);
  std::array<std::size_t, 3> bodies{};
  for (std::size_t axis = 0; axis < 3; ++axis) bodies[axis] = arg_body(scene, axes[axis]);
  do {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::array<double, 3> row{};
      row[axis] = torque;
      simulation.write(PLUMB_FIELD_TORQUE, bodies[axis], row);
    }
  } while (simulation.advance());
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const referee::Mass mass = mass_of_body(scene, bodies[axis]);
    const auto index = static_cast<Eigen::Index>(axis);
    const double truth = torque * simulation.time() / mass.inertia(index, index);
    const double value = referee::vec(simulation.velocities()[bodies[axis]].angular)[index];
    context.compare(std::string("spin_") + axes[axis], value, truth, truth);
  }
}

}  // namespace

std::span<const MeasureEntry> integrator_measures() {
  using enum ArgumentType;
  static constexpr MeasureArgument free_fall_args[] = {{"body", body}};
  static constexpr MeasureArgument projectile_args[] = {{"thrown", body}, {"damped", body}};
  static constexpr MeasureArgument spin_up_args[] = {{"x", body}, {"y", body}, {"z", body}, {"torque", number}};
  static constexpr MeasureArgument body_args[] = {{"body", body}};
  static constexpr MeasureArgument top_args[] = {
      {"body", body}, {"arm", number}, {"spin", number}, {"tilt", number}, {"motion", word}};
  static constexpr MeasureArgument pendulum_args[] = {
      {"body", body}, {"length", number}, {"reduced_length", number}, {"amplitude", number}};
  static constexpr MeasureArgument spherical_args[] = {
      {"body", body}, {"length", number}, {"tilt", number}, {"rate", number}};
  static constexpr MeasureArgument double_args[] = {
      {"upper", body}, {"lower", body}, {"length", number}, {"amplitude", number}};
  static constexpr MeasureEntry entries[] = {
      {"free_fall", "drop and speed of a body let go at rest", free_fall_args, free_fall},
      {"projectile", "apex and end of a thrown body, and a damped fall", projectile_args, projectile},
      {"spin_up", "angular velocity after a constant torque about each axis", spin_up_args, spin_up},
      {"symmetric_rotation", "how the axis of a body with two equal moments goes round", body_args,
       measure_symmetric_rotation},
      {"free_rotation", "energy, momentum and flips of a box that spins freely", body_args, measure_free_rotation},
      {"heavy_top", "steady precession, or the nutation of a top let go at rest", top_args, measure_heavy_top},
      {"pendulum", "period, energy and length of a plane pendulum", pendulum_args, measure_pendulum},
      {"spherical_pendulum", "range, cycle and angular momentum", spherical_args, measure_spherical_pendulum},
      {"double_pendulum", "positions of a double pendulum after 1 and 2 s", double_args, measure_double_pendulum},
  };
  return entries;
}

}  // namespace plumb::harness
