// How the samples of a quantity become one number: its value at a time, or its extreme, mean or passes of a level
// within a window. In one pass; what is kept does not grow with the run.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "measure/instruments/series.hpp"

namespace plumb::harness {

enum class Take { at, min, max, max_abs, mean, rms, rise, range, time_of_min, time_of_max, crossing_time, period };

/// "min", "max" ... by Take, the first ("at") among them.
[[nodiscard]] const std::vector<std::string>& take_words();
/// One line for each.
[[nodiscard]] const std::vector<std::string>& take_docs();
[[nodiscard]] inline bool gives_a_time(Take take) { return take >= Take::time_of_min; }
[[nodiscard]] inline bool needs_a_level(Take take) { return take >= Take::crossing_time; }

struct ReductionSpec {
  Take take = Take::at;
  double begin = 0, end = 0;  ///< s; of `at` both are the time
  double dt = 0;
  double level = 0;      ///< of crossing_time and period
  bool smooth = false;   ///< between samples lie parabolas, so extremes and `at` may lie between them
  bool of_step = false;  ///< a sample stands for the step that ends with it, not for an instant
};

class Reduction {
 public:
  virtual ~Reduction() = default;
  /// Whether a sample at this time matters.
  [[nodiscard]] bool wants(double time) const;
  /// Whether the time lies in the window, its ends included.
  [[nodiscard]] bool holds(double time) const;
  /// Samples in order, none left out that it wants.
  void add(const SeriesPoint& sample);

  struct Result {
    double value;
    std::string trouble;  ///< why it is NaN
  };
  [[nodiscard]] Result result() const;

 protected:
  explicit Reduction(const ReductionSpec& spec) : spec_(spec) {}
  [[nodiscard]] const ReductionSpec& spec() const { return spec_; }
  virtual void take(const SeriesPoint& sample) = 0;
  [[nodiscard]] virtual Result taken() const = 0;

 private:
  ReductionSpec spec_;
  std::optional<double> lost_;  ///< when a sample was first not finite
};

[[nodiscard]] std::unique_ptr<Reduction> make_reduction(const ReductionSpec& spec);

/// How many samples of a run lie within the window of a spec: steps that end within it, and the start where that
/// counts.
[[nodiscard]] double samples_within(const ReductionSpec& spec);

}  // namespace plumb::harness
