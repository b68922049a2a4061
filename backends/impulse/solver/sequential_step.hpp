// The solver "si": sequential impulses over the whole step.
#pragma once

#include "solver/pass_step.hpp"

namespace plumb::impulse {

/// Sequential impulses (Catto, "Iterative Dynamics with Temporal Coherence", 2005): one constraint after the other,
/// each seeing what those before it did (projected Gauss-Seidel on accumulated impulses).
template <JointCode kJoints, bool kBelts>
struct StepSequentially : StepInPasses<StepSequentially<kJoints, kBelts>, kJoints> {
  template <class Work>
  PLUMB_DEVICE void for_each_contact(Team& team, const Work& work) const {
    for_contacts<kBelts>(team, this->contacts, this->solver, BodyUse::kVelocity, work);
  }
  PLUMB_DEVICE void bounce_contacts(Team& team, const StepParameters& step) const {
    this->template bounce<kBelts>(team, step.restitution_speed);
  }
};

}  // namespace plumb::impulse
