// The few statistics of rows: quantiles, intervals of a median, a line through points with its slope's interval.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace plumb::harness {

struct Interval {
  double low, high;
  [[nodiscard]] bool overlaps(const Interval& other) const { return low <= other.high && other.low <= high; }
};

/// Linear between order statistics (Hyndman and Fan 1996, type 7); share within [0, 1]. Absent without values.
[[nodiscard]] std::optional<double> quantile(std::vector<double> values, double share);
[[nodiscard]] std::optional<double> median(std::vector<double> values);

/// The narrowest interval between symmetric order statistics that covers the median with at least this confidence,
/// whatever the distribution (David and Nagaraja, Order Statistics, section 7.1). Absent for too few values: five or
/// less at 95 %.
[[nodiscard]] std::optional<Interval> median_interval(std::vector<double> values, double confidence = 0.95);

/// The value that a Student t variable of this many degrees of freedom stays below in magnitude with the confidence.
[[nodiscard]] double student_t(std::size_t degrees, double confidence = 0.95);

/// The 95 % confidence interval of the median of a few positive values, taken as log-normal as times are: Student's
/// interval of the mean of the logarithms, whose exponential is that distribution's median. None for fewer than two
/// values or values that are not above zero.
[[nodiscard]] std::optional<Interval> log_normal_interval(const std::vector<double>& values);
/// Half of that interval's width over its geometric middle; none where there is no interval.
[[nodiscard]] std::optional<double> relative_spread(const std::vector<double>& values);

/// y = offset + slope x by least squares.
struct LineFit {
  double slope, offset;
  std::optional<Interval> slope_interval;  ///< 95 %, by Student t; absent for two points
};
/// Absent for fewer than two different x. Both of one length.
[[nodiscard]] std::optional<LineFit> fit_line(const std::vector<double>& x, const std::vector<double>& y);

}  // namespace plumb::harness
