// Measures of pendulums: plane, spherical, double. Their pivots are at the origin.
#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "measure/integrator/integrator.hpp"
#include "truth/pendulums.hpp"

namespace plumb::harness {
namespace {}  // namespace

void measure_pendulum(MeasureContext& context) {
  constexpr std::size_t swings = 10;
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double length = arg_number(scene, "length"), amplitude = arg_number(scene, "amplitude");
  const referee::Mass mass = mass_of_body(scene, body);
  const referee::Vec3 gravity = referee::vec(scene.gravity);

  Simulation simulation = context.simulate(scene);
  Series angle;
  Unwrapped unwrap;
  double start_energy = 0, drift = 0, worst_drift = 0, worst_length = 0;
  const double energy_scale = mass.mass * gravity.norm() * length;
  const auto observe = [&](Simulation& now) {
    const referee::BodyState state = state_of(now, body, mass);
    const referee::Vec3 x = state.centre();
    angle.add(now.time(), unwrap(std::atan2(x.x(), -x.y())));
    const double energy = referee::energy({&state, 1}, gravity).total();
    if (now.steps() == 0) start_energy = energy;
    drift = (energy - start_energy) / energy_scale;
    worst_drift = largest(worst_drift, std::abs(drift));
    worst_length = largest(worst_length, std::abs(x.norm() / length - 1));
  };
  observe(simulation);
  simulation.run(observe);

  const auto passes = angle.crossings(0);
  const double period =
      passes.size() > 2 * swings ? (passes[2 * swings] - passes[0]) / static_cast<double>(swings) : not_measured;
  const double truth = truth::pendulum_period(gravity.norm(), arg_number(scene, "reduced_length"), amplitude);
  context.compare("period", period, truth, truth);
  context.add({"energy_drift", drift, 0.0, worst_drift, std::nullopt, ""});
  context.deviation("length", worst_length);
}

void measure_spherical_pendulum(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double length = arg_number(scene, "length"), tilt = arg_number(scene, "tilt");
  const truth::SphericalPendulum truth{-scene.gravity.y, length, tilt, arg_number(scene, "rate")};
  const auto [other_tilt, cycle, turn] = truth.cycle();

  Simulation simulation = context.simulate(scene);
  Series theta, azimuth;
  Unwrapped unwrap;
  double start_spin = 0, worst_spin = 0;
  const auto observe = [&](Simulation& now) {
    const referee::Vec3 x = referee::vec(now.poses()[body].position), v = referee::vec(now.velocities()[body].linear);
    theta.add(now.time(), std::atan2(std::hypot(x.x(), x.z()), -x.y()));
    azimuth.add(now.time(), unwrap(std::atan2(-x.z(), x.x())));
    const double spin = x.cross(v).y();
    if (now.steps() == 0) start_spin = spin;
    worst_spin = largest(worst_spin, std::abs(spin / start_spin - 1));
  };
  observe(simulation);
  simulation.run(observe);

  const auto low = theta.minima(), high = theta.maxima();
  const double range = std::abs(tilt - other_tilt);
  const auto least = [](const SeriesPoint& a, const SeriesPoint& b) { return a.value < b.value; };
  const double smallest = low.empty() ? not_measured : std::min_element(low.begin(), low.end(), least)->value;
  const double largest = high.empty() ? not_measured : std::max_element(high.begin(), high.end(), least)->value;
  context.compare("smallest_tilt", smallest * degrees, std::min(tilt, other_tilt) * degrees, range * degrees);
  context.compare("largest_tilt", largest * degrees, std::max(tilt, other_tilt) * degrees, range * degrees);
  double period = not_measured, advance = not_measured;
  if (low.size() >= 2) {
    const auto cycles = static_cast<double>(low.size() - 1);
    period = (low.back().time - low.front().time) / cycles;
    advance = (azimuth.at(low.back().time) - azimuth.at(low.front().time)) / cycles;
  }
  context.compare("cycle", period, cycle, cycle);
  context.compare("azimuth_per_cycle", advance * degrees, turn * degrees, turn * degrees);
  context.deviation("spin_drift", worst_spin);
  const referee::Vec3 end = referee::vec(simulation.poses()[body].position);
  context.deviation("end_position", (end - truth.position(simulation.time())).norm() / length);
}

void measure_double_pendulum(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t upper = arg_body(scene, "upper"), lower = arg_body(scene, "lower");
  const double length = arg_number(scene, "length"), amplitude = arg_number(scene, "amplitude");
  Simulation simulation = context.simulate(scene);
  const auto error = [&] {
    const Eigen::Vector4d y = truth::double_pendulum(-scene.gravity.y, length, amplitude, amplitude, simulation.time());
    const referee::Vec3 a = length * referee::Vec3(std::sin(y[0]), -std::cos(y[0]), 0);
    const referee::Vec3 b = a + length * referee::Vec3(std::sin(y[1]), -std::cos(y[1]), 0);
    const double square = (referee::vec(simulation.poses()[upper].position) - a).squaredNorm() +
                          (referee::vec(simulation.poses()[lower].position) - b).squaredNorm();
    return std::sqrt(square / 2) / (2 * length);
  };
  while (simulation.time() < 1 - scene.dt / 2 && simulation.advance()) continue;
  context.deviation("position_1s", error());
  while (simulation.time() < 2 - scene.dt / 2 && simulation.advance()) continue;
  context.deviation("position_2s", error());
}

}  // namespace plumb::harness
