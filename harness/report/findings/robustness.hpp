// Measures that need no truth, over all scenes: overlap, energy that came from nowhere, momentum, residuals of the
// contact laws. They hold anywhere, so that an engine's worst and its usual are what counts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/ordered/ordered_rows.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

struct RobustnessCell {
  std::size_t runs = 0, beyond = 0;  ///< at the engine's defaults; of those, above the bound
  std::size_t lost = 0;  ///< that did not come through, or not to a finite measure, where another engine's did
  double worst = 0, median = 0;
  const Row* row = nullptr;  ///< the worst
};

struct RobustnessLine {
  std::string metric, unit;
  double bound;
  std::vector<std::optional<RobustnessCell>> cells;  ///< by backend, in their order; empty: never measured
};

/// Metrics of a truth of zero or one that at least two scenes have without scoring them, by name; at the defaults, and
/// with those scenes that do score them.
[[nodiscard]] std::vector<RobustnessLine> robustness(const OrderedRows& ordered);

/// What the report calls beyond bound: none of it is a threshold of a scene.
[[nodiscard]] double robustness_bound(std::string_view metric);

}  // namespace plumb::harness
