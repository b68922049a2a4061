// Worlds, models, links, collisions and joints, made of SDF: whole, or piece by piece as gz-sim does.
#pragma once

#include <ignition/physics/sdf/ConstructCollision.hh>
#include <ignition/physics/sdf/ConstructJoint.hh>
#include <ignition/physics/sdf/ConstructLink.hh>
#include <ignition/physics/sdf/ConstructModel.hh>
#include <ignition/physics/sdf/ConstructNestedModel.hh>
#include <ignition/physics/sdf/ConstructWorld.hh>

#include "hosts/gazebo/features/base.hpp"

namespace plumb::gazebo {

struct SdfFeatureList : physics::FeatureList<physics::sdf::ConstructSdfWorld, physics::sdf::ConstructSdfModel,
                                             physics::sdf::ConstructSdfNestedModel, physics::sdf::ConstructSdfLink,
                                             physics::sdf::ConstructSdfCollision, physics::sdf::ConstructSdfJoint> {};

class SdfFeatures : public virtual Base, public virtual physics::Implements3d<SdfFeatureList> {
 public:
  Identity ConstructSdfWorld(const Identity& engine, const sdf::World& world) override;
  Identity ConstructSdfModel(const Identity& world, const sdf::Model& model) override;
  /// parent: a model, or a world.
  Identity ConstructSdfNestedModel(const Identity& parent, const sdf::Model& model) override;
  Identity ConstructSdfLink(const Identity& model, const sdf::Link& link) override;
  Identity ConstructSdfCollision(const Identity& link, const sdf::Collision& collision) override;
  Identity ConstructSdfJoint(const Identity& model, const sdf::Joint& joint) override;

 private:
  Model& make(World& world, Model* parent, const sdf::Model& model);
  Link* make(Model& model, const sdf::Link& link);
  Shape* make(Link& link, const sdf::Collision& collision);
  Joint* make(Model& model, const sdf::Joint& joint);
};

}  // namespace plumb::gazebo
