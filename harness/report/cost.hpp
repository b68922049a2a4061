// What accuracy costs: for every problem, metric and backend the cheapest configuration that reaches an error.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "report/sample.hpp"
#include "report/study.hpp"

namespace plumb::harness {

inline constexpr std::array<double, 3> target_errors{0.1, 0.01, 0.001};

/// A configuration that reaches an error, and at which price.
struct Reached {
  const ResultRow* row;          ///< its first, where seeds make it several
  double ms;                     ///< wall time per simulated second
  double error;                  ///< median over the seeds
  std::optional<Interval> band;  ///< 95 % of ms, where known
};

struct CostLine {
  const Problem* problem;
  std::string metric, backend;
  std::array<std::optional<Reached>, target_errors.size()> at;  ///< by target_errors; empty: never
  std::optional<Reached> floor;                                 ///< smallest error, the cheapest of equals
  const ResultRow* representative;  ///< the backend's cell that says why, where nothing is reached; never null
  bool contended = false;           ///< it has errors, but times of a contended machine only
};

/// Lines by problem, then metric, then backend; only backends with a cell on the problem. A cell counts for a metric
/// when it ran to its end (passed or not) with a finite error and a fair time, both from that one run, and missed none
/// of the scene's yes/no questions: a tower that fell has little overlap left, and no accuracy.
[[nodiscard]] std::vector<CostLine> cost_of_accuracy(const Study& study);

}  // namespace plumb::harness
