#include "report/statistics.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace plumb::harness {
namespace {

/// P(|T| <= limit): the density integrated over an angle, in which it is smooth for every number of degrees.
double student_share(double limit, std::size_t degrees) {
  // t = sqrt(v) tan(a) turns the density into cos(a)^(v - 1) up to a constant, which the whole range fixes.
  const double v = static_cast<double>(degrees);
  const auto integral = [&](double end) {
    constexpr int parts = 400;  // Simpson
    const double step = end / parts;
    double sum = 0;
    for (int i = 0; i <= parts; ++i) {
      const double weight = i == 0 || i == parts ? 1 : i % 2 == 1 ? 4 : 2;
      sum += weight * std::pow(std::max(0.0, std::cos(i * step)), v - 1);
    }
    return sum * step / 3;
  };
  return integral(std::atan(limit / std::sqrt(v))) / integral(std::numbers::pi / 2);
}

}  // namespace

std::optional<double> quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nullopt;
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
  double low = 0, high = 1;
  while (student_share(high, degrees) < confidence && high < 1e6) high *= 2;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (student_share(middle, degrees) < confidence ? low : high) = middle;
  }
  return (low + high) / 2;
}

std::optional<LineFit> fit_line(const std::vector<double>& x, const std::vector<double>& y) {
  const std::size_t n = std::min(x.size(), y.size());
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
