// Measures of the geometry group: their list.
#pragma once

#include <span>

#include "measure/measure.hpp"

namespace plumb::harness {

[[nodiscard]] std::span<const MeasureEntry> geometry_measures();

}  // namespace plumb::harness
