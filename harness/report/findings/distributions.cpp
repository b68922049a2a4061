#include "report/findings/distributions.hpp"

#include <algorithm>

#include "report/ordered/default_run.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {
namespace {

constexpr std::size_t fewest_seeds = 3;

/// The seeds that a backend ran with at its defaults; empty where it did not.
std::vector<const Row*> seeds_at_defaults(const OrderedRows& ordered, const Problem& problem,
                                          const std::string& backend) {
  const Row* representative = default_run(ordered, problem, backend);
  if (!representative) return {};
  for (Sample& sample : samples_of(problem, backend)) {
    if (std::find(sample.rows.begin(), sample.rows.end(), representative) != sample.rows.end())
      return std::move(sample.rows);
  }
  return {};
}

/// Metrics by name, in order of appearance, of runs that came through.
std::vector<const MetricResult*> metrics_of(const std::vector<std::vector<const Row*>>& seeds) {
  std::vector<const MetricResult*> metrics;
  for (const auto& rows : seeds) {
    for (const Row* row : rows) {
      if (!row->completed()) continue;
      for (const MetricResult& metric : row->metrics) {
        const bool known =
            std::any_of(metrics.begin(), metrics.end(), [&](const auto* other) { return other->name == metric.name; });
        if (!known && (metric.scored() || (metric.value && !metric.truth))) metrics.push_back(&metric);
      }
    }
  }
  return metrics;
}

DistributionCell cell_of(const std::vector<const Row*>& rows, const MetricResult& like) {
  DistributionCell cell;
  cell.runs = rows.size();
  std::vector<double> numbers;
  const Row *largest = nullptr, *without = nullptr;
  for (const Row* row : rows) {
    const MetricResult* metric = row->completed() ? row->metric(like.name) : nullptr;
    const std::optional<double> number = !metric ? std::nullopt : like.scored() ? metric->error : metric->value;
    cell.passed += metric && like.scored() && metric->pass.value_or(false);
    if (!number) {
      without = row;
      continue;
    }
    if (!cell.most || *number > *cell.most) largest = row;
    cell.most = std::max(cell.most.value_or(*number), *number);
    cell.least = std::min(cell.least.value_or(*number), *number);
    numbers.push_back(*number);
  }
  cell.median = median(numbers);
  cell.row = without ? without : largest;
  return cell;
}

}  // namespace

std::vector<DistributionLine> distributions(const OrderedRows& ordered) {
  std::vector<DistributionLine> lines;
  for (const Problem& problem : ordered.problems) {
    std::vector<std::vector<const Row*>> seeds;
    bool any = false;
    for (const std::string& backend : ordered.backends) {
      seeds.push_back(seeds_at_defaults(ordered, problem, backend));
      if (seeds.back().size() < fewest_seeds) seeds.back().clear();
      any = any || !seeds.back().empty();
    }
    if (!any) continue;
    for (const MetricResult* metric : metrics_of(seeds)) {
      std::vector<const Row*> all;
      for (const auto& rows : seeds) all.insert(all.end(), rows.begin(), rows.end());
      DistributionLine line{&problem, metric->name, metric->unit, metric->scored(), is_yes_or_no(all, metric->name),
                            {}};
      for (const auto& rows : seeds)
        line.cells.push_back(rows.empty() ? std::nullopt : std::optional(cell_of(rows, *metric)));
      lines.push_back(std::move(line));
    }
  }
  return lines;
}

}  // namespace plumb::harness
