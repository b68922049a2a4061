// Overlap of contacts as a speed to be reached, for solvers that take a step whole.
#pragma once

#include "bodies/step_parameters.hpp"
#include "contacts/contact.hpp"

namespace plumb::impulse {

/// The speed that a point may approach with (`allowed_approach`): one that is apart may close its gap within the step;
/// of an overlap beyond the slop a share is taken back (J. Baumgarte, "Stabilization of constraints and integrals of
/// motion in dynamical systems", 1972).
template <int P, class N>
PLUMB_HD void put_bias(Contact<P, N>& contact, const PerPoint<P, N>& separation, const StepParameters& step) {
  const N zero = N(0);
  const PerPoint<P, N> back =
      max(min(separation + N(step.slop), zero) * N(step.bias_rate), N(-step.max_depenetration_speed));
  contact.allowed_approach = select(separation > zero, separation * N(step.inverse_h), back);
}

}  // namespace plumb::impulse
