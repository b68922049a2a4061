// The lists of measures, one a group of scenes, that registry.cpp joins.
#pragma once

#include <span>

#include "measure/measure.hpp"

namespace plumb::harness {

[[nodiscard]] std::span<const MeasureEntry> integrator_measures();
[[nodiscard]] std::span<const MeasureEntry> collision_measures();
[[nodiscard]] std::span<const MeasureEntry> friction_measures();
[[nodiscard]] std::span<const MeasureEntry> stacking_measures();
[[nodiscard]] std::span<const MeasureEntry> joint_measures();
[[nodiscard]] std::span<const MeasureEntry> robustness_measures();
[[nodiscard]] std::span<const MeasureEntry> scale_measures();
[[nodiscard]] std::span<const MeasureEntry> geometry_measures();
[[nodiscard]] std::span<const MeasureEntry> quantity_measures();

}  // namespace plumb::harness
