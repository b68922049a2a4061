// Measures of the integrator group: their list, and those that live in files of their own.
#pragma once

#include <span>

#include "measure/measure.hpp"

namespace plumb::harness {

/// The list of the group.
[[nodiscard]] std::span<const MeasureEntry> integrator_measures();

// rotation.cpp
void measure_free_rotation(MeasureContext& context);
void measure_symmetric_rotation(MeasureContext& context);
void measure_heavy_top(MeasureContext& context);

// pendulums.cpp
void measure_pendulum(MeasureContext& context);
void measure_spherical_pendulum(MeasureContext& context);
void measure_double_pendulum(MeasureContext& context);

}  // namespace plumb::harness
