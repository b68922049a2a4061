#include "hosts/gazebo/features/joints.hpp"

#include <cmath>

#include "hosts/gazebo/features/eigen.hpp"
#include "hosts/gazebo/world/console.hpp"
#include "hosts/gazebo/world/groups.hpp"
#include "hosts/gazebo/world/joint_frames.hpp"

namespace plumb::gazebo {

JointAxis* JointFeatures::axis_for(const char* what, std::size_t id, std::size_t axis, double value) const {
  Joint* joint = joint_of(id);
  std::string fault;
  if (joint == nullptr || !joint->attached)
    fault = "the joint is gone";
  else if (axis >= joint->axes.size())
    fault = "it has " + std::to_string(joint->axes.size()) + " axes, and this is " + std::to_string(axis);
  else if (std::isnan(value))
    fault = "the value is not a finite number";
  if (fault.empty()) return &joint->axes[axis];
  complain(std::string(what) + " of joint [" + (joint != nullptr ? joint->name : "") + "] is left out: " + fault);
  return nullptr;
}

const JointAxis* JointFeatures::axis_of_joint(std::size_t id, std::size_t axis) const {
  const Joint* joint = joint_of(id);
  return joint != nullptr && axis < joint->axes.size() ? &joint->axes[axis] : nullptr;
}

double JointFeatures::GetJointPosition(const Identity& joint, std::size_t axis) const {
  const JointAxis* found = axis_of_joint(joint, axis);
  return found != nullptr ? found->position : 0;
}
double JointFeatures::GetJointVelocity(const Identity& joint, std::size_t axis) const {
  const JointAxis* found = axis_of_joint(joint, axis);
  return found != nullptr && joint_of(joint)->attached ? rate_of(*joint_of(joint), axis) : 0;
}
double JointFeatures::GetJointAcceleration(const Identity& joint, std::size_t axis) const {
  const JointAxis* found = axis_of_joint(joint, axis);
  return found != nullptr ? found->acceleration : 0;
}
double JointFeatures::GetJointForce(const Identity& joint, std::size_t axis) const {
  const JointAxis* found = axis_of_joint(joint, axis);
  return found != nullptr ? found->force : 0;
}
physics::Pose3d JointFeatures::GetJointTransform(const Identity& id) const {
  const Joint* joint = joint_of(id);
  if (joint == nullptr || joint->child == nullptr) return physics::Pose3d::Identity();
  const Placement from = joint->parent != nullptr ? joint->parent->pose : Placement::Zero;
  return to_eigen(from.Inverse() * joint->child->pose);
}

void JointFeatures::SetJointPosition(const Identity& joint, std::size_t axis, double value) {
  if (!std::isfinite(value)) value = std::nan("");
  if (axis_for("a position", joint, axis, value) != nullptr) set_coordinate(*joint_of(joint), axis, value);
}
void JointFeatures::SetJointVelocity(const Identity& joint, std::size_t axis, double value) {
  if (!std::isfinite(value)) value = std::nan("");
  if (axis_for("a velocity", joint, axis, value) != nullptr) set_rate(*joint_of(joint), axis, value);
}
void JointFeatures::SetJointAcceleration(const Identity& /*joint*/, std::size_t /*axis*/, double /*value*/) {
  warn_once("accelerations of joints follow from forces and cannot be set; set a force or a velocity command");
}
void JointFeatures::SetJointForce(const Identity& joint, std::size_t axis, double value) {
  if (!std::isfinite(value)) value = std::nan("");
  JointAxis* found = axis_for("a force", joint, axis, value);
  if (found == nullptr) return;
  found->force = value;
  if (!found->command) return;
  found->command.reset();  // who gives a force no longer wants a velocity
  joint_of(joint)->motors_changed = true;
}
void JointFeatures::SetJointVelocityCommand(const Identity& id, std::size_t axis, double value) {
  if (!std::isfinite(value)) value = std::nan("");
  JointAxis* found = axis_for("a velocity command", id, axis, value);
  if (found == nullptr) return;
  Joint* joint = joint_of(id);
  if (joint->kind == JointKind::ball) return warn_once("ball joints have no motors: velocity commands are left out");
  joint->motors_changed |= !found->command || *found->command != value;
  found->command = value;
}
void JointFeatures::SetJointMinPosition(const Identity& joint, std::size_t axis, double value) {
  JointAxis* found = axis_for("a limit", joint, axis, value);
  if (found == nullptr) return;
  found->lower = value;
  joint_of(joint)->model->world->rebuild(*joint_of(joint));
}
void JointFeatures::SetJointMaxPosition(const Identity& joint, std::size_t axis, double value) {
  JointAxis* found = axis_for("a limit", joint, axis, value);
  if (found == nullptr) return;
  found->upper = value;
  joint_of(joint)->model->world->rebuild(*joint_of(joint));
}
void JointFeatures::SetJointMinEffort(const Identity& joint, std::size_t axis, double value) {
  SetJointMaxEffort(joint, axis, -value);
}
void JointFeatures::SetJointMaxEffort(const Identity& joint, std::size_t axis, double value) {
  if (value < 0) value = std::nan("");
  JointAxis* found = axis_for("an effort limit", joint, axis, value);
  if (found == nullptr) return;
  found->effort = value;
  joint_of(joint)->motors_changed = true;
}

std::size_t JointFeatures::GetJointDegreesOfFreedom(const Identity& id) const {
  const Joint* joint = joint_of(id);
  return joint != nullptr ? joint->axes.size() : 0;
}
physics::Pose3d JointFeatures::GetJointTransformFromParent(const Identity& id) const {
  const Joint* joint = joint_of(id);
  return joint != nullptr ? to_eigen(joint->in_parent) : physics::Pose3d::Identity();
}
physics::Pose3d JointFeatures::GetJointTransformToChild(const Identity& id) const {
  const Joint* joint = joint_of(id);
  return joint != nullptr ? to_eigen(joint->in_child.Inverse()) : physics::Pose3d::Identity();
}

void JointFeatures::place(std::size_t id, const Placement* in_parent, const Placement* in_child) {
  Joint* joint = joint_of(id);
  if (joint == nullptr || !joint->attached) return complain("the frames of a joint that is gone were to be set");
  if ((in_parent != nullptr && !in_parent->IsFinite()) || (in_child != nullptr && !in_child->IsFinite()))
    return complain("joint [" + joint->name + "] stays as it is: its frames must be finite");
  set_frames(*joint, in_parent != nullptr ? *in_parent : joint->in_parent,
             in_child != nullptr ? *in_child : joint->in_child);
  joint->model->world->rebuild(*joint);
}
void JointFeatures::SetJointTransformFromParent(const Identity& joint, const physics::Pose3d& pose) {
  const Placement in_parent = from_eigen(pose);
  place(joint, &in_parent, nullptr);
}
void JointFeatures::SetJointTransformToChild(const Identity& joint, const physics::Pose3d& pose) {
  const Placement in_child = from_eigen(pose).Inverse();
  place(joint, nullptr, &in_child);
}

void JointFeatures::DetachJoint(const Identity& id) {
  Joint* joint = joint_of(id);
  if (joint == nullptr) return complain("a joint that is gone was to be detached");
  joint->model->world->forget(*joint);
}

physics::Wrench3d JointFeatures::GetJointTransmittedWrenchInJointFrame(const Identity& id) const {
  physics::Wrench3d wrench;
  wrench.force.setZero();
  wrench.torque.setZero();
  Joint* joint = joint_of(id);
  if (joint == nullptr || !joint->attached) return wrench;
  Vector force, torque;
  if (!joint->model->world->reaction(*joint, force, torque)) {
    warn_once("the backend " + joint->model->world->engine() + " tells no reactions: wrenches of joints read 0");
    return wrench;
  }
  for (std::size_t i = 0; i < joint->axes.size(); ++i)
    (joint->kind == JointKind::prismatic ? force : torque) += axis_of(*joint, i) * joint->axes[i].applied;
  const Rotation frame = joint->child->pose.Rot() * joint->in_child.Rot();
  wrench.force = to_eigen(frame.RotateVectorReverse(force));
  wrench.torque = to_eigen(frame.RotateVectorReverse(torque));
  return wrench;
}

Identity JointFeatures::cast(std::size_t id, JointKind kind) const {
  const Joint* joint = joint_of(id);
  return joint != nullptr && joint->kind == kind ? identity_of(joint) : GenerateInvalidId();
}
Identity JointFeatures::CastToFixedJoint(const Identity& joint) const { return cast(joint, JointKind::fixed); }
Identity JointFeatures::CastToRevoluteJoint(const Identity& joint) const { return cast(joint, JointKind::revolute); }
Identity JointFeatures::CastToPrismaticJoint(const Identity& joint) const { return cast(joint, JointKind::prismatic); }

namespace {
Eigen::Vector3d first_axis(const Joint* joint) {
  return to_eigen(joint != nullptr ? joint->turn.RotateVector(Vector::UnitX) : Vector::Zero);
}
}  // namespace
physics::AngularVector3d JointFeatures::GetRevoluteJointAxis(const Identity& joint) const {
  return first_axis(joint_of(joint));
}
physics::LinearVector3d JointFeatures::GetPrismaticJointAxis(const Identity& joint) const {
  return first_axis(joint_of(joint));
}

Identity JointFeatures::attach(std::size_t child_id, const physics::BaseLink3dPtr& parent, const std::string& name,
                               JointKind kind, const Vector& axis) {
  Joint joint;
  joint.name = name;
  joint.kind = kind;
  joint.child = link_of(child_id);
  joint.parent = parent ? link_of(parent->EntityID()) : nullptr;
  if (joint.child == nullptr || (parent && joint.parent == nullptr) || joint.child == joint.parent) {
    complain("joint [" + name + "] is left out: it must join a link with another one, or with the world");
    return GenerateInvalidId();
  }
  if (kind != JointKind::fixed) {
    if (!axis.IsFinite() || axis.Length() < 1e-9) {
      complain("joint [" + name + "] is left out: its axis must be finite and not 0");
      return GenerateInvalidId();
    }
    joint.turn.From2Axes(Vector::UnitX, axis);
    joint.axes.resize(1);
  }
  joint.in_parent = joint.parent != nullptr ? joint.parent->pose.Inverse() * joint.child->pose : joint.child->pose;
  return identity_of(add_joint(*joint.child->model, std::move(joint)));
}
Identity JointFeatures::AttachFixedJoint(const Identity& child, const physics::BaseLink3dPtr& parent,
                                         const std::string& name) {
  return attach(child, parent, name, JointKind::fixed, Vector::UnitX);
}
Identity JointFeatures::AttachRevoluteJoint(const Identity& child, const physics::BaseLink3dPtr& parent,
                                            const std::string& name, const physics::AngularVector3d& axis) {
  return attach(child, parent, name, JointKind::revolute, from_eigen(axis));
}
Identity JointFeatures::AttachPrismaticJoint(const Identity& child, const physics::BaseLink3dPtr& parent,
                                             const std::string& name, const physics::LinearVector3d& axis) {
  return attach(child, parent, name, JointKind::prismatic, from_eigen(axis));
}

}  // namespace plumb::gazebo
