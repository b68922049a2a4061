// Metrics as a row has them, judged by the scene's thresholds.
#pragma once

#include <string>
#include <vector>

#include "measure/measure.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

struct Judgement {
  std::vector<MetricResult> metrics;  ///< one a name
  std::vector<std::string> missed;    ///< a sentence for each threshold that was missed
  std::vector<std::string> silent;    ///< scored metrics without a number
};

/// A metric that the scene lists but that was not measured misses its threshold; one that it does not list has none,
/// and its unit is that of `general` where it is there.
[[nodiscard]] Judgement judge(const std::vector<Metric>& metrics, const std::vector<MetricSpec>& specs,
                              const std::vector<MetricSpec>& general);

}  // namespace plumb::harness
