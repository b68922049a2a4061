#include "rows/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plumb/assert.hpp"

namespace plumb::harness {
namespace {

/// The probability that |t| stays below a bound, in closed form for whole degrees of freedom (Abramowitz and Stegun
/// 1964, 26.7.3 and 26.7.4).
double two_sided(double t, std::size_t degrees) {
  PLUMB_ASSERT(degrees > 0);
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

std::optional<double> quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nullopt;
  PLUMB_ASSERT(std::none_of(values.begin(), values.end(), [](double value) { return std::isnan(value); }));
  std::sort(values.begin(), values.end());
  const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  const double share_above = place - static_cast<double>(below);
  // Infinities have no difference, and nothing of one is no number.
  if (values[below] == values[above] || share_above == 0) return values[below];
  return values[below] + share_above * (values[above] - values[below]);
}

std::optional<double> median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

std::optional<Interval> median_interval(std::vector<double> values, double confidence) {
  const std::size_t n = values.size();
  std::sort(values.begin(), values.end());
  // Order statistics k and n + 1 - k (from 1) miss the median with twice the chance of fewer than k heads in n throws.
  double chance = std::pow(0.5, static_cast<double>(n)), missed = 0;
  std::optional<Interval> narrowest;
  for (std::size_t k = 1; 2 * k <= n; ++k) {
    missed += 2 * chance;
    if (1 - missed < confidence) break;
    narrowest = Interval{values[k - 1], values[n - k]};
    chance *= static_cast<double>(n - k + 1) / static_cast<double>(k);
  }
  return narrowest;
}

double student_t(std::size_t degrees, double confidence) {
  PLUMB_ASSERT(confidence > 0 && confidence < 1);
  double low = 0, high = 1;
  while (two_sided(high, degrees) < confidence && high < 1e6) high *= 2;
  for (int i = 0; i < 80; ++i) {
    const double middle = (low + high) / 2;
    (two_sided(middle, degrees) < confidence ? low : high) = middle;
  }
  return high;
}

std::optional<Interval> log_normal_interval(const std::vector<double>& values) {
  const std::size_t n = values.size();
  if (n < 2 || std::any_of(values.begin(), values.end(), [](double v) { return !(v > 0); })) return std::nullopt;
  double mean = 0, square = 0;
  for (const double value : values) mean += std::log(value) / static_cast<double>(n);
  for (const double value : values) square += std::pow(std::log(value) - mean, 2);
  const double error = std::sqrt(square / static_cast<double>(n - 1) / static_cast<double>(n));
  const double half = student_t(n - 1) * error;
  return Interval{std::exp(mean - half), std::exp(mean + half)};
}

std::optional<double> relative_spread(const std::vector<double>& values) {
  const auto interval = log_normal_interval(values);
  if (!interval) return std::nullopt;
  PLUMB_ASSERT(interval->low > 0 && interval->high >= interval->low);
  return (interval->high - interval->low) / 2 / std::sqrt(interval->high * interval->low);
}

std::optional<LineFit> fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  PLUMB_ASSERT(x.size() == y.size());
  const std::size_t n = x.size();
  if (n < 2) return std::nullopt;
  double mean_x = 0, mean_y = 0;
  for (std::size_t i = 0; i < n; ++i) {
    mean_x += x[i] / static_cast<double>(n);
    mean_y += y[i] / static_cast<double>(n);
  }
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < n; ++i) {
    xx += (x[i] - mean_x) * (x[i] - mean_x);
    xy += (x[i] - mean_x) * (y[i] - mean_y);
  }
  if (!(xx > 0)) return std::nullopt;
  LineFit fit{xy / xx, mean_y - xy / xx * mean_x, std::nullopt};
  if (n < 3) return fit;
  double residual = 0;
  for (std::size_t i = 0; i < n; ++i) residual += std::pow(y[i] - fit.offset - fit.slope * x[i], 2);
  const double half = student_t(n - 2) * std::sqrt(residual / static_cast<double>(n - 2) / xx);
  fit.slope_interval = Interval{fit.slope - half, fit.slope + half};
  return fit;
}

}  // namespace plumb::harness
