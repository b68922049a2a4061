// Pareto fronts: on a problem and metric, the configurations of all engines than which no other is both as cheap and as
// exact, and for each of the rest one of those that is.
#pragma once

#include <string>
#include <vector>

#include "report/ordered/ordered_rows.hpp"
#include "report/ordered/sample.hpp"

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
  std::size_t untimed = 0;        ///< configurations that would be in the race, and have no time that counts
};

/// For every problem and graded metric with a configuration that counts: its runs pass all thresholds of the scene, and
/// have a fair time. One that equals another in cost and error is on the front with it.
[[nodiscard]] std::vector<Front> pareto_fronts(const OrderedRows& ordered);

/// Where an engine stands among all fronts that say something: of three configurations or more, all of them timed.
struct FrontCount {
  std::size_t ran = 0;                       ///< fronts that it has a configuration of
  std::size_t on = 0;                        ///< of those it stands on, alone or with others
  std::size_t alone = 0;                     ///< it stands on alone
  std::size_t cheapest = 0, most_exact = 0;  ///< it has that end of
};
[[nodiscard]] FrontCount count_fronts(const std::vector<Front>& fronts, const std::string& backend);
[[nodiscard]] bool says_something(const Front& front);

/// The rule alone.
[[nodiscard]] Front pareto_front(const Problem& problem, const std::string& metric, std::vector<FrontPoint> points);

}  // namespace plumb::harness
