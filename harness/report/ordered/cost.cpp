#include "report/ordered/cost.hpp"

#include <algorithm>
#include <map>

#include "plumb/assert.hpp"

namespace plumb::harness {
namespace {

/// The cheapest of what reaches the same; what has no time is remembered.
void offer(std::optional<Reached>& best, Reached offered) {
  PLUMB_ASSERT(!std::isnan(offered.error));
  offered.untimed = offered.ms ? 0 : 1;
  if (!best) {
    best = offered;
    return;
  }
  const std::size_t untimed = best->untimed + offered.untimed;
  if (offered.ms && (!best->ms || *offered.ms < *best->ms)) best = offered;
  best->untimed = untimed;
}

/// What one kind of runs reaches: those that pass their scene, or the others.
struct Runs {
  CostLine::ByTarget at;
  std::optional<Reached> floor;

  void add(const Reached& run) {
    for (std::size_t t = 0; t < target_errors.size(); ++t) {
      if (run.error <= target_errors[t]) offer(at[t], run);
    }
    if (floor && run.error < floor->error) floor.reset();
    if (!floor || run.error == floor->error) offer(floor, run);
  }
};

CostLine find_costs(const Problem& problem, const std::string& metric, const std::string& backend,
                    const std::vector<Sample>& samples, const Questions& questions, const Row* representative) {
  Runs passing, failing;
  for (const Sample& sample : samples) {
    const std::optional<Measured> error = sample.error(metric), cost = sample.cost();
    if (!error || !questions.counts(sample, metric)) continue;
    Reached run{&sample.row(), error->value, {}, {}};
    if (cost) {
      run.ms = cost->value;
      run.band = cost->band;
    }
    (sample.passes() ? passing : failing).add(run);
  }
  for (std::size_t t = 0; t < target_errors.size(); ++t) {
    if (passing.at[t]) failing.at[t].reset();
  }
  return {&problem,      metric, backend, passing.at, failing.at, passing.floor ? passing.floor : failing.floor,
          representative};
}

}  // namespace

std::vector<CostLine> cost_of_accuracy(const OrderedRows& ordered) {
  std::vector<CostLine> lines;
  for (const Problem& problem : ordered.problems) {
    const std::vector<std::string> metrics = ordered.scored_metrics(problem);
    const Questions questions(metrics, problem);
    std::map<std::string, std::vector<Sample>> samples;
    for (Sample& sample : samples_of(problem, "")) samples[sample.row().backend].push_back(std::move(sample));
    for (const std::string& metric : metrics) {
      for (const std::string& backend : ordered.backends) {
        const Row* representative = ordered.representative(problem, backend);
        if (!representative) continue;
        lines.push_back(find_costs(problem, metric, backend, samples[backend], questions, representative));
      }
    }
  }
  return lines;
}

const CostLine* CostTest::line_of(const std::string& backend) const {
  const auto found =
      std::find_if(lines.begin(), lines.end(), [&](const CostLine& line) { return line.backend == backend; });
  return found == lines.end() ? nullptr : &*found;
}

bool CostTest::reached(std::size_t target) const {
  return std::any_of(lines.begin(), lines.end(), [&](const CostLine& line) { return line.at[target].has_value(); });
}

std::optional<double> CostTest::cheapest(std::size_t target) const {
  std::optional<double> least;
  for (const CostLine& line : lines) {
    if (!line.at[target]) continue;
    if (!line.at[target]->priced()) return std::nullopt;
    if (!least || *line.at[target]->ms < *least) least = line.at[target]->ms;
  }
  return least;
}

bool CostTest::is_cheapest(const CostLine& line, std::size_t target) const {
  const std::optional<double> least = lines.size() > 1 ? cheapest(target) : std::nullopt;
  return least && line.at[target] && line.at[target]->ms == least;
}

std::vector<CostTest> tests_of(const std::vector<CostLine>& lines) {
  std::vector<CostTest> tests;
  for (auto first = lines.begin(); first != lines.end();) {
    const auto last = std::find_if(first, lines.end(), [&](const CostLine& line) {
      return line.problem != first->problem || line.metric != first->metric;
    });
    tests.push_back({{first, last}});
    first = last;
  }
  return tests;
}

ReachCount count_reached(const std::vector<CostTest>& tests, const std::string& backend, std::size_t target) {
  ReachCount count;
  for (const CostTest& test : tests) {
    const CostLine* line = test.line_of(backend);
    if (!line || (!line->floor && says_nothing(line->representative->verdict()))) continue;
    ++count.tests;
    if (!line->at[target]) continue;
    ++count.reached;
    count.compared += test.lines.size() > 1 && test.cheapest(target).has_value();
    count.cheapest += test.is_cheapest(*line, target);
  }
  return count;
}

}  // namespace plumb::harness
