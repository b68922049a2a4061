// What each need costs: cells that are equal but for the needs that were declared, and end in the same state. Where
// they do not, the engine did something else (bodies sleep, collisions begin), and the times are of different work.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/ordered/ordered_rows.hpp"
#include "rows/row.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {

struct NeedPair {
  const Row *with, *without;
  double factor;  ///< time with it over time without
};

struct NeedCost {
  std::string need;  ///< "sleeping" for rows with needs "scene+sleeping"; "all"
  std::string backend;
  std::vector<NeedPair> pairs;    ///< that ended with the same bits; the largest factor first
  std::vector<NeedPair> changed;  ///< that did not, or do not tell
  std::optional<double> median;   ///< of the factors of `pairs`
};

/// By need, then backend. Only cells that ran to their end on a machine that was not contended.
[[nodiscard]] std::vector<NeedCost> costs_of_needs(const OrderedRows& ordered);

}  // namespace plumb::harness
