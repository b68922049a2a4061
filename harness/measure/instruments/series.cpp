#include "measure/instruments/series.hpp"

#include <algorithm>

namespace plumb::harness {

double parabola_at(const SeriesPoint& a, const SeriesPoint& b, const SeriesPoint& c, double time) {
  const auto& [t0, y0] = a;
  const auto& [t1, y1] = b;
  const auto& [t2, y2] = c;
  return y0 * (time - t1) * (time - t2) / ((t0 - t1) * (t0 - t2)) +
         y1 * (time - t0) * (time - t2) / ((t1 - t0) * (t1 - t2)) +
         y2 * (time - t0) * (time - t1) / ((t2 - t0) * (t2 - t1));
}

std::optional<SeriesPoint> vertex(const SeriesPoint& a, const SeriesPoint& b, const SeriesPoint& c, double sign) {
  const double before = sign * a.value, here = sign * b.value, after = sign * c.value;
  if (!(here > before && here >= after)) return std::nullopt;
  const double slope = (after - before) / 2, curvature = before - 2 * here + after;
  const double shift = -slope / curvature;  // in steps from b
  return SeriesPoint{b.time + shift * (c.time - b.time), sign * (here + slope * shift / 2)};
}

std::optional<double> crossing(const SeriesPoint& a, const SeriesPoint& b, double level) {
  const double before = a.value - level, after = b.value - level;
  if ((before < 0) == (after < 0)) return std::nullopt;
  return a.time + (b.time - a.time) * before / (before - after);
}

double Series::at(double time) const {
  if (points_.size() < 3) return not_measured;
  const auto after = std::lower_bound(points_.begin(), points_.end(), time,
                                      [](const SeriesPoint& point, double t) { return point.time < t; });
  const auto index = std::clamp<std::ptrdiff_t>(after - points_.begin(), 1, std::ssize(points_) - 2);
  const auto middle = static_cast<std::size_t>(index);
  return parabola_at(points_[middle - 1], points_[middle], points_[middle + 1], time);
}

std::vector<SeriesPoint> Series::extremes(double sign) const {
  std::vector<SeriesPoint> found;
  for (std::size_t i = 1; i + 1 < points_.size(); ++i)
    if (const auto extreme = vertex(points_[i - 1], points_[i], points_[i + 1], sign)) found.push_back(*extreme);
  return found;
}

std::vector<double> Series::crossings(double level) const {
  std::vector<double> times;
  for (std::size_t i = 1; i < points_.size(); ++i)
    if (const auto time = crossing(points_[i - 1], points_[i], level)) times.push_back(*time);
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
