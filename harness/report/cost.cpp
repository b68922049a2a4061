#include "report/cost.hpp"

#include <map>

namespace plumb::harness {
namespace {

CostLine find_costs(const Problem& problem, const std::string& metric, const std::string& backend,
                    const std::vector<Sample>& samples, const Questions& questions, const ResultRow* representative) {
  CostLine line{&problem, metric, backend, {}, {}, representative, false};
  bool any_error = false;
  for (const Sample& sample : samples) {
    const std::optional<Measured> error = sample.error(metric), cost = sample.cost();
    if (!error || !questions.counts(sample, metric)) continue;
    any_error = true;
    if (!cost) {
      line.contended = line.contended || sample.row().contended;
      continue;
    }
    const Reached reached{&sample.row(), cost->value, error->value, cost->band};
    for (std::size_t t = 0; t < target_errors.size(); ++t) {
      if (reached.error <= target_errors[t] && (!line.at[t] || reached.ms < line.at[t]->ms)) line.at[t] = reached;
    }
    const bool closer = !line.floor || reached.error < line.floor->error ||
                        (reached.error == line.floor->error && reached.ms < line.floor->ms);
    if (closer) line.floor = reached;
  }
  line.contended = line.contended && any_error && !line.floor;
  return line;
}

}  // namespace

std::vector<CostLine> cost_of_accuracy(const Study& study) {
  std::vector<CostLine> lines;
  for (const Problem& problem : study.problems) {
    const std::vector<std::string> metrics = study.scored_metrics(problem);
    const Questions questions(metrics, problem);
    std::map<std::string, std::vector<Sample>> samples;
    for (Sample& sample : samples_of(problem, "")) samples[sample.row().backend].push_back(std::move(sample));
    for (const std::string& metric : metrics) {
      for (const std::string& backend : study.backends) {
        const ResultRow* representative = study.representative(problem, backend);
        if (!representative) continue;
        lines.push_back(find_costs(problem, metric, backend, samples[backend], questions, representative));
      }
    }
  }
  return lines;
}

}  // namespace plumb::harness
