#include "report/findings/scorecard.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "base/format.hpp"
#include "plumb/assert.hpp"
#include "report/ordered/counted_error.hpp"
#include "report/ordered/default_run.hpp"
#include "report/ordered/sample.hpp"

namespace plumb::harness {
namespace {

constexpr std::size_t most_scenes = 3;

struct AffordableError {
  double error;  ///< as it counts
  const Row* row;
};

/// What each engine gets for equal cost on a graded metric of a problem; by backend, in their order.
struct EqualCostTest {
  const Problem* problem;
  std::string metric;
  std::vector<std::optional<AffordableError>> errors;
  std::vector<bool> ran;  ///< the engine has a run that is no refusal

  [[nodiscard]] std::optional<double> best() const {
    std::optional<double> least;
    for (const auto& error : errors) {
      if (error && (!least || error->error < *least)) least = error->error;
    }
    return least;
  }
};

/// Factors in logarithms.
class MeanFactor {
 public:
  void add(double factor) {
    PLUMB_ASSERT(factor > 0);
    sum_ += std::log(factor);
    ++count_;
  }
  [[nodiscard]] std::optional<double> mean() const {
    return count_ == 0 ? std::nullopt : std::optional(std::exp(sum_ / static_cast<double>(count_)));
  }

 private:
  double sum_ = 0;
  std::size_t count_ = 0;
};

/// What the dearest engine's defaults cost on the problem; absent where nobody's have a time that counts.
std::optional<double> budget_of(const OrderedRows& ordered, const Problem& problem) {
  std::optional<double> most;
  for (const std::string& backend : ordered.backends) {
    const Row* row = default_run(ordered, problem, backend);
    const std::optional<double> ms = row && row->completed() ? row->ms_per_simulated_second() : std::nullopt;
    if (ms && (!most || *ms > *most)) most = ms;
  }
  return most;
}

std::optional<AffordableError> least_error(const std::vector<Sample>& samples, const std::string& metric,
                                           const Questions& questions, double budget) {
  constexpr double rounding = 1 + 1e-9;
  std::optional<AffordableError> least;
  for (const Sample& sample : samples) {
    const std::optional<Measured> error = sample.error(metric), cost = sample.cost();
    const MetricResult* result = sample.row().metric(metric);
    if (!error || !cost || !result || cost->value > budget * rounding) continue;
    if (!sample.passes() || !questions.counts(sample, metric)) continue;
    const double counted = counted_error(error->value, *result);
    if (!least || counted < least->error) least = AffordableError{counted, &sample.row()};
  }
  return least;
}

std::vector<EqualCostTest> equal_cost_tests(const OrderedRows& ordered) {
  std::vector<EqualCostTest> tests;
  for (const Problem& problem : ordered.problems) {
    const std::optional<double> budget = budget_of(ordered, problem);
    if (!budget) continue;
    const Questions questions(ordered.scored_metrics(problem), problem);
    std::vector<std::vector<Sample>> samples;
    std::vector<bool> ran;
    for (const std::string& backend : ordered.backends) {
      samples.push_back(samples_of(problem, backend));
      const Row* row = ordered.representative(problem, backend);
      ran.push_back(row && !says_nothing(row->verdict()));
    }
    for (const std::string& metric : questions.graded()) {
      EqualCostTest test{&problem, metric, {}, ran};
      for (const std::vector<Sample>& mine : samples)
        test.errors.push_back(least_error(mine, metric, questions, *budget));
      if (test.best()) tests.push_back(std::move(test));
    }
  }
  return tests;
}

bool is_of(const Problem& problem, const std::string* group) { return !group || problem.group == *group; }

RelativeScore error_score(const std::vector<EqualCostTest>& tests, std::size_t backend, const std::string* group) {
  RelativeScore score;
  MeanFactor factors;
  for (const EqualCostTest& test : tests) {
    if (!is_of(*test.problem, group) || !test.ran[backend]) continue;
    ++score.tests;
    if (!test.errors[backend]) continue;
    ++score.reached;
    PLUMB_ASSERT(backend < test.errors.size() && test.ran.size() == test.errors.size());
    const double best = *test.best(), mine = test.errors[backend]->error;
    // Without a limit an error of zero leaves no room for a factor: whoever has it too is as good.
    if (best > 0)
      factors.add(mine / best);
    else if (mine == 0)
      factors.add(1);
  }
  score.factor = factors.mean();
  return score;
}

RelativeScore cost_score(const std::vector<CostTest>& tests, const std::string& backend, const std::string* group) {
  RelativeScore score;
  MeanFactor factors;
  for (const CostTest& test : tests) {
    if (!is_of(*test.lines.front().problem, group) || !test.reached(one_percent)) continue;
    const CostLine* line = test.line_of(backend);
    if (!line || (!line->floor && says_nothing(line->representative->verdict()))) continue;
    ++score.tests;
    if (!line->at[one_percent]) continue;
    ++score.reached;
    const std::optional<double> cheapest = test.cheapest(one_percent);
    if (cheapest && *cheapest > 0) factors.add(*line->at[one_percent]->ms / *cheapest);
  }
  score.factor = factors.mean();
  return score;
}

GroupScore group_score(const OrderedRows& ordered, const std::vector<EqualCostTest>& equal_cost,
                       const std::vector<CostTest>& costs, std::size_t backend, const std::string* group) {
  GroupScore score;
  for (const Problem& problem : ordered.problems) {
    const Row* row = is_of(problem, group) ? default_run(ordered, problem, ordered.backends[backend]) : nullptr;
    if (!row || says_nothing(row->verdict()) || row->verdict() == Verdict::ran) continue;
    ++score.scored;
    score.passed += row->passes();
  }
  PLUMB_ASSERT(score.passed <= score.scored);
  score.error = error_score(equal_cost, backend, group);
  score.cost = cost_score(costs, ordered.backends[backend], group);
  return score;
}

/// A test on which the engine is the best, and by how much; infinite where the others do not pass.
struct Won {
  const EqualCostTest* test;
  std::size_t second;
  double margin;
};

std::optional<Won> won(const EqualCostTest& test, std::size_t backend) {
  if (!test.errors[backend]) return std::nullopt;
  std::optional<Won> won;
  for (std::size_t other = 0; other < test.errors.size(); ++other) {
    if (other == backend || !test.ran[other]) continue;
    const double mine = test.errors[backend]->error;
    const auto& theirs = test.errors[other];
    const double margin = !theirs             ? std::numeric_limits<double>::infinity()
                          : mine > 0          ? theirs->error / mine
                          : theirs->error > 0 ? std::numeric_limits<double>::infinity()
                                              : 1;
    if (!won || margin < won->margin) won = Won{&test, other, margin};
  }
  return won && won->margin > 1 ? won : std::nullopt;
}

Statement won_statement(const OrderedRows& ordered, const Won& won, std::size_t backend) {
  const Row* row = won.test->errors[backend]->row;
  if (!won.test->errors[won.second]) return {fmt::format("{}: alone passes", won.test->problem->title()), row};
  if (std::isinf(won.margin))
    return {fmt::format("{}: {} exact, unlike {}", won.test->problem->title(), won.test->metric,
                        ordered.backends[won.second]),
            row};
  return {fmt::format("{}: {} {} smaller than that of {}", won.test->problem->title(), won.test->metric,
                      ratio_text(won.margin), ordered.backends[won.second]),
          row};
}

std::vector<Statement> best_scenes(const OrderedRows& ordered, const std::vector<EqualCostTest>& tests,
                                   std::size_t backend) {
  std::vector<Won> all;
  for (const EqualCostTest& test : tests) {
    if (const std::optional<Won> one = won(test, backend)) all.push_back(*one);
  }
  std::stable_sort(all.begin(), all.end(), [](const Won& a, const Won& b) { return a.margin > b.margin; });
  std::vector<Statement> best;
  std::set<std::string> scenes;
  for (const Won& one : all) {
    if (best.size() < most_scenes && scenes.insert(one.test->problem->scene).second)
      best.push_back(won_statement(ordered, one, backend));
  }
  return best;
}

std::vector<Statement> broken_scenes(const std::vector<BackendOverview>& overviews, const std::string& backend) {
  std::vector<Statement> breaks;
  std::set<std::string> scenes;
  for (const BackendOverview& overview : overviews) {
    if (overview.backend != backend) continue;
    for (const auto* rows : {&overview.broken, &overview.failures}) {
      for (const Row* row : *rows) {
        if (breaks.size() < most_scenes && scenes.insert(row->scene).second)
          breaks.push_back({failure_text(*row), row});
      }
    }
  }
  return breaks;
}

}  // namespace

std::vector<EngineScore> scorecard(const OrderedRows& ordered, const std::vector<CostLine>& costs,
                                   const std::vector<BackendOverview>& overviews) {
  const std::vector<EqualCostTest> equal_cost = equal_cost_tests(ordered);
  const std::vector<CostTest> tests = tests_of(costs);
  std::vector<EngineScore> scores;
  for (std::size_t backend = 0; backend < ordered.backends.size(); ++backend) {
    EngineScore score{ordered.backends[backend], {}, {}, {}, {}};
    for (const std::string& group : ordered.groups)
      score.groups.push_back(group_score(ordered, equal_cost, tests, backend, &group));
    score.all = group_score(ordered, equal_cost, tests, backend, nullptr);
    score.best = best_scenes(ordered, equal_cost, backend);
    score.breaks = broken_scenes(overviews, score.backend);
    scores.push_back(std::move(score));
  }
  return scores;
}

ScoreChange score_change(const Comparison& comparison, const std::string& backend, const std::string* group) {
  ScoreChange change;
  for (const CellChange& cell : comparison.cells) {
    if (cell.after->backend != backend || (group && cell.after->group != *group)) continue;
    change.better += cell.sense == Sense::better;
    change.worse += cell.sense == Sense::worse;
  }
  return change;
}

std::string score_text(const RelativeScore& score) {
  if (score.tests == 0) return std::string(no_value);
  const std::string factor = score.factor ? ratio_text(*score.factor) : std::string(no_value);
  return fmt::format("{} ({} of {})", factor, score.reached, score.tests);
}

std::string passed_text(const GroupScore& score) {
  return score.scored == 0 ? std::string(no_value) : fmt::format("{} of {}", score.passed, score.scored);
}

std::string change_text(const ScoreChange& change) {
  if (change.better == 0 && change.worse == 0) return "0";
  std::string text = change.better > 0 ? fmt::format("+{}", change.better) : "";
  if (change.worse > 0) text += fmt::format("{}\u2212{}", text.empty() ? "" : " ", change.worse);
  return text;
}

}  // namespace plumb::harness
