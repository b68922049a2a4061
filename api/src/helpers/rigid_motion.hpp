// A body's mass and velocity as a helper predicts them within a step.
#pragma once

#include "common.hpp"

namespace plumb::helpers {

struct RigidMotion {
  PlumbPose pose;
  MassRow mass;
  PlumbVec3 centre;
  Velocity velocity;

  static RigidMotion read(IPhysicsWorld& world, PlumbBody body) {
    RigidMotion motion{};
    motion.pose = read_one<PlumbPose>(world, PLUMB_FIELD_POSE, body);
    motion.mass = read_one<MassRow>(world, PLUMB_FIELD_MASS, body);
    motion.velocity = read_one<Velocity>(world, PLUMB_FIELD_VELOCITY, body);
    motion.centre = centre_of_mass(motion.pose, motion.mass);
    return motion;
  }

  [[nodiscard]] PlumbVec3 velocity_at(const PlumbVec3& point) const {
    return add(velocity.linear, cross(velocity.angular, sub(point, centre)));
  }
  /// What turns: I^-1 of an angular impulse.
  [[nodiscard]] PlumbVec3 turned_by(const PlumbVec3& impulse) const {
    const PlumbQuat axes = multiply(pose.orientation, mass.orientation);
    const PlumbVec3 local = unrotate(axes, impulse);
    const auto share = [](double value, double inertia) { return inertia > 0 ? value / inertia : 0; };
    return rotate(axes,
                  {share(local.x, mass.inertia.x), share(local.y, mass.inertia.y), share(local.z, mass.inertia.z)});
  }
  /// Change of the speed along `along` at a point, by a unit impulse there: 1 / effective mass.
  [[nodiscard]] double ease(const PlumbVec3& point, const PlumbVec3& along) const {
    const PlumbVec3 arm = cross(sub(point, centre), along);
    return 1 / mass.mass + dot(arm, turned_by(arm));
  }
  void push(const PlumbVec3& impulse, const PlumbVec3& point) {
    velocity.linear = add(velocity.linear, scale(1 / mass.mass, impulse));
    velocity.angular = add(velocity.angular, turned_by(cross(sub(point, centre), impulse)));
  }
};

}  // namespace plumb::helpers
