#include <sdf/JointAxis.hh>

#include "hosts/gazebo/sdf/read.hpp"
#include "hosts/gazebo/world/console.hpp"

namespace plumb::gazebo {
namespace {

std::optional<JointKind> kind_of(sdf::JointType type) {
  switch (type) {
    case sdf::JointType::FIXED: return JointKind::fixed;
    case sdf::JointType::REVOLUTE:
    case sdf::JointType::CONTINUOUS: return JointKind::revolute;
    case sdf::JointType::PRISMATIC: return JointKind::prismatic;
    case sdf::JointType::BALL: return JointKind::ball;
    case sdf::JointType::UNIVERSAL: return JointKind::universal;
    default: return std::nullopt;
  }
}

const char* name_of(sdf::JointType type) {
  switch (type) {
    case sdf::JointType::GEARBOX: return "gearbox";
    case sdf::JointType::REVOLUTE2: return "revolute2";
    case sdf::JointType::SCREW: return "screw";
    default: return "unknown";
  }
}

/// In the joint's frame.
Vector direction_of(const sdf::JointAxis& axis, const Rotation& model_in_joint) {
  Vector direction;
  if (axis.ResolveXyz(direction).empty()) return direction;
  // A host has taken it out of its file: then only these two frames are known.
  return axis.XyzExpressedIn() == "__model__" ? model_in_joint.RotateVector(axis.Xyz()) : axis.Xyz();
}

JointAxis record_of(const sdf::JointAxis& said) {
  JointAxis axis;
  axis.lower = said.Lower();
  axis.upper = said.Upper();
  if (said.Effort() >= 0) axis.effort = said.Effort();
  axis.damping = said.Damping();
  axis.friction = said.Friction();
  axis.stiffness = said.SpringStiffness();
  axis.rest = said.SpringReference();
  return axis;
}

/// x along the first axis and y along the second.
Rotation frame_of(const Vector& first, const Vector& second) {
  const Vector x = first.Normalized(), z = x.Cross(second).Normalized(), y = z.Cross(x);
  return Rotation(ignition::math::Matrix3d(x.X(), y.X(), z.X(), x.Y(), y.Y(), z.Y(), x.Z(), y.Z(), z.Z()));
}

}  // namespace

std::optional<Joint> read_joint(const sdf::Joint& said, const Rotation& model_in_child) {
  const std::optional<JointKind> kind = kind_of(said.Type());
  if (!kind) {
    complain("joint [" + said.Name() + "] is left out: joints of type " + name_of(said.Type()) +
             " are not there; there are revolute, continuous, prismatic, ball, universal and fixed");
    return std::nullopt;
  }
  Joint joint;
  joint.name = said.Name();
  joint.kind = *kind;
  joint.in_child = pose_of(said.SemanticPose());
  const Rotation model_in_joint = joint.in_child.Rot().Inverse() * model_in_child;
  if (*kind == JointKind::ball) joint.axes.resize(3);
  if (*kind == JointKind::fixed || *kind == JointKind::ball) return joint;
  Vector directions[2] = {Vector::UnitZ, Vector::UnitY};
  for (unsigned i = 0; i < (*kind == JointKind::universal ? 2U : 1U); ++i) {
    const sdf::JointAxis* axis = said.Axis(i);
    joint.axes.push_back(axis != nullptr ? record_of(*axis) : JointAxis());
    if (axis != nullptr) directions[i] = direction_of(*axis, model_in_joint);
    const double lower = joint.axes[i].lower, upper = joint.axes[i].upper;
    if (lower <= upper && directions[i].IsFinite() && directions[i].Length() > 1e-9) continue;
    complain("joint [" + said.Name() + "] is left out: its axis must be finite and not 0, and its lower limit (" +
             std::to_string(lower) + ") not above its upper one (" + std::to_string(upper) + ")");
    return std::nullopt;
  }
  if (*kind != JointKind::universal) {
    joint.turn.From2Axes(Vector::UnitX, directions[0]);
    return joint;
  }
  if (directions[0].Normalized().Cross(directions[1].Normalized()).Length() < 1e-6) {
    complain("joint [" + said.Name() + "] is left out: its two axes are parallel; give a second one across the first");
    return std::nullopt;
  }
  joint.turn = frame_of(directions[0], directions[1]);
  return joint;
}

}  // namespace plumb::gazebo
