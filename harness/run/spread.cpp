#include "run/spread.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::harness {

namespace {

// The probability that |t| stays below a bound, in closed form for whole degrees of freedom (Abramowitz and Stegun
// 1964, 26.7.3 and 26.7.4).
double two_sided(double t, std::size_t degrees) {
  const double angle = std::atan2(t, std::sqrt(static_cast<double>(degrees)));
  const double c = std::cos(angle), s = std::sin(angle);
  double term = degrees % 2 == 1 ? c : 1, sum = degrees == 1 ? 0 : term;
  for (std::size_t k = degrees % 2 == 1 ? 3 : 2; k + 1 < degrees; k += 2) {
    term *= c * c * static_cast<double>(k - 1) / static_cast<double>(k);
    sum += term;
  }
  return degrees % 2 == 1 ? 2 / std::numbers::pi * (angle + s * sum) : s * sum;
}

}  // namespace

double student_quantile(std::size_t degrees) {
  double low = 0, high = 20;
  for (int i = 0; i < 80; ++i) {
    const double middle = (low + high) / 2;
    (two_sided(middle, degrees) < 0.95 ? low : high) = middle;
  }
  return high;
}

std::optional<MedianInterval> median_interval(const std::vector<double>& values) {
  const std::size_t n = values.size();
  if (n < 2 || std::any_of(values.begin(), values.end(), [](double v) { return !(v > 0); })) return std::nullopt;
  double mean = 0, square = 0;
  for (const double value : values) mean += std::log(value) / static_cast<double>(n);
  for (const double value : values) square += std::pow(std::log(value) - mean, 2);
  const double error = std::sqrt(square / static_cast<double>(n - 1) / static_cast<double>(n));
  const double half = student_quantile(n - 1) * error;
  return MedianInterval{std::exp(mean - half), std::exp(mean + half)};
}

std::optional<double> relative_spread(const std::vector<double>& values) {
  const auto interval = median_interval(values);
  if (!interval) return std::nullopt;
  return (interval->high - interval->low) / 2 / std::sqrt(interval->high * interval->low);
}

}  // namespace plumb::harness
