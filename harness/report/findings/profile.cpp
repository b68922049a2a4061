#include "report/findings/profile.hpp"

#include <algorithm>
#include <functional>
#include <limits>
#include <map>
#include <optional>

#include "plumb/assert.hpp"

namespace plumb::harness {
namespace {

using Lines = std::vector<const CostLine*>;

/// Those that have a cell of at least half of the tests: one that ran a few scenes only would leave no common ones.
std::vector<std::string> engines_of(const OrderedRows& ordered, const std::vector<Lines>& tests) {
  std::map<std::string, std::size_t> count;
  for (const Lines& test : tests) {
    for (const CostLine* line : test) ++count[line->backend];
  }
  std::vector<std::string> engines = ordered.backends;
  std::erase_if(engines,
                [&](const std::string& backend) { return 2 * count[backend] < tests.size() || tests.empty(); });
  return engines;
}

/// Lines of each problem and metric of the group on which all engines have a cell.
std::vector<Lines> common_tests(const OrderedRows& ordered, const std::vector<CostLine>& costs,
                                const std::string& group) {
  std::vector<Lines> tests;
  for (const CostTest& test : tests_of(costs)) {
    if (!group.empty() && test.lines.front().problem->group != group) continue;
    tests.emplace_back();
    for (const CostLine& line : test.lines) tests.back().push_back(&line);
  }
  const std::vector<std::string> engines = engines_of(ordered, tests);
  for (Lines& test : tests) {
    std::erase_if(test, [&](const CostLine* line) {
      return std::find(engines.begin(), engines.end(), line->backend) == engines.end();
    });
  }
  std::erase_if(tests, [&](const Lines& test) { return test.empty() || test.size() != engines.size(); });
  return tests;
}

/// x of a line, absent where it is not solved; within the lines of its test.
using Score = std::function<std::optional<double>(const CostLine&, const Lines&)>;

Profile profile_of(const OrderedRows& ordered, const std::vector<Lines>& tests, const Score& score) {
  Profile profile;
  profile.tests = tests.size();
  std::map<std::string, std::vector<std::pair<double, const CostLine*>>> solved;
  for (const Lines& test : tests) {
    bool any = false;
    for (const CostLine* line : test) {
      const std::optional<double> x = score(*line, test);
      if (!x) continue;
      any = true;
      solved[line->backend].emplace_back(*x, line);
    }
    profile.unsolved += !any;
  }
  for (const std::string& backend : ordered.backends) {
    const bool takes_part = std::any_of(tests.begin(), tests.end(), [&](const Lines& test) {
      return std::any_of(test.begin(), test.end(), [&](const CostLine* line) { return line->backend == backend; });
    });
    if (!takes_part) continue;
    ProfileCurve curve{backend, {}, {}};
    auto& of_backend = solved[backend];
    std::stable_sort(of_backend.begin(), of_backend.end(),
                     [](const auto& a, const auto& b) { return a.first < b.first; });
    for (std::size_t i = 0; i < of_backend.size(); ++i) {
      curve.tests.push_back(of_backend[i].second);
      const double share = static_cast<double>(i + 1) / static_cast<double>(tests.size());
      PLUMB_ASSERT(share <= 1);
      if (!curve.steps.empty() && curve.steps.back().x == of_backend[i].first) {
        curve.steps.back().share = share;
      } else {
        curve.steps.push_back({of_backend[i].first, share});
      }
    }
    profile.curves.push_back(std::move(curve));
  }
  return profile;
}

}  // namespace

double ProfileCurve::at(double x) const {
  double share = 0;
  for (const ProfileStep& step : steps) {
    if (step.x <= x) share = step.share;
  }
  return share;
}

Profile cost_profile(const OrderedRows& ordered, const std::vector<CostLine>& costs, const std::string& group,
                     std::size_t target) {
  const std::vector<Lines> tests = common_tests(ordered, costs, group);
  const auto unpriced = [&](const Lines& test) {
    return std::any_of(test.begin(), test.end(),
                       [&](const CostLine* line) { return line->at[target] && !line->at[target]->priced(); });
  };
  Profile profile = profile_of(ordered, tests, [&](const CostLine& line, const Lines& test) -> std::optional<double> {
    if (!line.at[target]) return std::nullopt;
    double cheapest = std::numeric_limits<double>::infinity();
    // With one price unknown nobody's ratio to the cheapest is known; that it is solved is.
    if (unpriced(test)) return cheapest;
    for (const CostLine* other : test) {
      if (other->at[target]) cheapest = std::min(cheapest, *other->at[target]->ms);
    }
    return *line.at[target]->ms / cheapest;
  });
  profile.unpriced = static_cast<std::size_t>(std::count_if(tests.begin(), tests.end(), unpriced));
  return profile;
}

Profile error_profile(const OrderedRows& ordered, const std::vector<CostLine>& costs, const std::string& group) {
  std::vector<Lines> tests = common_tests(ordered, costs, group);
  std::map<const Problem*, Questions> questions;
  for (const Lines& test : tests) {
    const Problem& problem = *test.front()->problem;
    questions.try_emplace(&problem, ordered.scored_metrics(problem), problem);
  }
  std::erase_if(tests, [&](const Lines& test) {
    const std::vector<std::string>& graded = questions.at(test.front()->problem).graded();
    return std::find(graded.begin(), graded.end(), test.front()->metric) == graded.end() ||
           !std::all_of(test.begin(), test.end(),
                        [&](const CostLine* line) { return ordered.is_default(*line->representative); });
  });
  return profile_of(ordered, tests, [&](const CostLine& line, const Lines&) -> std::optional<double> {
    const Row& row = *line.representative;
    const MetricResult* metric = row.metric(line.metric);
    if (!row.completed() || !metric || !questions.at(line.problem).missed_by(row).empty()) return std::nullopt;
    return metric->error;
  });
}

}  // namespace plumb::harness
