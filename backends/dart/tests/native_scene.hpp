// A scene of joints as skeletons, and a program that steps them with DART's own world.
#pragma once

#include <array>
#include <dart/dynamics/BallJoint.hpp>
#include <dart/dynamics/FreeJoint.hpp>
#include <dart/dynamics/RevoluteJoint.hpp>
#include <dart/simulation/World.hpp>

#include "scenes.hpp"

namespace scenes {

class NativeScene {
 public:
  /// Each body hangs on the one before it, or is free.
  explicit NativeScene(const Scene& scene) : world_(dart::simulation::World::create()) {
    world_->setGravity({0, -9.81, 0});
    world_->setTimeStep(1.0 / 60 / kSubsteps);
    dart::dynamics::SkeletonPtr skeleton = dart::dynamics::Skeleton::create();
    for (std::size_t i = 0; i < scene.items.size(); ++i) {
      const Joint* joint = joint_of(scene, i);
      if (joint == nullptr || joint->a < 0) {
        if (i > 0) world_->addSkeleton(skeleton);
        skeleton = dart::dynamics::Skeleton::create("s" + std::to_string(i));
      }
      add(skeleton, scene.items[i], joint);
    }
    world_->addSkeleton(skeleton);
  }

  void step() {
    for (int i = 0; i < kSubsteps; ++i) world_->step();
  }
  [[nodiscard]] Eigen::Vector3d position(std::size_t i) const { return nodes_[i]->getWorldTransform().translation(); }

 private:
  static constexpr int kSubsteps = 8;

  static const Joint* joint_of(const Scene& scene, std::size_t item) {
    for (const Joint& joint : scene.joints)
      if (joint.b == static_cast<int>(item)) return &joint;
    return nullptr;
  }
  static Eigen::Isometry3d at(const PlumbVec3& v) { return Eigen::Isometry3d(Eigen::Translation3d(v.x, v.y, v.z)); }

  void add(const dart::dynamics::SkeletonPtr& skeleton, const Item& item, const Joint* joint) {
    using namespace dart::dynamics;
    const PlumbVec3 moments = inertia(item);
    const Inertia mass(item.mass, Eigen::Vector3d::Zero(),
                       Eigen::Vector3d(moments.x, moments.y, moments.z).asDiagonal());
    const BodyNode::Properties body(BodyNode::AspectProperties("b" + std::to_string(nodes_.size()), mass));
    BodyNode* parent = joint != nullptr && joint->a >= 0 ? nodes_[static_cast<std::size_t>(joint->a)] : nullptr;
    const auto place = [&](auto properties) {
      properties.mName = "j" + std::to_string(nodes_.size());
      properties.mT_ParentBodyToJoint = at(joint->in_a);
      properties.mT_ChildBodyToJoint = at(joint->in_b);
      return properties;
    };
    if (joint == nullptr) {
      const auto made = skeleton->createJointAndBodyNodePair<FreeJoint>(parent, {}, body);
      const PlumbQuat& q = item.pose.orientation;
      Eigen::Isometry3d pose = at(item.pose.position);
      pose.linear() = Eigen::Quaterniond(q.w, q.x, q.y, q.z).toRotationMatrix();
      made.first->setTransform(pose);
      made.first->setLinearVelocity({item.velocity.x, item.velocity.y, item.velocity.z});
      made.first->setAngularVelocity({item.spin.x, item.spin.y, item.spin.z});
      nodes_.push_back(made.second);
    } else if (joint->is_hinge) {
      auto properties = place(RevoluteJoint::Properties());
      properties.mAxis = Eigen::Vector3d::UnitZ();
      nodes_.push_back(skeleton->createJointAndBodyNodePair<RevoluteJoint>(parent, properties, body).second);
    } else {
      nodes_.push_back(
          skeleton->createJointAndBodyNodePair<BallJoint>(parent, place(BallJoint::Properties()), body).second);
    }
  }

  dart::simulation::WorldPtr world_;
  std::vector<dart::dynamics::BodyNode*> nodes_;
};

}  // namespace scenes
