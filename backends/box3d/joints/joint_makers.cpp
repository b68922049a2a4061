// From a descriptor to Box3D's joint.
#include <algorithm>
#include <numbers>

#include "joints/joint.hpp"
#include "plumb/backend/joint_coordinates.hpp"
#include "plumb/backend/names.hpp"
#include "plumb/backend/usual_capability.hpp"

namespace plumb::box3d {
namespace {

/// Box3D's hinges turn about z, ours about x: z of the turned frame is x of the frame.
constexpr double kHalf = std::numbers::sqrt2 / 2;
constexpr PlumbQuat kZToX{0, kHalf, 0, kHalf};
/// Likewise to the y axis: a wheel spins about z.
constexpr PlumbQuat kZToY{-kHalf, 0, 0, kHalf};

PlumbPose turned(const PlumbPose& frame, const PlumbQuat& by) {
  return {frame.position, backend::multiply(frame.orientation, by)};
}

float value(double number) { return scalar(number, "a number of a joint"); }

/// Box3D takes no limits of an angle beyond these.
float furthest(double angle) {
  constexpr double kMost = 0.99 * std::numbers::pi;
  return value(std::clamp(angle, -kMost, kMost));
}

b3JointId make_ball(b3WorldId world, const b3JointDef& base) {
  b3SphericalJointDef def = b3DefaultSphericalJointDef();
  def.base = base;
  return b3CreateSphericalJoint(world, &def);
}

/// The turn at which the springs of a swing-twist joint rest, between frames whose z is ours' x.
b3Quat target_of(const PlumbJointDesc& desc) {
  const PlumbQuat turn =
      backend::turn_of_swing_twist({desc.springs[3].rest, desc.springs[4].rest, desc.springs[5].rest});
  const PlumbQuat seen = backend::multiply(backend::multiply(backend::conjugate(kZToX), turn), kZToX);
  return {{value(seen.x), value(seen.y), value(seen.z)}, value(seen.w)};
}

/// Its one spring is of all three turns.
void put_springs(const PlumbJointDesc& desc, b3SphericalJointDef& def) {
  const PlumbSpring& spring = desc.springs[3];
  for (std::size_t axis = 4; axis < 6; ++axis) {
    const PlumbSpring& other = desc.springs[axis];
    if (other.enabled != spring.enabled ||
        (spring.enabled != 0 && (other.frequency != spring.frequency || other.damping_ratio != spring.damping_ratio)))
      throw Error(PLUMB_E_UNSUPPORTED,
                  "Box3D has one spring for a swing and its twist; springs[3], [4] and [5] must be "
                  "alike but for where they rest");
  }
  def.enableSpring = spring.enabled != 0;
  def.hertz = value(spring.frequency);
  def.dampingRatio = value(spring.damping_ratio);
  def.targetRotation = target_of(desc);
}

/// Its cone is about z, as its twist is, and round.
b3JointId make_swing_twist(b3WorldId world, const PlumbJointDesc& desc, const b3JointDef& base) {
  const PlumbLimit &twist = desc.limits[3], &cone = desc.limits[4];
  if (cone.enabled != 0 && cone.upper != desc.limits[5].upper)
    throw Error(PLUMB_E_UNSUPPORTED, "Box3D's cones are round; limits[4] and limits[5] must be the same");
  b3SphericalJointDef def = b3DefaultSphericalJointDef();
  def.base = base;
  def.base.localFrameA = transform(turned(desc.frame_a, kZToX), "frame_a");
  def.base.localFrameB = transform(turned(desc.frame_b, kZToX), "frame_b");
  def.enableConeLimit = cone.enabled != 0;
  def.coneAngle = value(cone.upper);
  def.enableTwistLimit = twist.enabled != 0;
  def.lowerTwistAngle = furthest(twist.lower);
  def.upperTwistAngle = furthest(twist.upper);
  put_springs(desc, def);
  return b3CreateSphericalJoint(world, &def);
}

b3JointId make_hinge(b3WorldId world, const PlumbJointDesc& desc, const b3JointDef& base) {
  const PlumbLimit& limit = desc.limits[3];
  const PlumbMotor& motor = desc.motors[3];
  const PlumbSpring& spring = desc.springs[3];
  b3RevoluteJointDef def = b3DefaultRevoluteJointDef();
  def.base = base;
  def.base.localFrameA = transform(turned(desc.frame_a, kZToX), "frame_a");
  def.base.localFrameB = transform(turned(desc.frame_b, kZToX), "frame_b");
  def.enableLimit = limit.enabled != 0;
  def.lowerAngle = furthest(limit.lower);
  def.upperAngle = furthest(limit.upper);
  def.enableMotor = motor.enabled != 0;
  def.motorSpeed = value(motor.target_velocity);
  def.maxMotorTorque = value(motor.max_force);
  def.enableSpring = spring.enabled != 0;
  def.targetAngle = value(spring.rest);
  def.hertz = value(spring.frequency);
  def.dampingRatio = value(spring.damping_ratio);
  return b3CreateRevoluteJoint(world, &def);
}

b3JointId make_slider(b3WorldId world, const PlumbJointDesc& desc, const b3JointDef& base) {
  const PlumbLimit& limit = desc.limits[0];
  const PlumbMotor& motor = desc.motors[0];
  const PlumbSpring& spring = desc.springs[0];
  b3PrismaticJointDef def = b3DefaultPrismaticJointDef();
  def.base = base;
  def.enableLimit = limit.enabled != 0;
  def.lowerTranslation = value(limit.lower);
  def.upperTranslation = value(limit.upper);
  def.enableMotor = motor.enabled != 0;
  def.motorSpeed = value(motor.target_velocity);
  def.maxMotorForce = value(motor.max_force);
  def.enableSpring = spring.enabled != 0;
  def.targetTranslation = value(spring.rest);
  def.hertz = value(spring.frequency);
  def.dampingRatio = value(spring.damping_ratio);
  return b3CreatePrismaticJoint(world, &def);
}

/// Box3D's rod is rigid unless it has a spring, of which one without stiffness leaves room for limits and a motor.
b3JointId make_distance(b3WorldId world, const PlumbJointDesc& desc, const b3JointDef& base) {
  const PlumbLimit& limit = desc.limits[0];
  const PlumbMotor& motor = desc.motors[0];
  const PlumbSpring& spring = desc.springs[0];
  const bool springs = spring.enabled != 0;
  b3DistanceJointDef def = b3DefaultDistanceJointDef();
  def.base = base;
  def.length = value(desc.rest_length);
  def.enableSpring = springs || limit.enabled != 0 || motor.enabled != 0;
  def.hertz = springs ? value(spring.frequency) : 0;
  def.dampingRatio = springs ? value(spring.damping_ratio) : 0;
  def.enableLimit = limit.enabled != 0;
  if (def.enableLimit) {
    def.minLength = value(limit.lower);
    def.maxLength = value(limit.upper);
  }
  def.enableMotor = motor.enabled != 0;
  def.motorSpeed = value(motor.target_velocity);
  def.maxMotorForce = value(motor.max_force);
  return b3CreateDistanceJoint(world, &def);
}

/// A wheel that is steered freely and whose suspension has no travel: its steering axis is a's x, its spin axis b's y.
b3JointId make_universal(b3WorldId world, const PlumbJointDesc& desc, const b3JointDef& base) {
  b3WheelJointDef def = b3DefaultWheelJointDef();
  def.base = base;
  def.base.localFrameB = transform(turned(desc.frame_b, kZToY), "frame_b");
  def.enableSuspensionSpring = false;
  def.enableSuspensionLimit = true;
  def.lowerSuspensionLimit = def.upperSuspensionLimit = 0;
  def.enableSpinMotor = false;
  def.enableSteering = true;
  def.steeringHertz = 0;
  def.maxSteeringTorque = 0;
  return b3CreateWheelJoint(world, &def);
}

b3JointId make_fixed(b3WorldId world, const b3JointDef& base) {
  b3WeldJointDef def = b3DefaultWeldJointDef();
  def.base = base;
  return b3CreateWeldJoint(world, &def);
}

void require_axis(const PlumbJointDesc& desc, PlumbJointFeature feature, std::size_t axis, const char* what) {
  if (joint_has(desc.type, feature) && (desc.type == PLUMB_JOINT_SWING_TWIST || axis == driven_axis(desc.type))) return;
  throw Error(PLUMB_E_UNSUPPORTED, std::string("Box3D's ") + backend::joint_name(desc.type) + " joint has no " + what +
                                       " on axis " + std::to_string(axis) + "; leave it out or take another joint");
}

}  // namespace

bool joint_has(PlumbJointType type, PlumbJointFeature feature) {
  if (feature > PLUMB_JOINT_HAS_SPRINGS) return true;
  if (type == PLUMB_JOINT_SWING_TWIST) return feature == PLUMB_JOINT_HAS_LIMITS || feature == PLUMB_JOINT_HAS_SPRINGS;
  return type == PLUMB_JOINT_HINGE || type == PLUMB_JOINT_SLIDER || type == PLUMB_JOINT_DISTANCE;
}

void check_joint(const PlumbJointDesc& desc) {
  for (std::size_t axis = 0; axis < 6; ++axis) {
    if ((backend::free_axes(desc.type) >> axis & 1) == 0) continue;  // there they mean nothing
    if (desc.limits[axis].enabled != 0) require_axis(desc, PLUMB_JOINT_HAS_LIMITS, axis, "limit");
    if (desc.motors[axis].enabled != 0) require_axis(desc, PLUMB_JOINT_HAS_MOTORS, axis, "motor");
    if (desc.springs[axis].enabled != 0) require_axis(desc, PLUMB_JOINT_HAS_SPRINGS, axis, "spring");
  }
}

b3JointDef base_of(const PlumbJointDesc& desc, b3BodyId a, b3BodyId b) {
  b3JointDef base = b3DefaultWeldJointDef().base;
  base.bodyIdA = a;
  base.bodyIdB = b;
  base.localFrameA = transform(desc.frame_a, "frame_a");
  base.localFrameB = transform(desc.frame_b, "frame_b");
  base.collideConnected = desc.collide_connected != 0;
  if (desc.break_force > 0) base.forceThreshold = value(desc.break_force);
  if (desc.break_torque > 0) base.torqueThreshold = value(desc.break_torque);
  return base;
}

b3JointId make_joint(b3WorldId world, const PlumbJointDesc& desc, const b3JointDef& base) {
  switch (desc.type) {
    case PLUMB_JOINT_BALL: return make_ball(world, base);
    case PLUMB_JOINT_SWING_TWIST: return make_swing_twist(world, desc, base);
    case PLUMB_JOINT_HINGE: return make_hinge(world, desc, base);
    case PLUMB_JOINT_SLIDER: return make_slider(world, desc, base);
    case PLUMB_JOINT_DISTANCE: return make_distance(world, desc, base);
    case PLUMB_JOINT_UNIVERSAL: return make_universal(world, desc, base);
    default: return make_fixed(world, base);
  }
}

void apply_motor(const Joint& joint) {
  const PlumbMotor& motor = joint.desc.motors[driven_axis(joint.desc.type)];
  const bool on = motor.enabled != 0;
  const float speed = value(motor.target_velocity), most = value(motor.max_force);
  if (joint.desc.type == PLUMB_JOINT_HINGE) {
    b3RevoluteJoint_EnableMotor(joint.id, on);
    b3RevoluteJoint_SetMotorSpeed(joint.id, speed);
    b3RevoluteJoint_SetMaxMotorTorque(joint.id, most);
  } else if (joint.desc.type == PLUMB_JOINT_SLIDER) {
    b3PrismaticJoint_EnableMotor(joint.id, on);
    b3PrismaticJoint_SetMotorSpeed(joint.id, speed);
    b3PrismaticJoint_SetMaxMotorForce(joint.id, most);
  } else if (joint.desc.type == PLUMB_JOINT_DISTANCE) {
    b3DistanceJoint_EnableMotor(joint.id, on);
    b3DistanceJoint_SetMotorSpeed(joint.id, speed);
    b3DistanceJoint_SetMaxMotorForce(joint.id, most);
    if (on) b3DistanceJoint_EnableSpring(joint.id, true);
  }
}

void apply_rest(const Joint& joint) {
  const PlumbJointDesc& desc = joint.desc;
  if (desc.type == PLUMB_JOINT_HINGE) b3RevoluteJoint_SetTargetAngle(joint.id, value(desc.springs[3].rest));
  if (desc.type == PLUMB_JOINT_SLIDER) b3PrismaticJoint_SetTargetTranslation(joint.id, value(desc.springs[0].rest));
  if (desc.type == PLUMB_JOINT_DISTANCE) b3DistanceJoint_SetLength(joint.id, value(desc.rest_length));
  if (desc.type == PLUMB_JOINT_SWING_TWIST) b3SphericalJoint_SetTargetRotation(joint.id, target_of(desc));
}

}  // namespace plumb::box3d
