#include "measure/series.hpp"

#include <algorithm>

namespace plumb::harness {

double Series::at(double time) const {
  if (points_.size() < 3) return not_measured;
  const auto after = std::lower_bound(points_.begin(), points_.end(), time,
                                      [](const SeriesPoint& point, double t) { return point.time < t; });
  const auto index = std::clamp<std::ptrdiff_t>(after - points_.begin(), 1, std::ssize(points_) - 2);
  const auto middle = static_cast<std::size_t>(index);
  const auto& [t0, y0] = points_[middle - 1];
  const auto& [t1, y1] = points_[middle];
  const auto& [t2, y2] = points_[middle + 1];
  return y0 * (time - t1) * (time - t2) / ((t0 - t1) * (t0 - t2)) +
         y1 * (time - t0) * (time - t2) / ((t1 - t0) * (t1 - t2)) +
         y2 * (time - t0) * (time - t1) / ((t2 - t0) * (t2 - t1));
}

std::vector<SeriesPoint> Series::extremes(double sign) const {
  std::vector<SeriesPoint> found;
  for (std::size_t i = 1; i + 1 < points_.size(); ++i) {
    const double before = sign * points_[i - 1].value, here = sign * points_[i].value,
                 after = sign * points_[i + 1].value;
    if (!(here > before && here >= after)) continue;
    const double slope = (after - before) / 2, curvature = before - 2 * here + after;
    const double shift = -slope / curvature;  // in steps from i
    const double step = points_[i + 1].time - points_[i].time;
    found.push_back({points_[i].time + shift * step, sign * (here + slope * shift / 2)});
  }
  return found;
}

std::vector<double> Series::crossings(double level) const {
  std::vector<double> times;
  for (std::size_t i = 1; i < points_.size(); ++i) {
    const double before = points_[i - 1].value - level, after = points_[i].value - level;
    if ((before < 0) == (after < 0)) continue;
    times.push_back(points_[i - 1].time + (points_[i].time - points_[i - 1].time) * before / (before - after));
  }
  return times;
}

std::optional<double> Series::end_of_fall() const {
  if (points_.size() < 3) return std::nullopt;
  const double start = points_.front().value;
  const auto below = [&](double share) {
    return std::find_if(points_.begin(), points_.end(), [&](const SeriesPoint& p) { return p.value <= share * start; });
  };
  const auto high = below(0.8), low = below(0.2);
  if (low == points_.end()) return std::nullopt;
  // With too few samples in between, the fall took a step or two: its end is the best there is.
  if (low - high < 1 || low->value < 0) return low->time;
  return low->time + low->value * (low->time - high->time) / (high->value - low->value);
}

}  // namespace plumb::harness
