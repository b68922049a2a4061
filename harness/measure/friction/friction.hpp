// Measures of the friction group: their list, and those that live in files of their own.
#pragma once

#include <span>

#include "measure/measure.hpp"

namespace plumb::harness {

/// The list of the group.
[[nodiscard]] std::span<const MeasureEntry> friction_measures();

// friction_rolling.cpp: friction that turns bodies
void measure_slide_to_roll(MeasureContext& context);
void measure_roll_down(MeasureContext& context);
void measure_spin_stop(MeasureContext& context);

// friction_pushed.cpp: friction against forces of the host
void measure_pushed_box(MeasureContext& context);
void measure_force_ramp(MeasureContext& context);

// friction_belt.cpp
void measure_conveyor(MeasureContext& context);

// friction_rods.cpp
void measure_painleve(MeasureContext& context);
void measure_ladder(MeasureContext& context);

}  // namespace plumb::harness
