// What each need costs: cells that are equal but for the needs that were declared.
#pragma once

#include <string>
#include <vector>

#include "report/study.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {

struct NeedPair {
  const ResultRow *with, *without;
  double factor;  ///< time with it over time without
};

struct NeedCost {
  std::string need;  ///< "sleeping" for rows with needs "scene+sleeping"; "all"
  std::string backend;
  std::vector<NeedPair> pairs;  ///< at least one; the largest factor first
  double median;                ///< of the factors
};

/// By need, then backend. Only cells that ran to their end on a machine that was not contended.
[[nodiscard]] std::vector<NeedCost> costs_of_needs(const Study& study);

}  // namespace plumb::harness
