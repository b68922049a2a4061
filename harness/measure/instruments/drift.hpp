// Watches over a run: how joints drift apart, and how still a scene stands.
#pragma once

#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "measure/instruments/series.hpp"
#include "measure/measure.hpp"
#include "referee/joints.hpp"

namespace plumb::harness {

/// Gaps, locked angles and limits of all joints of a scene (metric 9). The secular slope, of the least-squares line
/// through the worst gap over time, tells drift from trembling.
class JointDrift {
 public:
  /// Of one sampled state; scene: whose joints these are.
  void add(const Scene& scene, std::span<const PoseRow> poses, double time);
  /// The same from errors that are known.
  void add(std::span<const referee::JointError> errors, double time);

  [[nodiscard]] double gap_max() const { return gap_; }      ///< m
  [[nodiscard]] double angle_max() const { return angle_; }  ///< rad, in ways that a joint locks
  [[nodiscard]] double limit_max() const { return limit_; }  ///< rad or m beyond a limit, the larger number
  [[nodiscard]] double gap_rms() const { return std::sqrt(squares_ / static_cast<double>(count_)); }  ///< m
  [[nodiscard]] double gap_slope() const;                                                             ///< m/s

 private:
  double gap_ = 0, angle_ = 0, limit_ = 0, squares_ = 0;
  std::size_t count_ = 0;
  std::vector<SeriesPoint> worst_;
};

/// Slope of the least-squares line through points; 0 for fewer than two times.
[[nodiscard]] double slope_of(std::span<const SeriesPoint> points);

/// How still moving bodies are (metric 10): speeds relative to g dt, what a body without support gains in a step.
class RestWatch {
 public:
  /// seconds: of the run; the last `window` of it counts, s.
  RestWatch(double seconds, double window = 2) : begin_(seconds - window) {}
  void add(double time, std::span<const double> speeds);
  /// Of the moving bodies of a simulation.
  void add(Simulation& simulation);

  [[nodiscard]] double last_speed() const { return last_; }  ///< of the fastest body in the last sample, m/s
  [[nodiscard]] double jitter() const;                       ///< RMS of all bodies over the window, m/s
  /// Metrics rest_speed and jitter, both relative to g dt.
  void add_to(MeasureContext& context) const;

 private:
  double begin_, last_ = 0, squares_ = 0;
  std::size_t count_ = 0;
};

}  // namespace plumb::harness
