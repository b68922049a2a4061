// Distributions over seeds, at each engine's defaults: of a scene whose outcome hangs on a hair, one run says little,
// and how many of many stand, or how far their answers lie apart, says what an engine does.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/ordered/ordered_rows.hpp"
#include "report/ordered/sample.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

struct DistributionCell {
  std::size_t runs = 0, passed = 0;  ///< passed: of those, within the metric's threshold; 0 where it has none
  /// Of the errors, or of the values where there is no truth; over the runs that have one.
  std::optional<double> least, median, most;
  const Row* row = nullptr;  ///< the run of the largest, or one that has none
};

struct DistributionLine {
  const Problem* problem;
  std::string metric, unit;
  bool scored, asked;                                  ///< it has a threshold; its errors are 0 and 1 only: a question
  std::vector<std::optional<DistributionCell>> cells;  ///< by backend, in their order
};

/// Of every problem that some backend ran with at least three seeds, its scored metrics and those without a truth.
[[nodiscard]] std::vector<DistributionLine> distributions(const OrderedRows& ordered);

}  // namespace plumb::harness
