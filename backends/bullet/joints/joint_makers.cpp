// From the interface's joints to Bullet's constraints.
#include <BulletDynamics/ConstraintSolver/btConeTwistConstraint.h>
#include <BulletDynamics/ConstraintSolver/btFixedConstraint.h>

#include "joints/joint.hpp"

namespace plumb::bullet {
namespace {

/// Bullet's hinge turns about z of its frames, ours about x: columns y z x.
btTransform hinge_frame(const btTransform& frame) {
  const btMatrix3x3 turn(0, 0, 1, 1, 0, 0, 0, 1, 0);
  return btTransform(frame.getBasis() * turn, frame.getOrigin());
}

std::unique_ptr<btTypedConstraint> make_hinge(Joint& joint) {
  auto hinge = std::make_unique<btHingeConstraint>(*joint.a, *joint.body_b, hinge_frame(joint.frame_a),
                                                   hinge_frame(joint.frame_b), true);
  const PlumbLimit& limit = joint.desc.limits[3];
  // Softness and bias as Bullet has them; relaxation 0, because 1 makes a limit bounce.
  if (limit.enabled != 0)
    hinge->setLimit(scalar(limit.lower, "limits[3].lower"), scalar(limit.upper, "limits[3].upper"), btScalar(0.9),
                    btScalar(0.3), 0);
  joint.hinge = hinge.get();
  return hinge;
}

/// Bullet's cone is fixed in its second body, where ours is in a; its twist is as far either way, so b's frame is
/// turned by the middle of ours.
std::unique_ptr<btTypedConstraint> make_swing_twist(Joint& joint) {
  const PlumbLimit& twist = joint.desc.limits[3];
  const double middle = twist.enabled != 0 ? (twist.lower + twist.upper) / 2 : 0;
  const btQuaternion back(btVector3(1, 0, 0), -scalar(middle, "limits[3]"));
  auto cone = std::make_unique<btConeTwistConstraint>(*joint.body_b, *joint.a, joint.frame_b * btTransform(back),
                                                      joint.frame_a);
  constexpr btScalar none = BT_LARGE_FLOAT;
  const bool swings = joint.desc.limits[4].enabled == 0;
  cone->setLimit(3, twist.enabled != 0 ? scalar((twist.upper - twist.lower) / 2, "limits[3]") : none);
  cone->setLimit(4, swings ? none : scalar(joint.desc.limits[4].upper, "limits[4].upper"));
  cone->setLimit(5, swings ? none : scalar(joint.desc.limits[5].upper, "limits[5].upper"));
  return cone;
}

PlumbAxisMode axis_mode(const PlumbJointDesc& desc, std::size_t axis) {
  if (desc.type == PLUMB_JOINT_GENERIC) return desc.axis_modes[axis];
  const bool free = (desc.type == PLUMB_JOINT_SLIDER && axis == 0) ||
                    (desc.type == PLUMB_JOINT_UNIVERSAL && (axis == 3 || axis == 4));
  if (!free) return PLUMB_AXIS_LOCKED;
  return desc.limits[axis].enabled != 0 ? PLUMB_AXIS_LIMITED : PLUMB_AXIS_FREE;
}

/// Bullet's six-axis constraint. With the order ZYX its angles are the negatives of ours: x about a's x axis, z about
/// b's z.
std::unique_ptr<btTypedConstraint> make_axes(Joint& joint) {
  auto axes =
      std::make_unique<btGeneric6DofSpring2Constraint>(*joint.a, *joint.body_b, joint.frame_a, joint.frame_b, RO_ZYX);
  for (std::size_t axis = 0; axis < 6; ++axis) {
    btScalar lower = 0, upper = 0;
    const PlumbAxisMode mode = axis_mode(joint.desc, axis);
    if (mode == PLUMB_AXIS_FREE) {
      lower = 1;
      upper = -1;
    } else if (mode == PLUMB_AXIS_LIMITED) {
      lower = scalar(joint.desc.limits[axis].lower, "limits.lower");
      upper = scalar(joint.desc.limits[axis].upper, "limits.upper");
    }
    const int index = static_cast<int>(axis);
    if (mode == PLUMB_AXIS_FREE || axis < 3)
      axes->setLimit(index, lower, upper);
    else
      axes->setLimit(index, -upper, -lower);
  }
  joint.axes = axes.get();
  return axes;
}

std::unique_ptr<btTypedConstraint> make(Joint& joint) {
  btRigidBody &a = *joint.a, &b = *joint.body_b;
  const btVector3 &point_a = joint.frame_a.getOrigin(), &point_b = joint.frame_b.getOrigin();
  switch (joint.desc.type) {
    case PLUMB_JOINT_BALL: return std::make_unique<btPoint2PointConstraint>(a, b, point_a, point_b);
    case PLUMB_JOINT_HINGE: return make_hinge(joint);
    case PLUMB_JOINT_SWING_TWIST: return make_swing_twist(joint);
    case PLUMB_JOINT_FIXED: return std::make_unique<btFixedConstraint>(a, b, joint.frame_a, joint.frame_b);
    case PLUMB_JOINT_DISTANCE: {
      auto distance = std::make_unique<DistanceConstraint>(a, b, point_a, point_b, joint.desc);
      joint.distance = distance.get();
      return distance;
    }
    case PLUMB_JOINT_GEAR:
    case PLUMB_JOINT_RACK_AND_PINION:
      return std::make_unique<MeshConstraint>(a, b, joint.frame_a, joint.frame_b, joint.desc);
    default: return make_axes(joint);
  }
}

}  // namespace

void make_constraint(Joint& joint) {
  joint.constraint = make(joint);
  if (joint.distance == nullptr)
    for (int axis = 0; axis < 6; ++axis)
      if (joint.desc.springs[axis].enabled != 0)
        joint.springs.push_back(
            std::make_unique<AxisSpring>(*joint.a, *joint.body_b, joint.frame_a, joint.frame_b, axis, joint.desc));
}

void set_rests(Joint& joint) {
  if (joint.distance != nullptr) joint.distance->rest_at(scalar(joint.desc.rest_length, "rest_length"));
  for (const auto& spring : joint.springs) spring->rest_at(joint.desc.springs[spring->axis()].rest);
}

bool may_have_motor(const PlumbJointDesc& desc, std::size_t axis) {
  switch (desc.type) {
    case PLUMB_JOINT_HINGE: return axis == 3;
    case PLUMB_JOINT_SLIDER:
    case PLUMB_JOINT_UNIVERSAL:
    case PLUMB_JOINT_GENERIC: return axis_mode(desc, axis) != PLUMB_AXIS_LOCKED;
    default: return false;
  }
}

void set_motors(Joint& joint, btScalar h) {
  for (std::size_t axis = 0; axis < 6; ++axis) {
    const PlumbMotor& motor = joint.desc.motors[axis];
    const auto velocity = static_cast<btScalar>(motor.target_velocity), force = static_cast<btScalar>(motor.max_force);
    const bool on = motor.enabled != 0 && may_have_motor(joint.desc, axis);
    if (joint.hinge != nullptr && axis == 3) {
      joint.hinge->enableAngularMotor(on, velocity, force * h);
    } else if (joint.axes != nullptr) {
      const int index = static_cast<int>(axis);
      joint.axes->enableMotor(index, on);
      joint.axes->setTargetVelocity(index, -velocity);
      joint.axes->setMaxMotorForce(index, force);
    }
  }
}

}  // namespace plumb::bullet
