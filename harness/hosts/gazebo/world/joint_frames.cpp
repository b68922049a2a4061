#include "hosts/gazebo/world/joint_frames.hpp"

#include <cmath>

namespace plumb::gazebo {
namespace {

/// Angle of a rotation about x alone.
double twist(const Rotation& q) {
  const double angle = 2 * std::atan2(q.X(), q.W());
  return std::remainder(angle, 2 * M_PI);
}

bool moves(const Link* link) { return link != nullptr && motion_of(*link) == PLUMB_DYNAMIC; }

/// 1/kg or 1/(kg m2)
double mobility(const Link* link, const Vector& axis, bool linear) {
  if (!moves(link)) return 0;
  const auto& mass = link->inertial.MassMatrix();
  if (linear) return 1 / mass.Mass();
  const Rotation principal = link->pose.Rot() * link->inertial.Pose().Rot() * mass.PrincipalAxesOffset();
  const Vector along = principal.RotateVectorReverse(axis), moments = mass.PrincipalMoments();
  return along.X() * along.X() / moments.X() + along.Y() * along.Y() / moments.Y() +
         along.Z() * along.Z() / moments.Z();
}

}  // namespace

Placement frame_on_parent(const Joint& joint) {
  const Placement frame = joint.in_parent * turned(joint.turn);
  return joint.parent != nullptr ? joint.parent->pose * frame : frame;
}

Placement frame_on_child(const Joint& joint) { return joint.child->pose * joint.in_child * turned(joint.turn); }

Vector axis_of(const Joint& joint, std::size_t axis) {
  if (joint.kind == JointKind::universal && axis == 1) return frame_on_child(joint).Rot().RotateVector(Vector::UnitY);
  const Vector units[] = {Vector::UnitX, Vector::UnitY, Vector::UnitZ};
  return frame_on_parent(joint).Rot().RotateVector(units[axis]);
}

std::size_t plumb_axis(const Joint& joint, std::size_t axis) {
  return joint.kind == JointKind::prismatic ? axis : 3 + axis;
}

double coordinate_of(const Joint& joint, std::size_t axis) {
  const Placement a = frame_on_parent(joint), b = frame_on_child(joint);
  const Rotation q = a.Rot().Inverse() * b.Rot();
  switch (joint.kind) {
    case JointKind::fixed: return 0;
    case JointKind::prismatic: return a.Rot().RotateVectorReverse(b.Pos() - a.Pos()).X();
    case JointKind::revolute: return twist(q);
    case JointKind::universal: {  // about a's x, then about b's y
      if (axis == 0) {
        const Vector y = q.RotateVector(Vector::UnitY);
        return std::atan2(y.Z(), y.Y());
      }
      const Vector x = q.RotateVectorReverse(Vector::UnitX);
      return std::atan2(x.Z(), x.X());
    }
    case JointKind::ball: break;
  }
  const Vector along(q.X(), q.Y(), q.Z());
  const double sine = along.Length();
  const double angle = std::remainder(2 * std::atan2(sine, q.W()), 2 * M_PI);
  return sine < 1e-12 ? 2 * along[axis] * (q.W() < 0 ? -1 : 1) : along[axis] / sine * angle;
}

double rate_of(const Joint& joint, std::size_t axis) {
  if (joint.kind == JointKind::fixed) return 0;
  const Vector along = axis_of(joint, axis);
  if (joint.kind == JointKind::prismatic) {
    const Vector at = frame_on_child(joint).Pos();
    const Vector still = joint.parent != nullptr ? joint.parent->velocity_at(at) : Vector::Zero;
    return along.Dot(joint.child->velocity_at(at) - still);
  }
  const Vector still = joint.parent != nullptr ? joint.parent->spin : Vector::Zero;
  return along.Dot(joint.child->spin - still);
}

void push(Joint& joint, std::size_t axis, double force) {
  const Vector along = axis_of(joint, axis) * force;
  if (joint.kind == JointKind::prismatic) {
    const Vector at = frame_on_child(joint).Pos();
    joint.child->add_force(along, at);
    if (joint.parent != nullptr) joint.parent->add_force(-along, at);
    return;
  }
  joint.child->torque += along;
  if (joint.parent != nullptr) joint.parent->torque -= along;
}

double inertia_along(const Joint& joint, std::size_t axis) {
  const Vector along = axis_of(joint, axis);
  const bool linear = joint.kind == JointKind::prismatic;
  return 1 / (mobility(joint.child, along, linear) + mobility(joint.parent, along, linear));
}

}  // namespace plumb::gazebo
