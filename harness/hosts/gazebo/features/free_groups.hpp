// Links that nothing holds to the world, set and moved as one.
#pragma once

#include <ignition/physics/FreeGroup.hh>

#include "hosts/gazebo/features/base.hpp"

namespace plumb::gazebo {

struct FreeGroupFeatureList : physics::FeatureList<physics::FindFreeGroupFeature, physics::FreeGroupFrameSemantics,
                                                   physics::SetFreeGroupWorldPose, physics::SetFreeGroupWorldVelocity> {
};

class FreeGroupFeatures : public virtual Base, public virtual physics::Implements3d<FreeGroupFeatureList> {
 public:
  Identity FindFreeGroupForModel(const Identity& model) const override;
  Identity FindFreeGroupForLink(const Identity& link) const override;
  Identity GetFreeGroupRootLink(const Identity& group) const override;
  void SetFreeGroupWorldPose(const Identity& group, const PoseType& pose) override;
  void SetFreeGroupWorldLinearVelocity(const Identity& group, const LinearVelocity& velocity) override;
  void SetFreeGroupWorldAngularVelocity(const Identity& group, const AngularVelocity& velocity) override;

 private:
  [[nodiscard]] Link* root(std::size_t group) const;
  [[nodiscard]] std::vector<Link*> links(std::size_t group) const;
};

}  // namespace plumb::gazebo
