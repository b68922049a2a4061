#include "plumb/helpers/ragdoll.hpp"

#include <algorithm>
#include <cmath>

#include "common.hpp"

namespace plumb::helpers {
namespace {

/// The shortest turn that takes y to a unit vector.
PlumbQuat turn_y_to(const PlumbVec3& to) {
  if (to.y < -1 + 1e-12) return {1, 0, 0, 0};
  return normalized(PlumbQuat{to.z, 0, -to.x, 1 + to.y});
}

PlumbPose rest_pose(const Bone& bone) {
  return {scale(0.5, add(bone.head, bone.tail)), turn_y_to(normalized(sub(bone.tail, bone.head)))};
}

void check_skeleton(std::span<const Bone> skeleton) {
  require(!skeleton.empty(), "ragdoll: a skeleton without bones: give one or more");
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    const Bone& bone = skeleton[i];
    const std::string name = "ragdoll: bone " + std::to_string(i) + " \"" + bone.name + "\"";
    require(bone.parent < static_cast<int>(i) && bone.parent >= -1,
            name + " has parent " + std::to_string(bone.parent) + ": give that of an earlier bone, or -1");
    require(length(sub(bone.tail, bone.head)) > 0, name + " has no length: put its tail away from its head");
    require(bone.radius > 0 && bone.mass > 0, name + ": radius and mass must be above 0");
    for (std::size_t k = 0; k < 3; ++k) {
      require(bone.lower[k] <= bone.upper[k], name + ": a lower limit is above the upper one");
      require(!bone.in_cone || k == 1 || (bone.lower[k] == -bone.upper[k] && bone.upper[k] > 0),
              name + ": a cone is as wide on either side: give limits about x and z with lower == -upper, above 0");
    }
  }
}

/// Which axis of its joint turns a bone about its own x, y or z. A twist is about the joint's x, which lies along y.
constexpr std::size_t axis_about(std::size_t k, bool in_cone) { return 3 + (in_cone ? (k + 2) % 3 : k); }

/// From a bone's frame to one with its x along the bone: x, y, z become y, z, x.
constexpr PlumbQuat kAlong{0.5, 0.5, 0.5, 0.5};

PlumbJointDesc joint_of(const Bone& bone, const PlumbPose& parent, PlumbBody body_a, PlumbBody body_b) {
  PlumbJointDesc desc = joint_desc(bone.in_cone ? PLUMB_JOINT_SWING_TWIST : PLUMB_JOINT_GENERIC);
  const PlumbPose rest = rest_pose(bone);
  const PlumbQuat turn = bone.in_cone ? multiply(rest.orientation, kAlong) : rest.orientation;
  const PlumbPose at_head{bone.head, turn};
  desc.body_a = body_a;
  desc.body_b = body_b;
  desc.frame_a = compose(inverse(parent), at_head);
  desc.frame_b = compose(inverse(rest), at_head);
  for (std::size_t k = 0; k < 3; ++k) {
    desc.axis_modes[k] = PLUMB_AXIS_LOCKED;
    const std::size_t axis = axis_about(k, bone.in_cone);
    const bool locked = !bone.in_cone && bone.lower[k] == bone.upper[k];
    desc.axis_modes[axis] = locked ? PLUMB_AXIS_LOCKED : PLUMB_AXIS_LIMITED;
    if (locked) continue;
    desc.limits[axis] = {bone.lower[k], bone.upper[k], 1, 0};
    desc.motors[axis] = {0, 0, 1, 0};
  }
  return desc;
}

}  // namespace

Ragdoll::Ragdoll(IPhysicsWorld& world, std::span<const Bone> skeleton, const PlumbPose& origin,
                 const RagdollSettings& settings)
    : world_(world),
      extension_(require_extension(world.joints(), "ragdoll", PLUMB_EXT_JOINTS, "PLUMB_NEED_JOINTS")),
      settings_(settings) {
  check_skeleton(skeleton);
  require(settings.gain >= 0 && settings.max_speed >= 0 && settings.max_torque >= 0 && settings.friction_torque >= 0,
          "ragdoll: gain, max_speed and torques must be 0 or more");
  try {
    create(skeleton, origin);
    go_limp();
  } catch (...) {
    destroy();
    throw;
  }
}

Ragdoll::~Ragdoll() { destroy(); }

void Ragdoll::create(std::span<const Bone> skeleton, const PlumbPose& origin) {
  for (const Bone& bone : skeleton) {
    PlumbShapeDesc capsule = shape_desc(PLUMB_CAPSULE);
    capsule.radius = bone.radius;
    capsule.half_height = std::max(0.0, length(sub(bone.tail, bone.head)) / 2 - bone.radius);
    PlumbShape shape = 0;
    check(world_, world_.create_shapes({&capsule, 1}, {&shape, 1}));
    shapes_.push_back(shape);
    PlumbBodyDesc desc = body_desc();
    desc.shape = shape;
    desc.pose = compose(origin, rest_pose(bone));
    desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
    desc.mass = bone.mass;
    desc.filter.group = settings_.group;
    PlumbBody body = 0;
    check(world_, world_.create_bodies({&desc, 1}, {&body, 1}));
    bodies_.push_back(body);
  }
  for (std::size_t i = 0; i < skeleton.size(); ++i) {
    if (skeleton[i].parent < 0) continue;
    const auto parent = static_cast<std::size_t>(skeleton[i].parent);
    const PlumbJointDesc desc = joint_of(skeleton[i], rest_pose(skeleton[parent]), bodies_[parent], bodies_[i]);
    PlumbJoint joint = 0;
    check(world_, extension_.create_joints({&desc, 1}, {&joint, 1}));
    joints_.push_back(joint);
    joint_bones_.push_back(i);
    in_cone_.push_back(skeleton[i].in_cone ? 1 : 0);
  }
}

void Ragdoll::destroy() {
  extension_.destroy_joints(joints_);
  world_.destroy_bodies(bodies_);
  world_.destroy_shapes(shapes_);
}

void Ragdoll::read_poses(std::span<PlumbPose> poses) const {
  require(poses.size() == bodies_.size(), "ragdoll: " + std::to_string(poses.size()) + " poses for " +
                                              std::to_string(bodies_.size()) + " bones: give one for each");
  read_rows(world_, PLUMB_FIELD_POSE, bodies_, poses);
}

void Ragdoll::read_angles(std::span<BoneAngles> angles) const {
  require(angles.size() == bodies_.size(), "ragdoll: " + std::to_string(angles.size()) + " angles for " +
                                               std::to_string(bodies_.size()) + " bones: give one for each");
  std::vector<std::array<double, 6>> rows(joints_.size());
  std::fill(angles.begin(), angles.end(), BoneAngles{});
  if (rows.empty()) return;
  check(world_, extension_.read_joints(PLUMB_JOINT_COORDINATES, joints_, rows_over(std::span(rows))));
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) angles[joint_bones_[i]][k] = rows[i][axis_about(k, in_cone_[i] != 0)];
}

void Ragdoll::drive(std::span<const BoneAngles> pose) {
  std::vector<BoneAngles> speeds(bodies_.size());
  read_angles(speeds);
  require(pose.size() == speeds.size(), "ragdoll: a pose of " + std::to_string(pose.size()) + " bones for " +
                                            std::to_string(speeds.size()) + ": give one for each");
  for (std::size_t i = 0; i < speeds.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      speeds[i][k] =
          std::clamp(settings_.gain * (pose[i][k] - speeds[i][k]), -settings_.max_speed, settings_.max_speed);
  write_motors(speeds, settings_.max_torque);
}

void Ragdoll::go_limp() {
  const std::vector<BoneAngles> rest(bodies_.size());
  write_motors(rest, settings_.friction_torque);
}

void Ragdoll::write_motors(std::span<const BoneAngles> speeds, double torque) {
  if (joints_.empty()) return;
  std::vector<std::array<double, 12>> rows(joints_.size());
  for (std::size_t i = 0; i < rows.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t axis = axis_about(k, in_cone_[i] != 0);
      rows[i][2 * axis] = speeds[joint_bones_[i]][k];
      rows[i][2 * axis + 1] = torque;
    }
  check(world_, extension_.write_joints(PLUMB_JOINT_MOTOR, joints_,
                                        const_rows_over(std::span<const std::array<double, 12>>(rows))));
}

}  // namespace plumb::helpers
