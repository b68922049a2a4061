// A scorecard: by group of scenes what each engine passes, how accurate it is at equal cost and how dear at equal
// accuracy, relative to the best; and the three scenes where it is best and where it breaks.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/findings/facts.hpp"
#include "report/findings/overview.hpp"
#include "report/ordered/against.hpp"
#include "report/ordered/cost.hpp"
#include "report/ordered/ordered_rows.hpp"

namespace plumb::harness {

/// A geometric mean of factors over the best engine's, and over how many of the tests it could be taken.
struct RelativeScore {
  std::optional<double> factor;  ///< 1: nobody is better anywhere
  std::size_t reached = 0;       ///< tests with a passing run of this engine, whose factors are in the mean
  std::size_t tests = 0;         ///< that some engine has a passing run of, and that this one has run
};

struct GroupScore {
  int passed = 0, scored = 0;  ///< problems at the engine's defaults, without those that it cannot run
  /// Error that can be had for no more than what the dearest engine's defaults cost there, over the best one's.
  RelativeScore error;
  RelativeScore cost;  ///< of an error of 1 %, over the cheapest
};

struct EngineScore {
  std::string backend;
  std::vector<GroupScore> groups;  ///< in the order of OrderedRows::groups
  GroupScore all;
  std::vector<Statement> best, breaks;  ///< at most three each, of different scenes
};

/// In the order of OrderedRows::backends. A test is a graded metric of a problem; only runs that pass their scene
/// count, and errors as counted_error has them.
[[nodiscard]] std::vector<EngineScore> scorecard(const OrderedRows& ordered, const std::vector<CostLine>& costs,
                                                 const std::vector<BackendOverview>& overviews);

/// Cells of an engine in a group that got better and worse since a baseline; of all groups where `group` is null.
struct ScoreChange {
  std::size_t better = 0, worse = 0;
};
[[nodiscard]] ScoreChange score_change(const Comparison& comparison, const std::string& backend,
                                       const std::string* group);

/// "1.3x (12 of 20)"; an en dash where nothing could be compared.
[[nodiscard]] std::string score_text(const RelativeScore& score);
/// "12 of 14", an en dash where nothing is scored.
[[nodiscard]] std::string passed_text(const GroupScore& score);
/// "+3 -1", "0" where nothing changed.
[[nodiscard]] std::string change_text(const ScoreChange& change);

}  // namespace plumb::harness
