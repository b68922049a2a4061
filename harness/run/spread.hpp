// How sure a median of a few repetitions is.
#pragma once

#include <optional>
#include <vector>

namespace plumb::harness {

struct MedianInterval {
  double low, high;
};

/// The 95 % confidence interval of the median of positive values, taken as log-normal as times are: Student's interval
/// of the mean of the logarithms, whose exponential is that distribution's median. None for fewer than two values or
/// values that are not above zero.
[[nodiscard]] std::optional<MedianInterval> median_interval(const std::vector<double>& values);

/// Half of the interval's width over its geometric middle; none where there is no interval.
[[nodiscard]] std::optional<double> relative_spread(const std::vector<double>& values);

/// The 97.5 % quantile of Student's t distribution: 12.706 for one degree of freedom, 1.96 for many.
[[nodiscard]] double student_quantile(std::size_t degrees);

}  // namespace plumb::harness
