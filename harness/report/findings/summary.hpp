// An engine in plain language: where it is best and where it breaks, each statement with its number.
#pragma once

#include <vector>

#include "report/findings/facts.hpp"
#include "report/findings/front.hpp"
#include "report/findings/overview.hpp"

namespace plumb::harness {

struct Summary {
  std::vector<Statement> best, breaks;
};

[[nodiscard]] Summary summary_of(const OrderedRows& ordered, const std::vector<CostLine>& costs,
                                 const std::vector<Front>& fronts, const BackendOverview& overview);

}  // namespace plumb::harness
