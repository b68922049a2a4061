// Overlap of contacts as a speed to be reached, for solvers that take a step whole.
#pragma once

#include "constraints/contact_rows.hpp"
#include "step_parameters.hpp"

namespace plumb::impulse {

/// Writes the speed that a point may approach with (kOpen): one that is apart may close its gap within the step; of an
/// overlap beyond the slop a share is taken back (J. Baumgarte, "Stabilization of constraints and integrals of motion
/// in dynamical systems", 1972).
template <class N>
PLUMB_HD void put_bias(const RowAccess<N>& row, int points, const StepParameters& step) {
  const N zero = N(0);
  for (int p = 0; p < points; ++p) {
    const N separation = row.get(point_field(p, kSeparation));
    const N back = max(N(step.bias_rate) * min(separation + N(step.slop), zero), N(-step.push_speed));
    row.put(point_field(p, kOpen), select(separation > zero, separation * N(step.inverse_h), back));
  }
}

}  // namespace plumb::impulse
