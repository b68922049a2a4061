#include "report/summary.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>

#include "report/format.hpp"

namespace plumb::harness {
namespace {

constexpr std::size_t examples = 3, one_percent = 1;

struct GroupCount {
  int won = 0, tests = 0;      ///< metrics that somebody gets within 1 %, and those at the lowest cost
  int passed = 0, scored = 0;  ///< problems at the defaults that it can run
};

std::map<std::string, GroupCount> counts_by_group(const Study& study, const std::vector<CostLine>& costs,
                                                  const std::string& backend) {
  std::map<std::string, GroupCount> groups;
  for (auto first = costs.begin(); first != costs.end();) {
    const auto last = std::find_if(first, costs.end(), [&](const CostLine& line) {
      return line.problem != first->problem || line.metric != first->metric;
    });
    const CostLine* cheapest = nullptr;
    for (auto line = first; line != last; ++line) {
      const auto& at = line->at[one_percent];
      if (at && (!cheapest || at->ms < cheapest->at[one_percent]->ms)) cheapest = &*line;
    }
    GroupCount& group = groups[first->problem->group];
    group.tests += cheapest != nullptr;
    group.won += cheapest && cheapest->backend == backend;
    first = last;
  }
  for (const Problem& problem : study.problems) {
    const ResultRow* row = study.representative(problem, backend);
    if (!row || row->verdict() == Verdict::unsupported || row->verdict() == Verdict::ran) continue;
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
    if (!alone && count.won > 0 && 2 * count.won >= count.tests)
      won.push_back(fmt::format("{} ({} of {} metrics)", group, count.won, count.tests));
    if (count.scored > 1 && count.passed == count.scored) passed.push_back(fmt::format("{} ({})", group, count.scored));
    if (count.scored > 1 && 2 * count.passed < count.scored)
      lost.push_back(fmt::format("{} ({} of {})", group, count.scored - count.passed, count.scored));
  }
  add_list(summary.best, "Mostly the cheapest way to 1 % in", won);
  add_list(summary.best, "Passes every problem that it can run of", passed);
  add_list(summary.breaks, "Fails most of", lost);
}

void add_fronts(Summary& summary, const std::vector<Front>& fronts, const std::string& backend, bool alone) {
  std::size_t on = 0, all = 0;
  for (const Front& front : fronts) {
    if (front.best.size() + front.others.size() < 2) continue;
    ++all;
    on += std::any_of(front.best.begin(), front.best.end(),
                      [&](const FrontPoint& point) { return point.sample.row().backend == backend; });
  }
  if (alone || all == 0) return;
  const std::string text = fmt::format("On {} of {} Pareto fronts", on, all);
  (2 * on >= all ? summary.best : summary.breaks).push_back({text, nullptr});
}

/// "D1 H=20: sink 0.4 m (truth 0)"
std::string failure_text(const ResultRow& row) {
  const MetricResult* worst = row.worst();
  if (!worst) return row_title(row);
  std::string out = fmt::format("{}: {} {}", row_title(row), worst->name,
                                worst->value ? short_number(*worst->value) : std::string("not finite"));
  if (!worst->unit.empty() && worst->unit != "1" && worst->value) out += " " + worst->unit;
  if (worst->truth) out += fmt::format(", truth {}", limit_text(*worst->truth));
  return out;
}

void add_failures(Summary& summary, const BackendOverview& overview) {
  const auto add = [&](const std::vector<const ResultRow*>& rows, const char* beginning, const auto& text) {
    for (std::size_t i = 0; i < std::min(examples, rows.size()); ++i)
      summary.breaks.push_back({beginning + text(*rows[i]), rows[i]});
    if (rows.size() > examples)
      summary.breaks.push_back({fmt::format("{}and {} more", beginning, rows.size() - examples), nullptr});
  };
  add(overview.broken, "", [](const ResultRow& row) {
    std::string word(verdict_word(row.verdict()));
    std::replace(word.begin(), word.end(), '_', ' ');
    return fmt::format("{} in {}{}", word, row_title(row), row.reason.empty() ? "" : ": " + row.reason);
  });
  add(overview.failures, "Misses ", failure_text);
}

void add_repeatability(Summary& summary, const Study& study, const std::string& backend) {
  std::size_t repeated = 0, differ = 0;
  const ResultRow* shown = nullptr;
  for (const ResultRow& row : study.rows) {
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

void add_accuracy(Summary& summary, const std::vector<CostLine>& costs, const std::string& backend) {
  const std::vector<const CostLine*> never = never_reached(costs, backend, one_percent);
  if (!never.empty()) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min(examples, never.size()); ++i)
      names.push_back(never[i]->problem->title() + " " + never[i]->metric);
    summary.breaks.push_back(
        {fmt::format("Never within 1 %, with any settings here, where another engine is, in {} {}: {}{}", never.size(),
                     never.size() == 1 ? "metric" : "metrics", fmt::join(names, ", "),
                     never.size() > examples ? " \u2026" : ""),
         never.front()->representative});
  }
  const std::vector<Beaten> beaten = beaten_at(costs, backend, one_percent);
  if (!beaten.empty() && beaten.front().factor >= 2) {
    const Beaten& worst = beaten.front();
    summary.breaks.push_back({fmt::format("Pays {} what {} does for 1 % of {} {}", ratio_text(worst.factor),
                                          worst.by->backend, worst.line->problem->title(), worst.line->metric),
                              worst.line->at[one_percent]->row});
  }
}

}  // namespace

Summary summary_of(const Study& study, const std::vector<CostLine>& costs, const std::vector<Front>& fronts,
                   const BackendOverview& overview) {
  const std::string& backend = overview.backend;
  const bool alone = study.backends.size() == 1;
  Summary summary;
  add_groups(summary, counts_by_group(study, costs, backend), alone);
  if (overview.count(Verdict::gold) > 0)
    summary.best.push_back(
        {fmt::format("Gold in {} of {} problems", overview.count(Verdict::gold), overview.problems), nullptr});
  add_fronts(summary, fronts, backend, alone);
  const EnergyFacts energy = energy_of(study, backend);
  if (const Statement statement = energy_statement(energy); !statement.text.empty()) {
    const bool good = energy.worst_drift <= conserving && energy.worst_injection <= injecting;
    (good ? summary.best : summary.breaks).push_back({"Energy: " + statement.text, statement.row});
  }
  if (const FrictionFacts friction = friction_of(study, backend); friction.pyramid()) {
    summary.breaks.push_back({fmt::format("Its friction is a pyramid: stopping distances differ by {} with the heading",
                                          percent_text(friction.spread)),
                              friction.row});
  } else if (friction.row && friction.spread <= cone_spread) {
    summary.best.push_back(
        {fmt::format("Friction the same in all directions, within {}", percent_text(friction.spread)), friction.row});
  }
  add_repeatability(summary, study, backend);
  add_accuracy(summary, costs, backend);
  add_failures(summary, overview);
  if (const int refused = overview.count(Verdict::unsupported); refused > 0)
    summary.breaks.push_back({fmt::format("Cannot run {} of {} problems", refused, overview.problems), nullptr});
  return summary;
}

}  // namespace plumb::harness
