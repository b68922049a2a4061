// The middle of some numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "plumb/assert.hpp"

namespace plumb::harness {

/// None of them may be NaN; of an even number of them the upper one, and of none NaN.
[[nodiscard]] inline double median(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  PLUMB_ASSERT(std::none_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }));
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace plumb::harness
