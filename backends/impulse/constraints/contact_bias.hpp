// Overlap of contacts as a speed to be reached, for solvers that take a step whole.
#pragma once

#include "constraints/contact.hpp"
#include "step_parameters.hpp"

namespace plumb::impulse {

/// The speed that a point may approach with (`open`): one that is apart may close its gap within the step; of an
/// overlap beyond the slop a share is taken back (J. Baumgarte, "Stabilization of constraints and integrals of motion
/// in dynamical systems", 1972).
template <int P, class N>
PLUMB_HD void put_bias(Contact<N>& contact, const StepParameters& step) {
  const N zero = N(0);
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    const N separation = contact.points[p].separation;
    const N back = max(N(step.bias_rate) * min(separation + N(step.slop), zero), N(-step.push_speed));
    contact.points[p].open = select(separation > zero, separation * N(step.inverse_h), back);
  }
}

}  // namespace plumb::impulse
