#include "report/findings/front.hpp"

#include <algorithm>

#include "plumb/assert.hpp"

namespace plumb::harness {

Front pareto_front(const Problem& problem, const std::string& metric, std::vector<FrontPoint> points) {
  Front front{&problem, metric, {}, {}, 0};
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
    PLUMB_ASSERT(front.best.back().error <= point.error);
    // Errors fall along the front, so that the first one as exact is the cheapest of those.
    const auto by = std::find_if(front.best.begin(), front.best.end(),
                                 [&](const FrontPoint& best) { return best.error <= point.error; });
    front.others.push_back({std::move(point), static_cast<std::size_t>(by - front.best.begin())});
  }
  return front;
}

std::vector<Front> pareto_fronts(const OrderedRows& ordered) {
  std::vector<Front> fronts;
  for (const Problem& problem : ordered.problems) {
    const Questions questions(ordered.scored_metrics(problem), problem);
    const std::vector<Sample> samples = samples_of(problem, "");
    for (const std::string& metric : questions.graded()) {
      std::vector<FrontPoint> points;
      std::size_t untimed = 0;
      for (const Sample& sample : samples) {
        const std::optional<Measured> error = sample.error(metric), cost = sample.cost();
        if (!error || !sample.passes()) continue;
        if (cost) points.push_back({sample, cost->value, error->value});
        untimed += !cost;
      }
      if (points.empty()) continue;
      fronts.push_back(pareto_front(problem, metric, std::move(points)));
      fronts.back().untimed = untimed;
    }
  }
  return fronts;
}

bool says_something(const Front& front) {
  constexpr std::size_t fewest_points = 3;
  return front.untimed == 0 && front.best.size() + front.others.size() >= fewest_points;
}

FrontCount count_fronts(const std::vector<Front>& fronts, const std::string& backend) {
  const auto is_of = [&](const FrontPoint& point) { return point.sample.row().backend == backend; };
  FrontCount count;
  for (const Front& front : fronts) {
    if (!says_something(front)) continue;
    const bool on = std::any_of(front.best.begin(), front.best.end(), is_of);
    count.ran += on || std::any_of(front.others.begin(), front.others.end(),
                                   [&](const Dominated& other) { return is_of(other.point); });
    count.on += on;
    count.alone += std::all_of(front.best.begin(), front.best.end(), is_of);
    count.cheapest += is_of(front.best.front());
    count.most_exact += is_of(front.best.back());
  }
  return count;
}

}  // namespace plumb::harness
