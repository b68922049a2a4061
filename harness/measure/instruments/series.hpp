// A quantity sampled once a step, and what lies between its samples: extremes, crossings, interpolation.
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace plumb::harness {

constexpr double degrees = 180 / std::numbers::pi;  ///< in a radian
constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

/// The larger, or NaN when one of them is: a maximum that forgets no explosion.
[[nodiscard]] inline double largest(double a, double b) { return std::isnan(a) || a >= b ? a : b; }

struct SeriesPoint {
  double time, value;
};

/// On the parabola through three points.
[[nodiscard]] double parabola_at(const SeriesPoint& a, const SeriesPoint& b, const SeriesPoint& c, double time);
/// The vertex of the parabola through three points at equal intervals, where the middle one is their maximum (sign 1)
/// or minimum (-1).
[[nodiscard]] std::optional<SeriesPoint> vertex(const SeriesPoint& a, const SeriesPoint& b, const SeriesPoint& c,
                                                double sign);
/// When the line from a to b passes through a level; none when it does not.
[[nodiscard]] std::optional<double> crossing(const SeriesPoint& a, const SeriesPoint& b, double level);

/// Samples at equal intervals.
class Series {
 public:
  void add(double time, double value) { points_.push_back({time, value}); }
  [[nodiscard]] std::size_t size() const { return points_.size(); }
  [[nodiscard]] const SeriesPoint& operator[](std::size_t i) const { return points_[i]; }
  [[nodiscard]] const SeriesPoint& back() const { return points_.back(); }

  /// Value at a time within the samples, on the parabola through the three nearest.
  [[nodiscard]] double at(double time) const;
  /// Vertices of the parabolas through every sample that no neighbour exceeds; the ends do not count.
  [[nodiscard]] std::vector<SeriesPoint> maxima() const { return extremes(1); }
  [[nodiscard]] std::vector<SeriesPoint> minima() const { return extremes(-1); }
  /// Times at which the value passes through `level`, upward and downward, by linear interpolation.
  [[nodiscard]] std::vector<double> crossings(double level) const;
  /// When the value, falling evenly, gets to 0: the line through the samples at which it was 80 % and 20 % of its
  /// start. None when it never falls to 20 %.
  [[nodiscard]] std::optional<double> end_of_fall() const;

 private:
  [[nodiscard]] std::vector<SeriesPoint> extremes(double sign) const;

  std::vector<SeriesPoint> points_;
};

/// Adds whole turns to angles so that they do not jump.
class Unwrapped {
 public:
  double operator()(double angle) {
    if (started_) turns_ -= std::round((angle - last_) / two_pi);
    started_ = true;
    last_ = angle;
    return angle + two_pi * turns_;
  }

 private:
  static constexpr double two_pi = 6.283185307179586;
  bool started_ = false;
  double last_ = 0, turns_ = 0;
};

}  // namespace plumb::harness
