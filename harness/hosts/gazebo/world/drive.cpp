// Limits, motors, springs and forces of joints, and the host's forces on links.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "hosts/gazebo/world/console.hpp"
#include "hosts/gazebo/world/joint_frames.hpp"
#include "hosts/gazebo/world/motors.hpp"
#include "hosts/gazebo/world/world.hpp"

namespace plumb::gazebo {
namespace {

/// Gazebo writes "none" as 1e16 or as infinity; Plumb takes finite numbers.
constexpr double kNone = 1e15;
constexpr double kFar = 1e6;     // m
constexpr double kStrong = 1e9;  // N or N m

}  // namespace

PlumbLimit limit_of(const Joint& joint, std::size_t index) {
  const JointAxis& axis = joint.axes[index];
  const bool below = axis.lower > -kNone, above = axis.upper < kNone;
  if (joint.kind == JointKind::ball || (!below && !above)) return {0, 0, 0, 0};
  if (joint.kind == JointKind::prismatic) return {below ? axis.lower : -kFar, above ? axis.upper : kFar, 1, 0};
  if ((below && axis.lower < -M_PI) || (above && axis.upper > M_PI)) {
    warn_once("joint [" + joint.name + "] turns without limits: those of half a turn and more are not held");
    return {0, 0, 0, 0};
  }
  return {below ? axis.lower : -M_PI, above ? axis.upper : M_PI, 1, 0};
}

PlumbMotor motor_of(const Joint& joint, std::size_t index) {
  const JointAxis& axis = joint.axes[index];
  if (axis.command) return {*axis.command, std::min(axis.effort, kStrong), 1, 0};
  if (axis.friction > 0) return {0, std::min(axis.friction, kStrong), 1, 0};
  return {0, 0, 0, 0};
}

void World::drive(double dt) {
  for_each_joint([this, dt](Joint& joint) {
    if (!joint.attached) return;
    std::array<double, 12> motors{};
    for (std::size_t i = 0; i < joint.axes.size(); ++i) {
      JointAxis& axis = joint.axes[i];
      double force = std::exchange(axis.force, 0);
      if (axis.damping > 0 || axis.stiffness > 0) {
        // As it will be at the step's end, with the inertia of the two links alone: never stiffer than is stable.
        const double inertia = inertia_along(joint, i), rate = rate_of(joint, i);
        const double stretch = axis.position - axis.rest + rate * dt;
        force -= (axis.stiffness * stretch + axis.damping * rate) /
                 (1 + (axis.damping * dt + axis.stiffness * dt * dt) / inertia);
      }
      axis.applied = force;
      if (force != 0) push(joint, i, force);
      const PlumbMotor motor = motor_of(joint, i);
      motors[2 * plumb_axis(joint, i)] = motor.target_velocity;
      motors[2 * plumb_axis(joint, i) + 1] = motor.max_force;
    }
    if (!std::exchange(joint.motors_changed, false) || joint.joint == 0) return;
    check(*physics_,
          physics_->joints()->write_joints(PLUMB_JOINT_MOTOR, {&joint.joint, 1},
                                           const_rows_over(std::span<const std::array<double, 12>>(&motors, 1))));
  });

  std::vector<PlumbBody> pushed;
  std::vector<double> forces, torques;
  for (Link* link : moving_) {
    const Vector force = std::exchange(link->force, Vector::Zero), torque = std::exchange(link->torque, Vector::Zero);
    if (force == Vector::Zero && torque == Vector::Zero) continue;
    pushed.push_back(link->parts[0].body);
    forces.insert(forces.end(), {force.X(), force.Y(), force.Z()});
    torques.insert(torques.end(), {torque.X(), torque.Y(), torque.Z()});
  }
  write(PLUMB_FIELD_FORCE, pushed, forces);
  write(PLUMB_FIELD_TORQUE, pushed, torques);
}

}  // namespace plumb::gazebo
