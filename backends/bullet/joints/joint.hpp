// A joint: Bullet's constraint, the springs that we put beside it, and what the interface asks of it.
#pragma once

#include <memory>
#include <vector>

#include "body.hpp"
#include "joints/axis_rows.hpp"

namespace plumb::bullet {

struct Joint {
  Joint(PlumbJoint id, const PlumbJointDesc& d) : handle(id), desc(d) {}

  PlumbJoint handle;
  PlumbJointDesc desc;     ///< as it is by now
  Body* body_a = nullptr;  ///< null: the world
  Body* body_b = nullptr;
  btRigidBody* a = nullptr;                          ///< body_a, or the world's own fixed body
  btTransform frame_a = btTransform::getIdentity();  ///< seen from Bullet's transforms of the bodies
  btTransform frame_b = btTransform::getIdentity();

  std::unique_ptr<btTypedConstraint> constraint;
  btHingeConstraint* hinge = nullptr;  ///< the constraint, where it is one of these
  btGeneric6DofSpring2Constraint* axes = nullptr;
  DistanceConstraint* distance = nullptr;
  std::vector<std::unique_ptr<AxisSpring>> springs;

  bool enabled = true;
  bool solved = false;  ///< it is in Bullet's world: enabled, and one of its bodies can be moved
  bool wants_reaction = false;
  std::unique_ptr<btJointFeedback[]> feedback;  ///< of the constraint and of each spring
  btVector3 arm_b = btVector3(0, 0, 0);         ///< from b's centre of mass to frame b when last solved, world axes
  double force[3] = {}, torque[3] = {};         ///< on b at frame b, in the last sub-step

  [[nodiscard]] bool breaks() const { return desc.break_force > 0 || desc.break_torque > 0; }
};

/// What the six coordinates of a joint are. joint_coordinates.cpp
void joint_coordinates(const Joint& joint, double* row);

/// Makes the constraint and its springs. joint_makers.cpp
void make_constraint(Joint& joint);

/// Whether an axis of a joint is one that a motor can drive.
[[nodiscard]] bool may_have_motor(const PlumbJointDesc& desc, std::size_t axis);

/// Hands where desc.springs rest, and desc.rest_length, to the constraints.
void set_rests(Joint& joint);

/// Hands desc.motors to the constraint, for sub-steps of h seconds: Bullet wants a hinge's motor as an impulse.
void set_motors(Joint& joint, btScalar h);

}  // namespace plumb::bullet
