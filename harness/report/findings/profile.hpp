// Performance profiles (Dolan and More, Benchmarking optimization software with performance profiles, 2002): over a set
// of tests, the share that an engine solves at no more than x times the cost of the engine that is the cheapest there.
#pragma once

#include <string>
#include <vector>

#include "report/ordered/cost.hpp"

namespace plumb::harness {

struct ProfileStep {
  double x;      ///< cost relative to the cheapest, or an error
  double share;  ///< of the tests, at this x and up to the next step
};

struct ProfileCurve {
  std::string backend;
  std::vector<ProfileStep> steps;      ///< x and share rising; empty where nothing was solved
  std::vector<const CostLine*> tests;  ///< behind the steps' growth, by x

  /// Share at x; 0 before the first step.
  [[nodiscard]] double at(double x) const;
  /// Share that is solved at any cost, known or not.
  [[nodiscard]] double reliability() const { return steps.empty() ? 0 : steps.back().share; }
};

struct Profile {
  std::size_t tests = 0;     ///< pairs of a problem and a metric that all engines here have a cell of
  std::size_t unsolved = 0;  ///< of those, nobody reaches the error; they count as not solved for all
  std::size_t unpriced = 0;  ///< somebody reaches it at a price that no fair time tells: solved, at x = infinity
  std::vector<ProfileCurve>
      curves;  ///< by backend, in their order; without engines that ran less than half of the tests
};

/// Cost to reach target_errors[target], over the tests of a group; "" for all groups.
[[nodiscard]] Profile cost_profile(const OrderedRows& ordered, const std::vector<CostLine>& costs,
                                   const std::string& group, std::size_t target);

/// Not relative to a best, for which errors of zero leave no room: the share of graded tests whose error at the
/// engine's defaults is at most x. A cell that did not come through, or missed a yes/no question, is not solved at any
/// x.
[[nodiscard]] Profile error_profile(const OrderedRows& ordered, const std::vector<CostLine>& costs,
                                    const std::string& group);

}  // namespace plumb::harness
