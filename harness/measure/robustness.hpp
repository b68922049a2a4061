// Measures of the robustness group that live in files of their own.
#pragma once

#include "measure/measure.hpp"

namespace plumb::harness {

// robustness_metamorphic.cpp: transformed copies of a scene against the scene itself
void measure_similarity(MeasureContext& context);
void measure_mass_scaling(MeasureContext& context);
void measure_translation(MeasureContext& context);
void measure_rotation(MeasureContext& context);
void measure_repeat(MeasureContext& context);

// robustness_edges.cpp
void measure_inner_edges(MeasureContext& context);

// robustness_bad_input.cpp
void measure_bad_input(MeasureContext& context);

}  // namespace plumb::harness
