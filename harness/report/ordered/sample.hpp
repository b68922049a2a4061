// Samples: what one configuration did on a problem. Mostly that is one row; rows that differ in the parameter `seed`
// only are one sample, a distribution.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "rows/row.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {

struct Problem;

/// A number with its band, where one is known.
struct Measured {
  double value;
  std::optional<Interval> band;
};

struct Sample {
  /// At least one, of one backend; first those that pass where most do, else the others.
  std::vector<const Row*> rows;

  [[nodiscard]] const Row& row() const { return *rows.front(); }
  /// Most of its rows pass their scene.
  [[nodiscard]] bool passes() const;
  /// Wall-clock ms per simulated second: of one row with its 95 % interval, of several their median with its 95 %
  /// interval. Absent where a row was measured on a contended machine, since the rest would be another distribution,
  /// and where none has a time.
  [[nodiscard]] std::optional<Measured> cost() const;
  /// Of several rows the median, the band reaching from the smallest to the largest. A row that did not come through
  /// has an infinite error. Absent where no row has the metric, or the median is infinite.
  [[nodiscard]] std::optional<Measured> error(const std::string& metric) const;
};

/// The problem's rows of a backend as samples, in the order of the file; of all backends for "". Rows that declared
/// more than the scene needs are none: they answer another question.
[[nodiscard]] std::vector<Sample> samples_of(const Problem& problem, const std::string& backend);

/// The yes/no questions of a problem (does it stand?) apart from its graded metrics. A run that missed one of them has
/// errors that mean little: what fell down has no overlap left.
class Questions {
 public:
  Questions(const std::vector<std::string>& scored_metrics, const Problem& problem);
  [[nodiscard]] const std::vector<std::string>& graded() const { return graded_; }
  [[nodiscard]] const std::vector<std::string>& asked() const { return asked_; }
  /// "stands, survives": those that the row has missed.
  [[nodiscard]] std::string missed_by(const Row& row) const;
  /// Most of the sample's rows missed one.
  [[nodiscard]] bool missed_by(const Sample& sample) const;
  /// The metric is a question, or the sample missed none: its error of the metric may stand for accuracy.
  [[nodiscard]] bool counts(const Sample& sample, const std::string& metric) const;

 private:
  std::vector<std::string> asked_, graded_;
};

/// The errors of the metric over the rows are 0 and 1 only, and there are some: a yes/no question, of which no diagram
/// can be drawn.
[[nodiscard]] bool is_yes_or_no(const std::vector<const Row*>& rows, const std::string& metric);

}  // namespace plumb::harness
