// A ragdoll: capsules along the bones of a skeleton, joints with limits between them, and motors that drive it to a
// pose.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::helpers {

/// A bone in the skeleton's rest pose, world axes. Its body's frame is at the middle, y from head to tail.
struct Bone {
  std::string name;
  int parent = -1;   ///< index of an earlier bone; -1: a root
  PlumbVec3 head{};  ///< m: where it is joined to its parent
  PlumbVec3 tail{};  ///< m
  double radius = 0.05;
  double mass = 5;  ///< kg
  /// rad, about the axes of the bone's frame at rest, x y z, of the bone seen from its parent; lower == upper locks
  /// one.
  std::array<double, 3> lower{-0.5, -0.5, -0.5}, upper{0.5, 0.5, 0.5};
  /// Of shoulders and hips: a swing-twist joint. Limits about x and z are then half angles of an elliptic cone, lower
  /// == -upper, and y is the twist; so are its angles (joints.h: x, y, z here are axes 5, 3, 4 there).
  bool in_cone = false;
};

struct RagdollSettings {
  double gain = 10;              ///< 1/s: a motor asks for gain times what is missing of the angle
  double max_speed = 10;         ///< rad/s that a motor asks for
  double max_torque = 200;       ///< N m about each axis, when driven
  double friction_torque = 0.5;  ///< N m about each axis, when limp: a motor that asks for rest
  std::int32_t group = -1;       ///< of the filter of all bones: negative, they do not touch each other
};

/// Angles of a bone seen from its parent about its three axes, rad.
using BoneAngles = std::array<double, 3>;

class Ragdoll {
 public:
  static constexpr PlumbNeeds needs =
      PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS | PLUMB_NEED_FILTERS | PLUMB_NEED_COLLISION;

  /// Makes the bodies and joints in the world, which outlives this; they are gone with it. origin: where the skeleton's
  /// coordinates lie. Throws Error on a skeleton that is none, or where the world lacks joints with three limited axes,
  /// or of bones in cones motors for their swing.
  Ragdoll(IPhysicsWorld& world, std::span<const Bone> skeleton, const PlumbPose& origin,
          const RagdollSettings& settings = {});
  Ragdoll(const Ragdoll&) = delete;
  Ragdoll& operator=(const Ragdoll&) = delete;
  ~Ragdoll();

  /// Before each step: motors towards the pose, an entry a bone (a root's is not read). By velocity motors with a bound
  /// torque, which every backend has: a PD controller whose damping is the motor itself.
  void drive(std::span<const BoneAngles> pose);
  /// Lets it fall: motors only brake, as joints' friction.
  void go_limp();

  [[nodiscard]] std::span<const PlumbBody> bodies() const { return bodies_; }
  [[nodiscard]] std::span<const PlumbJoint> joints() const { return joints_; }
  /// Of the bones' frames, world.
  void read_poses(std::span<PlumbPose> poses) const;
  void read_angles(std::span<BoneAngles> angles) const;

 private:
  void create(std::span<const Bone> skeleton, const PlumbPose& origin);
  void destroy();
  void write_motors(std::span<const BoneAngles> speeds, double torque);

  IPhysicsWorld& world_;
  IJoints& extension_;
  RagdollSettings settings_;
  std::vector<PlumbShape> shapes_;
  std::vector<PlumbBody> bodies_;
  std::vector<PlumbJoint> joints_;
  std::vector<std::size_t> joint_bones_;  // the bone that each joint holds to its parent
  std::vector<char> in_cone_;             // of each joint: Bone::in_cone
};

}  // namespace plumb::helpers
