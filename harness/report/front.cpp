#include "report/front.hpp"

#include <algorithm>

namespace plumb::harness {

Front pareto_front(const Problem& problem, const std::string& metric, std::vector<FrontPoint> points) {
  Front front{&problem, metric, {}, {}};
  std::stable_sort(points.begin(), points.end(), [](const FrontPoint& a, const FrontPoint& b) {
    return a.ms != b.ms ? a.ms < b.ms : a.error < b.error;
  });
  for (FrontPoint& point : points) {
    const bool equal =
        !front.best.empty() && front.best.back().ms == point.ms && front.best.back().error == point.error;
    if (front.best.empty() || point.error < front.best.back().error || equal) {
      front.best.push_back(std::move(point));
      continue;
    }
    // Errors fall along the front, so that the first one as exact is the cheapest of those.
    const auto by = std::find_if(front.best.begin(), front.best.end(),
                                 [&](const FrontPoint& best) { return best.error <= point.error; });
    front.others.push_back({std::move(point), static_cast<std::size_t>(by - front.best.begin())});
  }
  return front;
}

std::vector<Front> pareto_fronts(const Study& study) {
  std::vector<Front> fronts;
  for (const Problem& problem : study.problems) {
    const Questions questions(study.scored_metrics(problem), problem);
    const std::vector<Sample> samples = samples_of(problem, "");
    for (const std::string& metric : questions.graded()) {
      std::vector<FrontPoint> points;
      for (const Sample& sample : samples) {
        const std::optional<Measured> error = sample.error(metric), cost = sample.cost();
        if (error && cost && !questions.missed_by(sample)) points.push_back({sample, cost->value, error->value});
      }
      if (!points.empty()) fronts.push_back(pareto_front(problem, metric, std::move(points)));
    }
  }
  return fronts;
}

}  // namespace plumb::harness
