#include "study/refine.hpp"

#include <algorithm>
#include <cmath>

#include "plumb/assert.hpp"

namespace plumb::harness {

namespace {

constexpr double least_factor = 1.3, bend = 0.5;
constexpr double levels[] = {0.1, 0.01, 0.001};

bool crosses_a_level(const LadderPoint& a, const LadderPoint& b) {
  return std::any_of(std::begin(levels), std::end(levels),
                     [&](double level) { return (a.error <= level) != (b.error <= level); });
}

/// d log error / d log value; none where an error is nothing.
std::optional<double> slope(const LadderPoint& a, const LadderPoint& b) {
  if (!(a.error > 0) || !(b.error > 0)) return std::nullopt;
  PLUMB_ASSERT(a.value > 0 && b.value > a.value);
  return std::log(b.error / a.error) / std::log(b.value / a.value);
}

}  // namespace

std::optional<LadderPoint> ladder_point(const Row& row, double value, std::string& metric) {
  if (!row.completed()) return std::nullopt;
  for (const MetricResult& result : row.metrics) {
    if (!metric.empty() && result.name != metric) continue;
    if (metric.empty() && (!result.error || !result.threshold)) continue;
    if (!result.error) return std::nullopt;
    metric = result.name;
    return LadderPoint{value, std::abs(*result.error)};
  }
  return std::nullopt;
}

std::vector<double> points_to_add(std::vector<LadderPoint> points) {
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) { return a.value < b.value; });
  std::vector<double> added;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const LadderPoint &a = points[i], &b = points[i + 1];
    if (!(a.value > 0) || b.value / a.value < least_factor) continue;
    bool wanted = crosses_a_level(a, b);
    const auto here = slope(a, b);
    for (const std::size_t neighbour : {i - 1, i + 1}) {
      if (wanted || !here || neighbour >= points.size() || neighbour + 1 >= points.size()) continue;
      const auto there = slope(points[neighbour], points[neighbour + 1]);
      wanted = there && std::abs(*there - *here) > bend;
    }
    if (wanted) added.push_back(std::sqrt(a.value * b.value));
  }
  return added;
}

}  // namespace plumb::harness
