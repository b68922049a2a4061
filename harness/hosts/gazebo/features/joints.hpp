// Joints: what they are, how they move, and what drives them.
#pragma once

#include <ignition/physics/FixedJoint.hh>
#include <ignition/physics/Joint.hh>
#include <ignition/physics/PrismaticJoint.hh>
#include <ignition/physics/RevoluteJoint.hh>

#include "hosts/gazebo/features/base.hpp"

namespace plumb::gazebo {

struct JointFeatureList
    : physics::FeatureList<physics::GetBasicJointState, physics::SetBasicJointState, physics::GetBasicJointProperties,
                           physics::SetJointTransformFromParentFeature, physics::SetJointTransformToChildFeature,
                           physics::SetJointVelocityCommandFeature, physics::SetJointPositionLimitsFeature,
                           physics::SetJointEffortLimitsFeature, physics::DetachJointFeature,
                           physics::GetJointTransmittedWrench> {};

struct JointKindFeatureList
    : physics::FeatureList<physics::AttachFixedJointFeature, physics::GetRevoluteJointProperties,
                           physics::AttachRevoluteJointFeature, physics::GetPrismaticJointProperties,
                           physics::AttachPrismaticJointFeature> {};

class JointFeatures : public virtual Base,
                      public virtual physics::Implements3d<JointFeatureList>,
                      public virtual physics::Implements3d<JointKindFeatureList> {
 public:
  double GetJointPosition(const Identity& joint, std::size_t axis) const override;
  double GetJointVelocity(const Identity& joint, std::size_t axis) const override;
  double GetJointAcceleration(const Identity& joint, std::size_t axis) const override;
  double GetJointForce(const Identity& joint, std::size_t axis) const override;
  physics::Pose3d GetJointTransform(const Identity& joint) const override;

  void SetJointPosition(const Identity& joint, std::size_t axis, double value) override;
  void SetJointVelocity(const Identity& joint, std::size_t axis, double value) override;
  void SetJointAcceleration(const Identity& joint, std::size_t axis, double value) override;
  void SetJointForce(const Identity& joint, std::size_t axis, double value) override;
  void SetJointVelocityCommand(const Identity& joint, std::size_t axis, double value) override;
  void SetJointMinPosition(const Identity& joint, std::size_t axis, double value) override;
  void SetJointMaxPosition(const Identity& joint, std::size_t axis, double value) override;
  void SetJointMinEffort(const Identity& joint, std::size_t axis, double value) override;
  void SetJointMaxEffort(const Identity& joint, std::size_t axis, double value) override;

  std::size_t GetJointDegreesOfFreedom(const Identity& joint) const override;
  physics::Pose3d GetJointTransformFromParent(const Identity& joint) const override;
  physics::Pose3d GetJointTransformToChild(const Identity& joint) const override;
  void SetJointTransformFromParent(const Identity& joint, const physics::Pose3d& pose) override;
  void SetJointTransformToChild(const Identity& joint, const physics::Pose3d& pose) override;

  void DetachJoint(const Identity& joint) override;
  physics::Wrench3d GetJointTransmittedWrenchInJointFrame(const Identity& joint) const override;

  Identity CastToFixedJoint(const Identity& joint) const override;
  Identity AttachFixedJoint(const Identity& child, const physics::BaseLink3dPtr& parent,
                            const std::string& name) override;
  Identity CastToRevoluteJoint(const Identity& joint) const override;
  physics::AngularVector3d GetRevoluteJointAxis(const Identity& joint) const override;
  Identity AttachRevoluteJoint(const Identity& child, const physics::BaseLink3dPtr& parent, const std::string& name,
                               const physics::AngularVector3d& axis) override;
  Identity CastToPrismaticJoint(const Identity& joint) const override;
  physics::LinearVector3d GetPrismaticJointAxis(const Identity& joint) const override;
  Identity AttachPrismaticJoint(const Identity& child, const physics::BaseLink3dPtr& parent, const std::string& name,
                                const physics::LinearVector3d& axis) override;

 private:
  /// Null, with a sentence on the console, for a joint that is gone, an axis that it lacks, or a value that is NaN.
  JointAxis* axis_for(const char* what, std::size_t joint, std::size_t axis, double value) const;
  [[nodiscard]] const JointAxis* axis_of_joint(std::size_t joint, std::size_t axis) const;
  [[nodiscard]] Identity cast(std::size_t joint, JointKind kind) const;
  Identity attach(std::size_t child, const physics::BaseLink3dPtr& parent, const std::string& name, JointKind kind,
                  const Vector& axis);
  void place(std::size_t joint, const Placement* in_parent, const Placement* in_child);
};

}  // namespace plumb::gazebo
