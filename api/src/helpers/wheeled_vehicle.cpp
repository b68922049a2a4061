#include "plumb/helpers/wheeled_vehicle.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "common.hpp"

namespace plumb::helpers {
namespace {

using MotorRow = std::array<double, 12>;  // target velocity and most force, axis by axis

/// The frame whose x and y axes are these unit vectors, square to each other.
PlumbQuat frame_of(const PlumbVec3& x, const PlumbVec3& y) {
  const PlumbVec3 z = cross(x, y);
  return backend::quaternion_of({{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}});
}

/// Along the strut axis 0 is sprung, and about it axis 3 steers.
PlumbJointDesc strut(const JointWheel& wheel, double max_steering) {
  PlumbJointDesc desc = joint_desc(wheel.steered ? PLUMB_JOINT_GENERIC : PLUMB_JOINT_SLIDER);
  desc.springs[0] = {0, wheel.frequency, wheel.damping_ratio, 1, 0};
  if (!wheel.steered) return desc;
  for (PlumbAxisMode& mode : desc.axis_modes) mode = PLUMB_AXIS_LOCKED;
  desc.axis_modes[0] = PLUMB_AXIS_FREE;  // not every engine has both a spring and a limit on one axis
  desc.axis_modes[3] = PLUMB_AXIS_LIMITED;
  desc.limits[3] = {-max_steering, max_steering, 1, 0};
  desc.motors[3] = {0, 0, 1, 0};
  return desc;
}

}  // namespace

WheeledVehicle::WheeledVehicle(IPhysicsWorld& world, PlumbBody chassis, const WheeledVehicleSettings& settings)
    : world_(world),
      extension_(require_extension(world.joints(), "wheeled vehicle", PLUMB_EXT_JOINTS, "PLUMB_NEED_JOINTS")),
      chassis_(chassis),
      settings_(settings) {
  require(!settings.wheels.empty(), "wheeled vehicle: no wheels: give one or more");
  for (const JointWheel& wheel : settings.wheels)
    require(wheel.radius > 0 && wheel.width > 0 && wheel.mass > 0 && wheel.frequency > 0,
            "wheeled vehicle: radius, width, mass and frequency of a wheel must be above 0");
  try {
    create();
  } catch (...) {
    destroy();
    throw;
  }
}

WheeledVehicle::~WheeledVehicle() { destroy(); }

PlumbBody WheeledVehicle::create_part(PlumbShape shape, const PlumbPose& pose, const PlumbVec3& velocity,
                                      const JointWheel& wheel, double mass) {
  PlumbBodyDesc desc = body_desc();
  desc.shape = shape;
  desc.pose = pose;
  desc.linear_velocity = velocity;
  desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
  desc.mass = mass;
  if (shape == 0) {  // a hub: as heavy to turn as a ball of half the wheel's radius
    desc.mass_mode = PLUMB_MASS_EXPLICIT;
    const double inertia = 0.4 * mass * wheel.radius * wheel.radius / 4;
    desc.inertia = {inertia, inertia, inertia};
  }
  desc.material.friction = wheel.friction;
  desc.filter.group = settings_.group;
  desc.flags = PLUMB_BODY_NEVER_SLEEPS;  // motors' new targets need not wake it
  PlumbBody body = 0;
  check(world_, world_.create_bodies({&desc, 1}, {&body, 1}));
  return body;
}

void WheeledVehicle::create() {
  const PlumbPose chassis = read_one<PlumbPose>(world_, PLUMB_FIELD_POSE, chassis_);
  const PlumbVec3 velocity = read_one<Velocity>(world_, PLUMB_FIELD_VELOCITY, chassis_).linear;
  const PlumbVec3 left = cross(settings_.up, settings_.forward);
  const PlumbQuat along_strut = frame_of(settings_.up, settings_.forward);
  const PlumbQuat along_axle = frame_of(left, settings_.up);
  const PlumbQuat cylinder = frame_of(settings_.forward, left);  // whose y is the axle
  for (const JointWheel& wheel : settings_.wheels) {
    PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
    desc.radius = wheel.radius;
    desc.half_height = wheel.width / 2;
    PlumbShape shape = 0;
    check(world_, world_.create_shapes({&desc, 1}, {&shape, 1}));
    shapes_.push_back(shape);
    const PlumbPose hub = compose(chassis, {wheel.centre, {0, 0, 0, 1}});
    hubs_.push_back(create_part(0, hub, velocity, wheel, wheel.mass / 2));
    wheels_.push_back(create_part(shape, compose(hub, {{}, cylinder}), velocity, wheel, wheel.mass));
    PlumbJointDesc joint = strut(wheel, settings_.max_steering);
    joint.body_a = chassis_;
    joint.body_b = hubs_.back();
    joint.frame_a = {wheel.centre, along_strut};
    joint.frame_b = {{}, along_strut};
    struts_.push_back(0);
    check(world_, extension_.create_joints({&joint, 1}, {&struts_.back(), 1}));
    joint = joint_desc(PLUMB_JOINT_HINGE);
    joint.body_a = hubs_.back();
    joint.body_b = wheels_.back();
    joint.frame_a = {{}, along_axle};
    joint.frame_b = {{}, multiply(conjugate(cylinder), along_axle)};
    joint.motors[3] = {0, 0, 1, 0};
    axles_.push_back(0);
    check(world_, extension_.create_joints({&joint, 1}, {&axles_.back(), 1}));
  }
}

void WheeledVehicle::destroy() {
  for (const std::vector<PlumbJoint>* joints : {&axles_, &struts_})
    for (const PlumbJoint joint : *joints)
      if (joint != 0) extension_.destroy_joints({&joint, 1});
  world_.destroy_bodies(wheels_);
  world_.destroy_bodies(hubs_);
  world_.destroy_shapes(shapes_);
}

void WheeledVehicle::drive(double steering, double wheel_speed, double torque, double brake) {
  require(torque >= 0 && brake >= 0, "wheeled vehicle: torque and brake must be 0 or more");
  std::vector<MotorRow> axles(axles_.size());
  for (std::size_t i = 0; i < axles.size(); ++i) {
    const bool driven = settings_.wheels[i].driven && brake == 0;
    axles[i][6] = driven ? wheel_speed : 0;
    axles[i][7] = brake > 0 ? brake : driven ? torque : 0;
  }
  check(world_, extension_.write_joints(PLUMB_JOINT_MOTOR, axles_, const_rows_over(std::span<const MotorRow>(axles))));
  const double target = std::clamp(steering, -settings_.max_steering, settings_.max_steering);
  for (std::size_t i = 0; i < struts_.size(); ++i) {
    if (!settings_.wheels[i].steered) continue;
    std::array<double, 6> at{};
    check(world_, extension_.read_joints(PLUMB_JOINT_COORDINATES, {&struts_[i], 1}, rows_over(std::span(&at, 1))));
    MotorRow row{};
    row[6] = settings_.steering_gain * (target - at[3]);
    row[7] = settings_.steering_torque;
    check(world_, extension_.write_joints(PLUMB_JOINT_MOTOR, {&struts_[i], 1},
                                          const_rows_over(std::span<const MotorRow>(&row, 1))));
  }
}

double WheeledVehicle::speed() const {
  const PlumbPose pose = read_one<PlumbPose>(world_, PLUMB_FIELD_POSE, chassis_);
  const Velocity velocity = read_one<Velocity>(world_, PLUMB_FIELD_VELOCITY, chassis_);
  return dot(velocity.linear, rotate(pose.orientation, settings_.forward));
}

}  // namespace plumb::helpers
