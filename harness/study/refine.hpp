// Where a ladder of cells wants another point: where its error curve bends, and where the error crosses a level that
// people ask for.
#pragma once

#include <optional>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

/// A finished cell of a ladder.
struct LadderPoint {
  double value;  ///< of the ladder's number, above 0
  double error;  ///< of the metric that the ladder is judged by, a share as all scaled errors are; not below 0
};

/// The point of a row; none when it did not end well enough to have an error. metric: which one, "" until the first row
/// says it, being its first metric with a threshold and an error.
[[nodiscard]] std::optional<LadderPoint> ladder_point(const Row& row, double value, std::string& metric);

/// Values (geometric middles) to add between neighbours: where 10 %, 1 % or 0.1 % lies between their errors, or where
/// the slope of log error over log value changes by more than a half. None between neighbours closer than a factor
/// of 1.3.
[[nodiscard]] std::vector<double> points_to_add(std::vector<LadderPoint> points);

}  // namespace plumb::harness
