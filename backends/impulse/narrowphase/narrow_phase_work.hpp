// What the stages of the narrow phase share in a step: recycling, the pair functions over what is not recycled, and the
// search for times of impact.
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
  bool continuous;  ///< whether some bodies must not pass through others

  [[nodiscard]] PLUMB_HD Real margin(Pair pair) const { return margins[pair.a] + margins[pair.b]; }
  /// Whether one of the bodies must not pass through others.
  [[nodiscard]] PLUMB_HD bool is_continuous(Pair pair) const {
    const auto flags = [this](std::uint32_t proxy) { return bodies.mass[proxies.rows[proxy].body].flags; };
    return continuous && ((flags(pair.a) | flags(pair.b)) & kBodyContinuous) != 0;
  }
};

}  // namespace plumb::impulse
