// Warm starting: each manifold has the impulses with which the points of the same features ended in the last step, and
// its colour if the same bodies are pushed.
#pragma once

#include "bodies/mechanism.hpp"
#include "bodies/step_counters.hpp"
#include "bodies/step_parameters.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// What matching works with.
struct MatchWork {
  ContactCache cache, last;  ///< of this step, and of the last one
  const KeptPair* woken;     ///< manifolds of those who slept in the last step, StepParameters::woken_contacts many and
                             ///< ascending; null where nobody does
  Bodies bodies;
  Proxies proxies;
  const StepParameters* parameters;
  StepCounters* counters;
  Mechanisms mechanisms;
  std::uint64_t* masks;  ///< Colouring::masks(): gets the colours that are kept
};

/// Fills cache.kept of the manifolds of this step, of which there are no more than `capacity`.
void match(Executor& executor, const MatchWork& work, std::uint32_t capacity);

}  // namespace plumb::impulse
