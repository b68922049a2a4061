// Measures of rotation: free bodies and the heavy top.
#include <algorithm>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "measure/integrator/integrator.hpp"
#include "truth/rotation.hpp"

namespace plumb::harness {
namespace {

/// Angle of the body's y axis from the vertical and its azimuth about it (counter-clockwise seen from above).
struct AxisSeries {
  Series tilt, azimuth;
};

AxisSeries watch_axis(MeasureContext& context, std::size_t body) {
  Simulation simulation = context.simulate(context.scene());
  AxisSeries series;
  Unwrapped unwrap;
  const auto observe = [&](Simulation& now) {
    const referee::Vec3 axis = referee::quat(now.poses()[body].orientation) * referee::Vec3::UnitY();
    series.tilt.add(now.time(), std::atan2(std::hypot(axis.x(), axis.z()), axis.y()));
    series.azimuth.add(now.time(), unwrap(std::atan2(-axis.z(), axis.x())));
  };
  observe(simulation);
  simulation.run(observe);
  return series;
}

truth::HeavyTop heavy_top(const Scene& scene, std::size_t body) {
  const referee::Mass mass = mass_of_body(scene, body);
  const double arm = arg_number(scene, "arm");
  return {mass.inertia(0, 0) + mass.mass * arm * arm, mass.inertia(1, 1), -scene.gravity.y * mass.mass * arm,
          arg_number(scene, "spin")};
}

void steady(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double tilt = arg_number(scene, "tilt");
  const AxisSeries series = watch_axis(context, body);
  const double rate = (series.azimuth.back().value - series.azimuth[0].value) / series.azimuth.back().time;
  const double truth = heavy_top(scene, body).slow_precession(tilt);
  context.compare("precession", rate, truth, truth);
  double wobble = 0;
  for (std::size_t i = 0; i < series.tilt.size(); ++i) wobble = largest(wobble, std::abs(series.tilt[i].value - tilt));
  // A top that has fallen may still have turned by the right angle: the tilt must hold too.
  context.add({"tilt_drift", wobble * degrees, 0.0, wobble / tilt, std::nullopt, ""});
}

void released(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const double tilt = arg_number(scene, "tilt");
  const truth::HeavyTop::Nutation truth = heavy_top(scene, body).nutation(tilt);
  const AxisSeries series = watch_axis(context, body);
  const auto lowest = series.tilt.maxima();
  double deepest = not_measured, period = not_measured, azimuth = not_measured;
  if (!lowest.empty()) deepest = lowest.front().value;
  if (lowest.size() >= 2) {
    const auto cycles = static_cast<double>(lowest.size() - 1);
    period = (lowest.back().time - lowest.front().time) / cycles;
    azimuth = (series.azimuth.at(lowest.back().time) - series.azimuth.at(lowest.front().time)) / cycles;
  }
  context.compare("lowest_tilt", deepest * degrees, truth.lowest * degrees, (truth.lowest - tilt) * degrees);
  context.compare("nutation_period", period, truth.period, truth.period);
  context.compare("nutation_azimuth", azimuth * degrees, truth.azimuth * degrees, truth.azimuth * degrees);
}

}  // namespace

void measure_free_rotation(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const referee::Mass mass = mass_of_body(scene, body);
  const PlumbVec3 w0 = scene.bodies[body].desc.angular_velocity;
  const truth::FreeRotation truth(mass.inertia.diagonal(), referee::vec(w0));

  Simulation simulation = context.simulate(scene);
  Series middle;  // the angular velocity about the body's own middle axis
  middle.add(0, w0.y);
  double energy_drift = 0, momentum_drift = 0, worst_energy = 0, worst_momentum = 0;
  double early = not_measured;
  simulation.run([&](Simulation& now) {
    const referee::BodyState state = state_of(now, body, mass);
    const referee::Vec3 local = state.pose.rotation.transpose() * state.angular;
    middle.add(now.time(), local.y());
    energy_drift = state.angular.dot(state.spin()) / 2 / truth.energy() - 1;
    momentum_drift = state.spin().norm() / truth.momentum() - 1;
    worst_energy = largest(worst_energy, std::abs(energy_drift));
    worst_momentum = largest(worst_momentum, std::abs(momentum_drift));
    if (std::abs(now.time() - 1) < scene.dt / 2) early = (local - truth.angular_velocity(now.time())).norm() / w0.y;
  });
  context.add({"energy_drift", energy_drift, 0.0, worst_energy, std::nullopt, ""});
  context.add({"momentum_drift", momentum_drift, 0.0, worst_momentum, std::nullopt, ""});
  const auto flips = middle.crossings(0);
  const auto count = static_cast<double>(flips.size());
  context.compare("flips", count, truth.flips(simulation.time()), 1);
  const double interval = flips.size() < 2 ? not_measured : (flips.back() - flips.front()) / (count - 1);
  context.compare("flip_interval", interval, truth.flip_interval(), truth.flip_interval());
  context.deviation("spin_after_1s", early);
}

/// A body with two equal moments: its axis, local y, goes evenly round the angular momentum L at the rate |L| / I1
/// (Landau & Lifshitz, Mechanics, section 33).
void measure_symmetric_rotation(MeasureContext& context) {
  const Scene& scene = context.scene();
  const std::size_t body = arg_body(scene, "body");
  const referee::Mass mass = mass_of_body(scene, body);
  Simulation simulation = context.simulate(scene);
  const referee::Vec3 momentum = state_of(simulation, body, mass).spin(), along = momentum.normalized();
  const auto axis_of = [&](Simulation& now) -> referee::Vec3 {
    return referee::quat(now.poses()[body].orientation) * referee::Vec3::UnitY();
  };
  const auto angle_of = [&](const referee::Vec3& axis) {
    return std::atan2(along.cross(axis).norm(), along.dot(axis));
  };
  const referee::Vec3 start = axis_of(simulation);
  const double cone = angle_of(start), rate = momentum.norm() / mass.inertia(0, 0);
  const referee::Vec3 x = (start - start.dot(along) * along).normalized(), y = along.cross(x);
  Unwrapped unwrap;
  double phase = 0, drift = 0;
  simulation.run([&](Simulation& now) {
    const referee::Vec3 axis = axis_of(now);
    phase = unwrap(std::atan2(axis.dot(y), axis.dot(x)));
    drift = largest(drift, std::abs(angle_of(axis) - cone));
  });
  context.compare("precession", phase / simulation.time(), rate, rate);
  context.add({"cone_drift", drift * degrees, 0.0, drift / cone, std::nullopt, ""});
}

void measure_heavy_top(MeasureContext& context) {
  const std::string& motion = arg_text(context.scene(), "motion");
  if (motion == "steady") return steady(context);
  if (motion == "released") return released(context);
  throw UsageError("scene " + context.scene().id + ": motion of heavy_top is steady or released, not " + motion);
}

}  // namespace plumb::harness
