#include "report/findings/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "base/format.hpp"
#include "report/ordered/default_run.hpp"

namespace plumb::harness {
namespace {

struct GroupCount {
  std::size_t won = 0, compared = 0;  ///< metrics that somebody gets within 1 % at a known price, and at the lowest
  int passed = 0, scored = 0;         ///< problems at the defaults that it can run
};

std::map<std::string, GroupCount> counts_by_group(const OrderedRows& ordered, const std::vector<CostTest>& tests,
                                                  const std::string& backend) {
  std::map<std::string, GroupCount> groups;
  for (const CostTest& test : tests) {
    GroupCount& group = groups[test.lines.front().problem->group];
    const CostLine* mine = test.line_of(backend);
    group.compared += test.cheapest(one_percent).has_value();
    group.won += mine && test.is_cheapest(*mine, one_percent);
  }
  for (const Problem& problem : ordered.problems) {
    const Row* row = default_run(ordered, problem, backend);
    if (!row || says_nothing(row->verdict()) || row->verdict() == Verdict::ran) continue;
    ++groups[problem.group].scored;
    groups[problem.group].passed += row->verdict() <= Verdict::pass;
  }
  return groups;
}

void add_list(std::vector<Statement>& to, const char* beginning, const std::vector<std::string>& names) {
  if (!names.empty()) to.push_back({fmt::format("{} {}", beginning, fmt::join(names, ", ")), nullptr});
}

void add_groups(Summary& summary, const std::map<std::string, GroupCount>& groups, bool alone) {
  std::vector<std::string> won, passed, lost;
  for (const auto& [name, count] : groups) {
    const std::string group = name.empty() ? "other" : name;
    if (!alone && count.won > 0 && 2 * count.won >= count.compared)
      won.push_back(fmt::format("{} ({} of {} metrics)", group, count.won, count.compared));
    if (count.scored > 1 && count.passed == count.scored) passed.push_back(fmt::format("{} ({})", group, count.scored));
    if (count.scored > 1 && 2 * count.passed < count.scored)
      lost.push_back(fmt::format("{} ({} of {})", group, count.scored - count.passed, count.scored));
  }
  add_list(summary.best, "Mostly the cheapest way to 1 % in", won);
  add_list(summary.best, "Passes every scene variant that it can run of", passed);
  add_list(summary.breaks, "Fails most of", lost);
}

void add_fronts(Summary& summary, const std::vector<Front>& fronts, const std::string& backend, bool alone) {
  const FrontCount count = count_fronts(fronts, backend);
  if (alone || count.ran == 0) return;
  const std::string text = fmt::format("On {} of {} Pareto fronts that it has a passing run for", count.on, count.ran);
  (2 * count.on >= count.ran ? summary.best : summary.breaks).push_back({text, nullptr});
}

void add_failures(Summary& summary, const BackendOverview& overview) {
  const auto add = [&](const std::vector<const Row*>& rows, const char* beginning) {
    for (Statement& statement : name_failures(rows)) {
      if (statement.row) statement.text = beginning + statement.text;
      summary.breaks.push_back(std::move(statement));
    }
  };
  add(overview.broken, "");
  add(overview.failures, "Misses ");
}

void add_repeatability(Summary& summary, const OrderedRows& ordered, const std::string& backend) {
  std::size_t repeated = 0, differ = 0;
  const Row* shown = nullptr;
  for (const Row& row : ordered.rows) {
    const MetricResult* metric = row.backend == backend && row.completed() ? row.metric("determinism") : nullptr;
    if (!metric || !metric->error) continue;
    ++repeated;
    if (*metric->error == 0) continue;
    ++differ;
    if (!shown) shown = &row;
  }
  if (repeated == 0) return;
  if (differ == 0) {
    summary.best.push_back({fmt::format("The same bits again in all {} cells that were repeated", repeated), nullptr});
  } else {
    summary.breaks.push_back(
        {fmt::format("Other bits when run again in {} of {} cells ({})", differ, repeated, row_title(*shown)), shown});
  }
}

void add_accuracy(Summary& summary, const std::vector<CostTest>& tests, const std::string& backend) {
  if (const std::vector<Statement> unreached = names_of(never_reached(tests, backend, one_percent));
      !unreached.empty()) {
    summary.breaks.push_back(
        name_some(fmt::format("Never passes within 1 %, with any settings here, where another engine does, in {} {}:",
                              unreached.size(), unreached.size() == 1 ? "metric" : "metrics"),
                  unreached));
  }
  const std::vector<Beaten> beaten = beaten_at(tests, backend, one_percent);
  if (!beaten.empty() && beaten.front().factor >= 2) {
    const Beaten& worst = beaten.front();
    summary.breaks.push_back({fmt::format("Pays {} what {} does for 1 % of {} {}", ratio_text(worst.factor),
                                          worst.by->backend, worst.line->problem->title(), worst.line->metric),
                              worst.line->at[one_percent]->row});
  }
}

}  // namespace

Summary summary_of(const OrderedRows& ordered, const std::vector<CostLine>& costs, const std::vector<Front>& fronts,
                   const BackendOverview& overview) {
  const std::string& backend = overview.backend;
  const bool alone = ordered.backends.size() == 1;
  Summary summary;
  const std::vector<CostTest> tests = tests_of(costs);
  add_groups(summary, counts_by_group(ordered, tests, backend), alone);
  if (overview.count(Verdict::gold) > 0)
    summary.best.push_back(
        {fmt::format("Gold in {} of {} scene variants", overview.count(Verdict::gold), overview.problems), nullptr});
  add_fronts(summary, fronts, backend, alone);
  const EnergyFacts energy = energy_of(ordered, backend);
  if (const Statement statement = energy_statement(energy); !statement.text.empty()) {
    (energy.conserves() ? summary.best : summary.breaks).push_back({"Energy: " + statement.text, statement.row});
  }
  if (const FrictionFacts friction = friction_of(ordered, backend); friction.pyramid()) {
    summary.breaks.push_back({fmt::format("Its friction is a pyramid: stopping distances differ by {} with the heading",
                                          percent_text(friction.spread)),
                              friction.row});
  } else if (friction.row && friction.spread <= cone_spread) {
    summary.best.push_back(
        {fmt::format("Friction the same in all directions, within {}", percent_text(friction.spread)), friction.row});
  }
  add_repeatability(summary, ordered, backend);
  add_accuracy(summary, tests, backend);
  add_failures(summary, overview);
  if (const int refused = overview.count(Verdict::unsupported); refused > 0)
    summary.breaks.push_back({fmt::format("Cannot run {} of {} scene variants", refused, overview.problems), nullptr});
  return summary;
}

}  // namespace plumb::harness
