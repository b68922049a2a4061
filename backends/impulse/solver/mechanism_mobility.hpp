// Finds the mobility of mechanisms that touch something (bodies/mechanism.hpp), at the start of a step: their
// joints' matrix is factored where the bodies are, and solved for a unit wrench along and about each axis of each body
// that has a contact.
#pragma once

#include "bodies/step_counters.hpp"
#include "exec/executor.hpp"
#include "joints/joint_loops.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// What it is found from.
struct MobilityWork {
  JointSet joints;
  Mechanisms mechanisms;
  Real* scratch;
  ContactCache cache;
  const Proxy* proxies;
  const StepParameters* parameters;
  const SubstepLevels* levels;
  const StepCounters* counters;
};

/// contacts: how many manifolds there are. Joints and mechanisms are those of a world that has some.
void enqueue_mobility(Executor& executor, JointCode joints, const MobilityWork& work, Count contacts);

}  // namespace plumb::impulse
