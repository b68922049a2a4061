// Errors as they count where engines are held against each other.
#pragma once

#include <algorithm>

#include "rows/row.hpp"

namespace plumb::harness {

/// Of a metric's limit: errors below are equally good, for nobody asks for more, and rounding is no merit.
inline constexpr double good_enough = 1e-3;

/// At least a thousandth of the metric's threshold, of its gold where it has no threshold.
[[nodiscard]] inline double counted_error(double error, const MetricResult& metric) {
  return std::max(error, good_enough * metric.threshold.value_or(metric.gold.value_or(0)));
}

}  // namespace plumb::harness
