#include "report/findings/facts.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "base/format.hpp"
#include "report/ordered/default_run.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {
namespace {

/// Some run of the problem is held against a threshold of it.
bool scores(const Problem& problem, std::string_view name) {
  return std::any_of(problem.rows.begin(), problem.rows.end(), [&](const Row* row) {
    const MetricResult* metric = row->metric(name);
    return metric && metric->scored();
  });
}

constexpr std::size_t examples = 3;  ///< how many cells a statement names before it counts

}  // namespace

std::string percent_text(double share) { return short_number(100 * share, 2) + " %"; }

std::string row_title(const Row& row) {
  const std::string variant = row.variant();
  return variant.empty() ? row.scene : row.scene + " " + variant;
}

bool EnergyFacts::conserves() const {
  return drifts > 0 && lost == 0 && worst_drift <= conserving && drift_row->passes();
}

EnergyFacts energy_of(const OrderedRows& ordered, const std::string& backend) {
  EnergyFacts facts;
  std::vector<double> drifts;
  for (const Problem& problem : ordered.problems) {
    const Row* row = default_run(ordered, problem, backend);
    if (!row || says_nothing(row->verdict()) || !scores(problem, "energy_drift")) continue;
    const MetricResult* metric = row->completed() ? row->metric("energy_drift") : nullptr;
    if (!metric || !metric->error) {
      ++facts.lost;
      if (!facts.lost_row) facts.lost_row = row;
      continue;
    }
    drifts.push_back(*metric->error);
    if (facts.drift_row && *metric->error <= facts.worst_drift) continue;
    facts.worst_drift = *metric->error;
    facts.drift_row = row;
    facts.gains = metric->value.value_or(0) > 0;
  }
  facts.drifts = drifts.size();
  facts.median_drift = median(drifts).value_or(0);
  const auto place = static_cast<std::size_t>(std::find(ordered.backends.begin(), ordered.backends.end(), backend) -
                                              ordered.backends.begin());
  for (const RobustnessLine& line : robustness(ordered)) {
    if (line.metric == "energy_drift") facts.all_drifts = line.cells.at(place);
    if (line.metric == "energy_injected") facts.all_rises = line.cells.at(place);
  }
  return facts;
}

Statement energy_statement(const EnergyFacts& facts) {
  std::vector<std::string> parts;
  if (facts.drifts > 0) {
    parts.push_back(facts.worst_drift <= conserving
                        ? fmt::format("keeps it within {} in {} with a threshold for it",
                                      percent_text(facts.worst_drift),
                                      facts.drifts == 1 ? "the one run of a scene"
                                                        : fmt::format("all {} runs of scenes", facts.drifts))
                        : fmt::format("{} up to {} ({}){}", facts.gains ? "gains" : "loses",
                                      percent_text(facts.worst_drift), row_title(*facts.drift_row),
                                      facts.drifts == 1 ? ""
                                                        : fmt::format("; half of {} runs stay within {}", facts.drifts,
                                                                      percent_text(facts.median_drift))));
  }
  if (facts.lost > 0)
    parts.push_back(
        fmt::format("{} did not come through with a finite one ({})", facts.lost, row_title(*facts.lost_row)));
  if (parts.empty()) return {};
  const auto beyond = [&](const std::optional<RobustnessCell>& cell, std::size_t more_than, const char* words) {
    if (cell && cell->runs > more_than) parts.push_back(fmt::format("{} in {} of {}", words, cell->beyond, cell->runs));
  };
  beyond(facts.all_drifts, facts.drifts, "of all runs that should keep it, beyond 1 %");
  beyond(facts.all_rises, 0, "its rises alone, which contacts give back in part, sum up to more than 1 %");
  const Row* row = facts.drift_row ? facts.drift_row : facts.lost_row;
  std::string text = fmt::format("{}", fmt::join(parts, "; "));
  if (facts.worst_drift <= conserving && row->missed() != "") text += "; that run misses " + row->missed();
  return {text, row};
}

FrictionFacts friction_of(const OrderedRows& ordered, const std::string& backend) {
  FrictionFacts facts;
  const auto spread = [](const Row* row) -> std::optional<double> {
    const MetricResult* metric = row && row->completed() ? row->metric("spread") : nullptr;
    return metric && row->slug == "sliding-stop" ? metric->error : std::nullopt;
  };
  for (const Problem& problem : ordered.problems) {
    const Row* usual = default_run(ordered, problem, backend);
    if (const auto value = spread(usual); value && (!facts.row || *value > facts.spread)) {
      facts.row = usual;
      facts.spread = *value;
    }
    for (const Row* row : problem.rows) {
      const auto value = row->backend == backend && row->passes() ? spread(row) : std::nullopt;
      if (!value || (facts.best_row && *value >= facts.best_spread)) continue;
      facts.best_row = row;
      facts.best_spread = *value;
    }
  }
  return facts;
}

std::vector<const CostLine*> never_reached(const std::vector<CostTest>& tests, const std::string& backend,
                                           std::size_t target) {
  std::vector<const CostLine*> lines;
  for (const CostTest& test : tests) {
    const CostLine* mine = test.line_of(backend);
    if (mine && !mine->at[target] && test.reached(target)) lines.push_back(mine);
  }
  return lines;
}

std::vector<Statement> names_of(const std::vector<const CostLine*>& lines) {
  std::vector<Statement> names;
  for (const CostLine* line : lines)
    names.push_back({line->problem->title() + " " + line->metric, line->representative});
  return names;
}

Statement name_some(const std::string& beginning, const std::vector<Statement>& names) {
  Statement out{beginning, names.front().row};
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i < examples) {
      out.text += (i == 0 ? " " : ", ") + names[i].text;
    } else {
      out.more.push_back(names[i]);
    }
  }
  if (!out.more.empty()) out.text += fmt::format(" and {} more", out.more.size());
  return out;
}

std::vector<Beaten> beaten_at(const std::vector<CostTest>& tests, const std::string& backend, std::size_t target) {
  std::vector<Beaten> out;
  for (const CostTest& test : tests) {
    const CostLine* mine = test.line_of(backend);
    const std::optional<double> least = test.cheapest(target);
    if (!mine || !mine->at[target] || !least || *mine->at[target]->ms <= *least) continue;
    const auto by = std::find_if(test.lines.begin(), test.lines.end(),
                                 [&](const CostLine& line) { return test.is_cheapest(line, target); });
    out.push_back({mine, &*by, *mine->at[target]->ms / *least});
  }
  std::stable_sort(out.begin(), out.end(), [](const Beaten& a, const Beaten& b) { return a.factor > b.factor; });
  return out;
}

std::string failure_text(const Row& row) {
  if (!row.completed()) {
    std::string word(verdict_word(row.verdict()));
    std::replace(word.begin(), word.end(), '_', ' ');
    return fmt::format("{} in {}{}", word, row_title(row), row.reason.empty() ? "" : ": " + row.reason);
  }
  const MetricResult* worst = row.worst();
  if (!worst) return row_title(row);
  std::string out = fmt::format("{}: {} {}", row_title(row), worst->name,
                                worst->value ? short_number(*worst->value) : std::string("not finite"));
  if (!worst->unit.empty() && worst->unit != "1" && worst->value) out += " " + worst->unit;
  if (worst->truth) out += fmt::format(", truth {}", limit_text(*worst->truth));
  return out;
}

std::vector<Statement> name_failures(const std::vector<const Row*>& rows) {
  std::vector<Statement> out;
  for (const Row* row : rows) {
    Statement statement{failure_text(*row), row};
    if (out.size() < examples) {
      out.push_back(std::move(statement));
      continue;
    }
    if (out.size() == examples) out.push_back({fmt::format("and {} more", rows.size() - examples)});
    out.back().more.push_back(std::move(statement));
  }
  return out;
}

}  // namespace plumb::harness
