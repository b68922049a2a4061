#include "convert/sdf/sdf_joints.hpp"

#include <cmath>
#include <sdf/JointAxis.hh>

#include "convert/sdf/sdf_types.hpp"

namespace plumb::harness {
namespace {

using referee::Pose;
using referee::Vec3;

struct Kind {
  PlumbJointType type;
  std::size_t axes;   ///< how many the file gives
  std::size_t first;  ///< the scene joint's axis of the first
};

Kind kind_of(const sdf::Joint& joint, const std::string& name) {
  switch (joint.Type()) {
    case sdf::JointType::REVOLUTE:
    case sdf::JointType::CONTINUOUS: return {PLUMB_JOINT_HINGE, 1, 3};
    case sdf::JointType::PRISMATIC: return {PLUMB_JOINT_SLIDER, 1, 0};
    case sdf::JointType::UNIVERSAL:
    case sdf::JointType::REVOLUTE2: return {PLUMB_JOINT_UNIVERSAL, 2, 3};
    case sdf::JointType::BALL: return {PLUMB_JOINT_BALL, 0, 0};
    case sdf::JointType::FIXED: return {PLUMB_JOINT_FIXED, 0, 0};
    default:
      throw UsageError(fmt::format(
          "joint \"{}\" is a screw, a gearbox or of another kind that scenes lack; they have revolute, continuous, "
          "prismatic, universal, revolute2, ball and fixed ones",
          name));
  }
}

JointAxis axis_of(const sdf::Joint& joint, unsigned index, const Pose& world, bool continuous,
                  const std::string& name) {
  const sdf::JointAxis* axis = joint.Axis(index);
  if (axis == nullptr) throw UsageError(fmt::format("joint \"{}\" has no axis {}", name, index));
  ignition::math::Vector3d direction;
  check_sdf("joint \"" + name + "\"", axis->ResolveXyz(direction));
  JointAxis read;
  read.direction = world.rotation * vec_of(direction);
  read.friction = axis->Friction();
  if (axis->Effort() > 0) read.effort = axis->Effort();                // 0 is what many write who know none
  const bool limited = axis->Lower() > -1e15 || axis->Upper() < 1e15;  // 1e16 is what SDF says for none
  if (limited && !continuous) {
    if (!(axis->Lower() <= axis->Upper()))
      throw UsageError(fmt::format("joint \"{}\": its lower limit {} is above its upper limit {}", name, axis->Lower(),
                                   axis->Upper()));
    read.limits = {{axis->Lower(), axis->Upper()}};
  }
  read.damping = axis->Damping();
  read.stiffness = axis->SpringStiffness();
  read.rest = axis->SpringReference();
  for (const auto& [key, value] : {std::pair("damping", read.damping), {"spring_stiffness", read.stiffness}})
    if (!(value >= 0))
      throw UsageError(fmt::format("joint \"{}\": its {} is {}; it must be 0 or above", name, key, value));
  return read;
}

}  // namespace

void add_sdf_joint(const sdf::Joint& joint, const std::string& name, const Pose& model, const JointEnds& ends,
                   Imported& imported) {
  const Kind kind = kind_of(joint, name);
  const auto& bodies = imported.scene.bodies;
  const auto moves = [&](std::size_t body) { return bodies[body].desc.motion == PLUMB_DYNAMIC; };
  if (!(ends.parent && moves(*ends.parent)) && !moves(ends.child)) {
    imported.remarks.add("joints between what does not move are left out", name);
    return;
  }
  ignition::math::Pose3d pose;
  check_sdf("joint \"" + name + "\"", joint.SemanticPose().Resolve(pose, "__model__"));
  const Pose world = model * pose_of(pose);
  std::vector<JointAxis> axes;
  for (unsigned i = 0; i < kind.axes; ++i)
    axes.push_back(axis_of(joint, i, world, joint.Type() == sdf::JointType::CONTINUOUS, name));
  Pose frame = world;
  if (axes.size() == 1) frame = frame_of(world.position, axes[0].direction);
  if (axes.size() == 2) {
    if (std::abs(axes[0].direction.normalized().dot(axes[1].direction.normalized())) > 1e-6)
      imported.remarks.add("two axes that are not square to each other are made so", name);
    frame = frame_of(world.position, axes[0].direction, axes[1].direction);
  }
  add_joint(imported, name, {kind.type, ends.parent, ends.child, frame, kind.first}, axes);
}

}  // namespace plumb::harness
