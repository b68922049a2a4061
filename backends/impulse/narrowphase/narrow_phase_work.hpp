// What the stages of the narrow phase share in a step: recycling, and the pair functions over what is not recycled.
#pragma once

#include "bodies/body.hpp"
#include "bodies/step_parameters.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// What the narrow phase reads of the world, and where it writes.
struct NarrowPhaseWork {
  ContactCache cache, last;  ///< of this step, and of the last one
  Bodies bodies;
  Proxies proxies;
  const Real* margins;  ///< by proxy: how far ahead it looks, m
  const StepParameters* parameters;

  [[nodiscard]] PLUMB_HD Real margin(Pair pair) const { return margins[pair.a] + margins[pair.b]; }
};

}  // namespace plumb::impulse
