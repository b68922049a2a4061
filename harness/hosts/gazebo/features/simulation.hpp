// A step, and what is told of it: poses that changed, contacts, frames of everything.
#pragma once

#include <ignition/physics/ForwardStep.hh>
#include <ignition/physics/FrameSemantics.hh>
#include <ignition/physics/GetContacts.hh>
#include <ignition/physics/Link.hh>
#include <ignition/physics/World.hh>

#include "hosts/gazebo/features/base.hpp"

namespace plumb::gazebo {

struct SimulationFeatureList
    : physics::FeatureList<physics::ForwardStep, physics::GetContactsFromLastStepFeature, physics::LinkFrameSemantics,
                           physics::JointFrameSemantics, physics::ShapeFrameSemantics, physics::ModelFrameSemantics,
                           physics::AddLinkExternalForceTorque, physics::Gravity, physics::Solver> {};

class SimulationFeatures : public virtual Base, public virtual physics::Implements3d<SimulationFeatureList> {
 public:
  void WorldForwardStep(const Identity& world, physics::ForwardStep::Output& output, physics::ForwardStep::State& state,
                        const physics::ForwardStep::Input& input) override;
  std::vector<ContactInternal> GetContactsFromLastStep(const Identity& world) const override;

  FrameData FrameDataRelativeToWorld(const physics::FrameID& id) const override;

  void AddLinkExternalForceInWorld(const Identity& link, const physics::LinearVector3d& force,
                                   const physics::LinearVector3d& position) override;
  void AddLinkExternalTorqueInWorld(const Identity& link, const physics::AngularVector3d& torque) override;

  void SetWorldGravity(const Identity& world, const physics::LinearVector3d& gravity) override;
  physics::LinearVector3d GetWorldGravity(const Identity& world) const override;

  /// The solver is the backend below: "impulse", "bullet" ...
  void SetWorldSolver(const Identity& world, const std::string& solver) override;
  const std::string& GetWorldSolver(const Identity& world) const override;
};

}  // namespace plumb::gazebo
