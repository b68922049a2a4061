#include "report/findings/duel.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "base/format.hpp"
#include "report/ordered/against.hpp"
#include "report/ordered/counted_error.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// What two rows must share to be held against each other.
std::string match_key(const Row& row) {
  return value_text(Json::array(
      {hardware_of(row.origin.machine), row.scene, row.params, row.dt.value_or(0), row.seconds.value_or(0)}));
}

/// 0 gold, 1 passes, 2 fails, 3 does not come through.
int level(const Row& row) {
  if (!row.completed()) return 3;
  return row.verdict() == Verdict::gold ? 0 : row.passes() ? 1 : 2;
}

/// The error as it counts.
double counted(const MetricResult* metric) {
  if (!metric || !metric->error) return infinite;
  return counted_error(*metric->error, *metric);
}

void compare(DuelMetric& metric) {
  const double a = counted(metric.of[0]), b = counted(metric.of[1]);
  metric.ahead = b < a ? 1 : 0;
  const double smaller = std::min(a, b), larger = std::max(a, b);
  // A limit of zero leaves no room between right and wrong.
  metric.factor = larger == smaller ? 1 : smaller > 0 ? larger / smaller : infinite;
}

/// Of the metrics on which the pair's winner is ahead the one with the largest factor, `counts` willing.
template <class Counts>
const DuelMetric* most_telling(const std::vector<DuelMetric>& metrics, std::size_t ahead, const Counts& counts) {
  const DuelMetric* best = nullptr;
  for (const DuelMetric& metric : metrics) {
    const MetricResult* loser = metric.of[1 - ahead];
    if (metric.ahead != ahead || metric.factor <= 1 || !loser || !counts(*loser)) continue;
    if (!best || metric.factor > best->factor) best = &metric;
  }
  return best;
}

DuelFinding by_verdicts(const DuelPair& pair, const std::vector<DuelMetric>& metrics) {
  const int a = level(*pair.rows[0]), b = level(*pair.rows[1]);
  DuelFinding finding{pair, Apart::verdict, a < b ? 0u : 1u, "", infinite};
  const Row& loser = *pair.rows[1 - finding.ahead];
  const bool fails = pair.rows[finding.ahead]->passes() && !loser.passes();
  if (fails) finding.apart = Apart::passes;
  if (!loser.completed()) return finding;
  const DuelMetric* metric = most_telling(metrics, finding.ahead, [&](const MetricResult& missed) {
    return fails ? !missed.pass.value_or(true) : !missed.is_gold;
  });
  if (metric) {
    finding.metric = metric->name;
    finding.factor = metric->factor;
  }
  return finding;
}

std::optional<DuelFinding> by_errors(const DuelPair& pair, const std::vector<DuelMetric>& metrics) {
  if (!pair.rows[0]->completed()) return std::nullopt;
  const auto best = std::max_element(metrics.begin(), metrics.end(),
                                     [](const DuelMetric& a, const DuelMetric& b) { return a.factor < b.factor; });
  if (best == metrics.end() || best->factor < telling_factor) return std::nullopt;
  return DuelFinding{pair, pair.rows[0]->passes() ? Apart::error : Apart::wrong, best->ahead, best->name, best->factor};
}

std::optional<DuelFinding> finding_of(const DuelPair& pair) {
  const std::vector<DuelMetric> metrics = duel_metrics(pair);
  if (level(*pair.rows[0]) != level(*pair.rows[1])) return by_verdicts(pair, metrics);
  return by_errors(pair, metrics);
}

bool tells_more(const DuelFinding& a, const DuelFinding& b) {
  return std::tuple(a.apart, -a.factor) < std::tuple(b.apart, -b.factor);
}

void add_times(Duel& duel, const std::vector<DuelPair>& pairs) {
  std::vector<double> factors;
  for (const DuelPair& pair : pairs) {
    if (const std::optional<double> factor = time_factor_of(pair)) factors.push_back(*factor);
  }
  duel.timed = factors.size();
  duel.time_factor = median(factors);
}

void sort_out(Duel& duel, const std::vector<DuelPair>& pairs) {
  std::map<std::string, std::size_t> places;
  for (const DuelPair& pair : pairs) {
    const bool silent_a = says_nothing(pair.rows[0]->verdict()), silent_b = says_nothing(pair.rows[1]->verdict());
    if (silent_a || silent_b) {
      (silent_a && silent_b ? duel.neither : duel.one_only).push_back(pair);
      continue;
    }
    std::optional<DuelFinding> finding = finding_of(pair);
    if (!finding) {
      duel.alike.push_back(pair);
      continue;
    }
    const auto [place, is_new] = places.try_emplace(pair.rows[0]->scene, duel.apart.size());
    if (is_new) {
      duel.apart.push_back({std::move(*finding), {}});
      continue;
    }
    DuelScene& scene = duel.apart[place->second];
    if (tells_more(*finding, scene.best)) std::swap(*finding, scene.best);
    scene.others.push_back(std::move(*finding));
  }
}

}  // namespace

std::string DuelPair::title() const {
  const std::string variant = rows[0]->variant();
  return variant.empty() ? rows[0]->scene : rows[0]->scene + " " + variant;
}

std::string_view apart_text(Apart apart) {
  switch (apart) {
    case Apart::passes: return "one passes, the other does not";
    case Apart::verdict: return "their verdicts differ";
    case Apart::error: return "both pass, with other errors";
    case Apart::wrong: break;
  }
  return "both fail, one by more";
}

std::vector<DuelMetric> duel_metrics(const DuelPair& pair) {
  std::vector<DuelMetric> metrics;
  for (const Row* row : pair.rows) {
    for (const MetricResult& metric : row->metrics) {
      const bool known = std::any_of(metrics.begin(), metrics.end(),
                                     [&](const DuelMetric& other) { return other.name == metric.name; });
      if (!metric.scored() || known) continue;
      metrics.push_back(
          {metric.name, metric.unit, {pair.rows[0]->metric(metric.name), pair.rows[1]->metric(metric.name)}});
      compare(metrics.back());
    }
  }
  return metrics;
}

std::optional<double> time_factor_of(const DuelPair& pair) {
  if (!pair.rows[0]->completed() || !pair.rows[1]->completed()) return std::nullopt;
  const std::optional<double> a = pair.rows[0]->fair_ms(), b = pair.rows[1]->fair_ms();
  if (!a || !b || *a <= 0 || *b <= 0) return std::nullopt;
  return *b / *a;
}

Duel duel_of(const std::array<std::string, 2>& names, const std::vector<Row>& first, const std::vector<Row>& second) {
  Duel duel;
  duel.names = names;
  std::map<std::string, const Row*> theirs;
  for (const Row& row : second) theirs[match_key(row)] = &row;
  std::vector<DuelPair> pairs;
  for (const Row& row : first) {
    const auto match = theirs.find(match_key(row));
    if (match == theirs.end()) {
      duel.without_match.push_back(&row);
      continue;
    }
    pairs.push_back({{&row, match->second}});
    theirs.erase(match);
  }
  for (const Row& row : second) {
    if (theirs.contains(match_key(row))) duel.without_match.push_back(&row);
  }
  std::stable_sort(pairs.begin(), pairs.end(), [](const DuelPair& a, const DuelPair& b) {
    return natural_less(a.rows[0]->scene, b.rows[0]->scene);
  });
  duel.pairs = pairs.size();
  add_times(duel, pairs);
  sort_out(duel, pairs);
  for (DuelScene& scene : duel.apart) {
    std::stable_sort(scene.others.begin(), scene.others.end(), tells_more);
    ++duel.ahead[scene.best.ahead];
  }
  std::stable_sort(duel.apart.begin(), duel.apart.end(),
                   [](const DuelScene& a, const DuelScene& b) { return tells_more(a.best, b.best); });
  return duel;
}

}  // namespace plumb::harness
