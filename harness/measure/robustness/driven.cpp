// Measures in which the host drives a scene while it runs: a press, and velocities turned round.
#include <algorithm>
#include <array>
#include <cmath>

#include "measure/instruments/args.hpp"
#include "measure/instruments/mechanics.hpp"
#include "measure/instruments/series.hpp"
#include "measure/robustness/robustness.hpp"
#include "truth/pendulums.hpp"

namespace plumb::harness {
namespace {

/// How far each plate is from where it began, towards the middle, m: in for a second, still for half, back at 1 m/s.
double plate_way(double time, double depth) {
  constexpr double pressed = 1, released = 1.5;  // s
  if (time <= pressed) return depth * time / pressed;
  return time <= released ? depth : depth - (time - released);
}

std::array<double, 6> turned_round(const VelocityRow& row) {
  return {-row.linear.x, -row.linear.y, -row.linear.z, -row.angular.x, -row.angular.y, -row.angular.z};
}

}  // namespace

void measure_press(MeasureContext& context) {
  constexpr double release = 1.5;  // s, as in plate_way
  const Scene& scene = context.scene();
  const std::size_t box = arg_body(scene, "box");
  const std::array<std::size_t, 2> plates{arg_body(scene, "lower"), arg_body(scene, "upper")};
  const double depth = arg_number(scene, "squeeze") / 2;
  const double reach = referee::vec(scene.shapes[*scene.bodies[box].shape].desc.half_extents).norm();
  Simulation simulation = context.simulate(scene);
  double before = 0, after = 0;
  while (true) {
    for (const std::size_t plate : plates) {
      const PlumbPose& start = scene.bodies[plate].desc.pose;
      const double way = plate_way(simulation.time() + scene.dt, depth);
      const double y = start.position.y - std::copysign(way, start.position.y);
      const std::array<double, 7> target{start.position.x, y, start.position.z, 0, 0, 0, 1};
      simulation.write(PLUMB_FIELD_KINEMATIC_TARGET, plate, target);
    }
    if (!simulation.advance()) break;
    const VelocityRow& velocity = simulation.velocities()[box];
    const double speed = referee::vec(velocity.linear).norm() + reach * referee::vec(velocity.angular).norm();
    double& fastest = simulation.time() < release + scene.dt / 2 ? before : after;
    fastest = largest(fastest, speed);
  }
  context.expect("finite", simulation.finite() && std::isfinite(after), true);
  context.deviation("speed_after", after);
  context.deviation("speed_pressed", before);
}

void measure_time_reversal(MeasureContext& context) {
  Scene scene = context.scene();
  const double size = arg_number(scene, "size"), pendulum = arg_number(scene, "pendulum");
  scene.needs |= scene.joints.empty() ? PLUMB_NEED_COLLISION | PLUMB_NEED_RESTITUTION : PLUMB_NEED_JOINTS;
  Simulation simulation = context.simulate(scene);
  const auto half = static_cast<std::uint64_t>(std::lround(scene.seconds / scene.dt / 2));
  while (simulation.steps() < half && simulation.advance()) continue;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body)
    simulation.write(PLUMB_FIELD_VELOCITY, body, turned_round(simulation.velocities()[body]));
  while (simulation.steps() < 2 * half && simulation.advance()) continue;

  double miss = 0, speed_miss = 0;
  for (std::size_t body = 0; body < scene.bodies.size(); ++body) {
    const PlumbBodyDesc& start = scene.bodies[body].desc;
    const PlumbVec3& end = simulation.poses()[body].position;
    miss = largest(miss, (referee::vec(end) - referee::vec(start.pose.position)).norm());
    const referee::Vec3 velocity = referee::vec(simulation.velocities()[body].linear);
    speed_miss = largest(speed_miss, (velocity + referee::vec(start.linear_velocity)).norm());
  }
  if (pendulum > 0) {
    // The pendulum swings about the origin, from rest at this angle.
    const auto run = [&](truth::PendulumState from) {
      return truth::semi_implicit_pendulum(-scene.gravity.y, size, from, scene.dt, half);
    };
    const truth::PendulumState there = run({pendulum, 0}), back = run({there.angle, -there.rate});
    const referee::Vec3 scheme = size * referee::Vec3(std::sin(back.angle), -std::cos(back.angle), 0);
    const referee::Vec3 start = referee::vec(scene.bodies.front().desc.pose.position);
    const double apart = (referee::vec(simulation.poses().front().position) - scheme).norm();
    context.add({"return", miss / size, 0.0, miss / size, apart / size,
                 "semi-implicit Euler in the angle misses by " + std::to_string((scheme - start).norm() / size)});
  } else {
    context.deviation("return", miss / size);
  }
  context.deviation("return_speed", speed_miss);
}

}  // namespace plumb::harness
