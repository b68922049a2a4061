// Measures of the scale group that live in files of their own.
#pragma once

#include "measure/measure.hpp"

namespace plumb::harness {

// scale_crowds.cpp
void measure_crowd(MeasureContext& context);

// scale_broad_phase.cpp
void measure_broad_phase(MeasureContext& context);

}  // namespace plumb::harness
