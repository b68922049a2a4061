// Pareto fronts: on a problem and metric, the configurations of all engines than which no other is both as cheap and as
// exact, and for each of the rest one of those that is.
#pragma once

#include <string>
#include <vector>

#include "report/sample.hpp"
#include "report/study.hpp"

namespace plumb::harness {

struct FrontPoint {
  Sample sample;
  double ms, error;  ///< per simulated second; medians over seeds
};

struct Dominated {
  FrontPoint point;
  std::size_t by;  ///< place in Front::best: the cheapest there that is as exact
};

struct Front {
  const Problem* problem;
  std::string metric;
  std::vector<FrontPoint> best;   ///< cheapest first; each dearer one is more exact
  std::vector<Dominated> others;  ///< cheapest first
};

/// For every problem and graded metric with a configuration that counts (see cost_of_accuracy). One that equals
/// another in cost and error is on the front with it.
[[nodiscard]] std::vector<Front> pareto_fronts(const Study& study);

/// The rule alone.
[[nodiscard]] Front pareto_front(const Problem& problem, const std::string& metric, std::vector<FrontPoint> points);

}  // namespace plumb::harness
