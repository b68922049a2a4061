#include "report/facts.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "report/format.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {
namespace {

using LineIterator = std::vector<CostLine>::const_iterator;

/// Calls `look(mine, first, last)` for each line of the backend and all lines of its problem and metric.
template <typename Look>
void over_tests(const std::vector<CostLine>& costs, const std::string& backend, const Look& look) {
  for (LineIterator first = costs.begin(); first != costs.end();) {
    const LineIterator last = std::find_if(first, costs.end(), [&](const CostLine& line) {
      return line.problem != first->problem || line.metric != first->metric;
    });
    const LineIterator mine = std::find_if(first, last, [&](const CostLine& line) { return line.backend == backend; });
    if (mine != last) look(*mine, first, last);
    first = last;
  }
}

}  // namespace

std::string percent_text(double share) { return short_number(100 * share, 2) + " %"; }

std::string row_title(const ResultRow& row) {
  const std::string variant = row.variant();
  return variant.empty() ? row.scene : row.scene + " " + variant;
}

EnergyFacts energy_of(const Study& study, const std::string& backend) {
  EnergyFacts facts;
  std::vector<double> drifts;
  for (const Problem& problem : study.problems) {
    const ResultRow* row = study.representative(problem, backend);
    if (!row || !row->completed()) continue;
    if (const MetricResult* metric = row->metric("energy_drift"); metric && metric->scored() && metric->error) {
      drifts.push_back(*metric->error);
      if (!facts.drift_row || *metric->error > facts.worst_drift) {
        facts.worst_drift = *metric->error;
        facts.drift_row = row;
        facts.gains = metric->value.value_or(0) > 0;
      }
    }
    if (const MetricResult* metric = row->metric("energy_injected"); metric && metric->scored() && metric->error) {
      ++facts.injections;
      if (!facts.injection_row || *metric->error > facts.worst_injection) {
        facts.worst_injection = *metric->error;
        facts.injection_row = row;
      }
    }
  }
  facts.drifts = drifts.size();
  facts.median_drift = median(drifts).value_or(0);
  return facts;
}

Statement energy_statement(const EnergyFacts& facts) {
  if (facts.drifts == 0 && facts.injections == 0) return {};
  std::string text;
  if (facts.drifts > 0) {
    text = facts.worst_drift <= conserving
               ? fmt::format("keeps it within {} in all {} runs of scenes that conserve it",
                             percent_text(facts.worst_drift), facts.drifts)
               : fmt::format("{} up to {} ({}); half of {} runs stay within {}", facts.gains ? "gains" : "loses",
                             percent_text(facts.worst_drift), row_title(*facts.drift_row), facts.drifts,
                             percent_text(facts.median_drift));
  }
  if (facts.injections > 0 && facts.worst_injection > injecting) {
    text += fmt::format("{}makes energy: up to {} of the largest there is ({})", text.empty() ? "" : "; ",
                        percent_text(facts.worst_injection), row_title(*facts.injection_row));
  } else if (facts.injections > 0) {
    text += fmt::format("{}makes no more than {} of it in {}", text.empty() ? "" : "; ",
                        percent_text(facts.worst_injection),
                        facts.injections == 1 ? "one run" : fmt::format("any of {} runs", facts.injections));
  }
  return {text, facts.drift_row && facts.worst_drift > conserving ? facts.drift_row : facts.injection_row};
}

FrictionFacts friction_of(const Study& study, const std::string& backend) {
  FrictionFacts facts;
  const auto spread = [](const ResultRow* row) -> std::optional<double> {
    const MetricResult* metric = row && row->completed() ? row->metric("spread") : nullptr;
    return metric && row->slug == "sliding-stop" ? metric->error : std::nullopt;
  };
  for (const Problem& problem : study.problems) {
    const ResultRow* usual = study.representative(problem, backend);
    if (const auto value = spread(usual); value && (!facts.row || *value > facts.spread)) {
      facts.row = usual;
      facts.spread = *value;
    }
    for (const ResultRow* row : problem.rows) {
      const auto value = row->backend == backend ? spread(row) : std::nullopt;
      if (!value || (facts.best_row && *value >= facts.best_spread)) continue;
      facts.best_row = row;
      facts.best_spread = *value;
    }
  }
  return facts;
}

std::vector<const CostLine*> never_reached(const std::vector<CostLine>& costs, const std::string& backend,
                                           std::size_t target) {
  std::vector<const CostLine*> never;
  over_tests(costs, backend, [&](const CostLine& mine, LineIterator first, LineIterator last) {
    if (mine.at[target] || mine.contended) return;
    if (std::any_of(first, last, [&](const CostLine& line) { return line.at[target].has_value(); }))
      never.push_back(&mine);
  });
  return never;
}

std::vector<Beaten> beaten_at(const std::vector<CostLine>& costs, const std::string& backend, std::size_t target) {
  std::vector<Beaten> out;
  over_tests(costs, backend, [&](const CostLine& mine, LineIterator first, LineIterator last) {
    if (!mine.at[target]) return;
    const CostLine* cheapest = &mine;
    for (LineIterator line = first; line != last; ++line) {
      if (line->at[target] && line->at[target]->ms < cheapest->at[target]->ms) cheapest = &*line;
    }
    if (cheapest != &mine) out.push_back({&mine, cheapest, mine.at[target]->ms / cheapest->at[target]->ms});
  });
  std::stable_sort(out.begin(), out.end(), [](const Beaten& a, const Beaten& b) { return a.factor > b.factor; });
  return out;
}

}  // namespace plumb::harness
