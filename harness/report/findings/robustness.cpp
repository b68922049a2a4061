#include "report/findings/robustness.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "report/ordered/default_run.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {

double robustness_bound(std::string_view metric) {
  struct Bound {
    std::string_view beginning;
    double bound;
  };
  // A hundredth of whatever the measure is relative to, or of a metre, is what one sees; momentum has no excuse.
  constexpr Bound bounds[]{{"determinism", 0}, {"momentum", 1e-3}, {"angular_momentum", 1e-3}};
  for (const Bound& known : bounds) {
    if (metric.starts_with(known.beginning)) return known.bound;
  }
  return 1e-2;
}

namespace {

/// Problems of those that the backend was run on, and can run.
std::size_t runs_tried(const OrderedRows& ordered, const std::set<const Problem*>& problems,
                       const std::string& backend) {
  return static_cast<std::size_t>(std::count_if(problems.begin(), problems.end(), [&](const Problem* problem) {
    const Row* row = default_run(ordered, *problem, backend);
    return row && !says_nothing(row->verdict());
  }));
}

}  // namespace

std::vector<RobustnessLine> robustness(const OrderedRows& ordered) {
  struct Found {
    std::set<std::string> scenes;  // that do not score it
    std::string unit;
    std::set<const Problem*> problems;
    std::map<std::string, std::vector<std::pair<double, const Row*>>> errors;  // by backend
  };
  std::map<std::string, Found> by_name;
  for (const Problem& problem : ordered.problems) {
    for (const std::string& backend : ordered.backends) {
      const Row* row = default_run(ordered, problem, backend);
      if (!row || !row->completed()) continue;
      for (const MetricResult& metric : row->metrics) {
        Found& found = by_name[metric.name];
        if (!metric.error || (metric.truth != 0 && metric.truth != 1)) continue;
        if (!metric.scored()) found.scenes.insert(row->scene);
        found.unit = metric.unit;
        found.problems.insert(&problem);
        found.errors[backend].emplace_back(*metric.error, row);
      }
    }
  }
  std::vector<RobustnessLine> lines;
  for (const auto& [name, found] : by_name) {
    if (found.scenes.size() < 2) continue;
    RobustnessLine line{name, found.unit, robustness_bound(name), {}};
    for (const std::string& backend : ordered.backends) {
      const auto of = found.errors.find(backend);
      if (of == found.errors.end()) {
        line.cells.emplace_back();
        continue;
      }
      RobustnessCell cell;
      std::vector<double> errors;
      for (const auto& [error, row] : of->second) {
        errors.push_back(error);
        cell.beyond += error > line.bound;
        if (!cell.row || error > cell.worst) {
          cell.worst = error;
          cell.row = row;
        }
      }
      cell.runs = errors.size();
      cell.lost = runs_tried(ordered, found.problems, backend) - cell.runs;
      cell.median = *median(errors);
      line.cells.emplace_back(cell);
    }
    lines.push_back(std::move(line));
  }
  return lines;
}

}  // namespace plumb::harness
