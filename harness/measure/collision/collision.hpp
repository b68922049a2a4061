// Measures of the collision group: their list, and those that live in files of their own.
#pragma once

#include <span>

#include "measure/measure.hpp"

namespace plumb::harness {

/// The list of the group.
[[nodiscard]] std::span<const MeasureEntry> collision_measures();

// collision_impacts.cpp: single impacts without gravity
void measure_head_on(MeasureContext& context);
void measure_oblique_impact(MeasureContext& context);
void measure_tilted_cube(MeasureContext& context);
void measure_sphere_on_box(MeasureContext& context);

// collision_spheres.cpp: impacts among several spheres
void measure_cradle(MeasureContext& context);
void measure_glancing_pair(MeasureContext& context);

// collision_answers.cpp: the narrow phase alone
void measure_static_answers(MeasureContext& context);

}  // namespace plumb::harness
