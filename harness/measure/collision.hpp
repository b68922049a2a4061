// Measures of the collision group that live in files of their own.
#pragma once

#include "measure/measure.hpp"

namespace plumb::harness {

// collision_impacts.cpp: single impacts without gravity
void measure_head_on(MeasureContext& context);
void measure_oblique_impact(MeasureContext& context);
void measure_tilted_cube(MeasureContext& context);
void measure_sphere_on_box(MeasureContext& context);

}  // namespace plumb::harness
