// Measures of the scale group: their list, and those that live in files of their own.
#pragma once

#include <span>

#include "measure/measure.hpp"

namespace plumb::harness {

/// The list of the group.
[[nodiscard]] std::span<const MeasureEntry> scale_measures();

// scale_crowds.cpp
void measure_crowd(MeasureContext& context);

// scale_broad_phase.cpp
void measure_broad_phase(MeasureContext& context);

}  // namespace plumb::harness
