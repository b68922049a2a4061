#include "report/cost.hpp"

namespace plumb::harness {
namespace {

CostLine find_costs(const Problem& problem, const std::string& metric_name, const std::string& backend,
                    const ResultRow* representative) {
  CostLine line{&problem, metric_name, backend, {}, {}, representative};
  for (const ResultRow* row : problem.rows) {
    if (row->backend != backend || !row->completed()) continue;
    const MetricResult* metric = row->metric(metric_name);
    const std::optional<double> ms = row->ms_per_simulated_second();
    if (!metric || !metric->error || !ms) continue;
    const Reached reached{row, *ms, *metric->error};
    for (std::size_t t = 0; t < target_errors.size(); ++t) {
      if (reached.error <= target_errors[t] && (!line.at[t] || reached.ms < line.at[t]->ms)) line.at[t] = reached;
    }
    const bool closer = !line.floor || reached.error < line.floor->error ||
                        (reached.error == line.floor->error && reached.ms < line.floor->ms);
    if (closer) line.floor = reached;
  }
  return line;
}

}  // namespace

std::vector<CostLine> cost_of_accuracy(const Study& study) {
  std::vector<CostLine> lines;
  for (const Problem& problem : study.problems) {
    for (const std::string& metric : study.scored_metrics(problem)) {
      for (const std::string& backend : study.backends) {
        const ResultRow* representative = study.representative(problem, backend);
        if (representative) lines.push_back(find_costs(problem, metric, backend, representative));
      }
    }
  }
  return lines;
}

}  // namespace plumb::harness
