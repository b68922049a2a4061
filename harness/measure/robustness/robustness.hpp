// Measures of the robustness group: their list, and those that live in files of their own.
#pragma once

#include <span>

#include "measure/measure.hpp"

namespace plumb::harness {

/// The list of the group.
[[nodiscard]] std::span<const MeasureEntry> robustness_measures();

// robustness_metamorphic.cpp: transformed copies of a scene against the scene itself
void measure_similarity(MeasureContext& context);
void measure_mass_scaling(MeasureContext& context);
void measure_translation(MeasureContext& context);
void measure_rotation(MeasureContext& context);
void measure_galilean(MeasureContext& context);
void measure_repeat(MeasureContext& context);

// robustness_edges.cpp
void measure_inner_edges(MeasureContext& context);

// robustness_continuous.cpp: what is too fast or too thin for one look a step
void measure_spinning_rod(MeasureContext& context);
void measure_bullet_stack(MeasureContext& context);

// robustness_driven.cpp: what the host does to a scene while it runs
void measure_press(MeasureContext& context);
void measure_time_reversal(MeasureContext& context);

// robustness_outcomes.cpp: a scene against itself, run otherwise
void measure_mirror(MeasureContext& context);
void measure_self_convergence(MeasureContext& context);
void measure_predictability(MeasureContext& context);

// bystanders.cpp
void measure_bystanders(MeasureContext& context);

// robustness_bad_input.cpp
void measure_bad_input(MeasureContext& context);

}  // namespace plumb::harness
