#include "report/ordered/against.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "base/format.hpp"

namespace plumb::harness {
namespace {

constexpr double smallest_error = 1e-12;  ///< what is below is rounding of one engine or the other

/// What was asked for, as text. Settings at the engine's own values were not; lines of older programs do not tell.
std::string asked_for(const Row& row) {
  Json settings = row.settings;
  if (row.engine.tells_defaults) {
    settings = Json::object();
    for (const auto& [name, usual] : row.engine.defaults.items()) {
      if (row.settings.contains(name)) settings[name] = row.settings[name];
    }
  }
  const std::string profile = row.profile.empty() ? "default" : row.profile,
                    needs = row.needs.empty() ? "scene" : row.needs;
  return value_text(Json::array({row.scene, row.params, row.backend, profile, needs, row.dt.value_or(0),
                                 row.seconds.value_or(0), row.threads.value_or(0), settings}));
}

bool repeats_itself(const Row& row) {
  const MetricResult* metric = row.metric("determinism");
  return !metric || metric->error.value_or(1) == 0;
}

bool moved(double a, double b, double share) {
  const double distance = std::abs(a - b);
  return distance > share * std::max(std::abs(a), std::abs(b)) && distance > smallest_error;
}

std::string arrow(const std::string& from, const std::string& to) { return from + " \u2192 " + to; }

std::string plain_verdict(const Row& row) {
  std::string word(verdict_word(row.verdict()));
  std::replace(word.begin(), word.end(), '_', ' ');
  return word;
}

void compare_verdicts(CellChange& cell) {
  const Verdict a = cell.before->verdict(), b = cell.after->verdict();
  if (a == b) return;
  const bool unscored = a == Verdict::ran || b == Verdict::ran;
  const bool unjudged = a == Verdict::unjudged || b == Verdict::unjudged;
  const bool comparable = !unjudged && (!unscored || !cell.before->completed() || !cell.after->completed());
  const Sense sense = !comparable ? Sense::changed : b > a ? Sense::worse : Sense::better;
  std::string text = arrow(plain_verdict(*cell.before), plain_verdict(*cell.after));
  if (!cell.after->completed() && !cell.after->reason.empty()) text += ": " + cell.after->reason;
  cell.changes.push_back({sense, "result", std::nullopt, std::nullopt, text});
}

/// 0 where it is gold, 1 where it passes, 2 where it does not.
int mark(const MetricResult& metric) { return metric.is_gold ? 0 : metric.pass.value_or(true) ? 1 : 2; }

void compare_metric(CellChange& cell, const MetricResult& a, const MetricResult& b, const AgainstLimits& limits,
                    bool repeats) {
  const bool scored = a.scored() && b.scored();
  std::string text =
      b.name + " " +
      arrow(a.error ? short_number(*a.error) : "not finite", b.error ? short_number(*b.error) : "not finite");
  if (a.error && b.error && short_number(*a.error) == short_number(*b.error))
    text = b.name + " " + arrow(shortest_number(*a.error), shortest_number(*b.error));
  if (b.threshold) text += ", threshold " + limit_text(*b.threshold);
  const auto add = [&](Sense sense) { cell.changes.push_back({sense, b.name, a.error, b.error, text}); };
  const auto direction = [&](bool worse) { return !scored ? Sense::changed : worse ? Sense::worse : Sense::better; };
  if (a.error.has_value() != b.error.has_value()) return add(direction(a.error.has_value()));
  if (!a.error) return;
  if (a.threshold != b.threshold || a.gold != b.gold) {
    text += a.threshold ? ", which was " + limit_text(*a.threshold) : ", which is new";
    return add(Sense::changed);
  }
  if (scored && mark(a) != mark(b)) return add(direction(mark(b) > mark(a)));
  if (repeats && moved(*a.error, *b.error, limits.error)) add(direction(*b.error > *a.error));
}

void compare_metrics(CellChange& cell, const AgainstLimits& limits, bool repeats) {
  if (!cell.before->completed() || !cell.after->completed()) return;
  for (const MetricResult& after : cell.after->metrics) {
    const MetricResult* before = cell.before->metric(after.name);
    if (after.name == "determinism") {
      // Without a threshold, and yet no matter of taste.
      if (before && before->error && after.error && *before->error != *after.error) {
        const bool lost = *after.error > *before->error;
        cell.changes.push_back({lost ? Sense::worse : Sense::better, after.name, before->error, after.error,
                                lost ? "no longer the same bits when run again" : "the same bits when run again"});
      }
    } else if (before) {
      compare_metric(cell, *before, after, limits, repeats);
    } else if (after.scored()) {
      cell.changes.push_back({Sense::changed, after.name, std::nullopt, after.error, after.name + " is new"});
    }
  }
  for (const MetricResult& before : cell.before->metrics) {
    if (before.scored() && !cell.after->metric(before.name))
      cell.changes.push_back({Sense::changed, before.name, before.error, std::nullopt, before.name + " is gone"});
  }
}

std::optional<Interval> spread_of(const Row& row) {
  if (row.time.ci95) return row.time.ci95;
  if (row.time.runs_ms.size() < 2) return std::nullopt;
  const auto [low, high] = std::minmax_element(row.time.runs_ms.begin(), row.time.runs_ms.end());
  return Interval{*low, *high};
}

void compare_times(CellChange& cell, const AgainstLimits& limits) {
  const double a = *cell.before->fair_ms(), b = *cell.after->fair_ms();
  if (!(a > 0) || !(b > 0)) return;
  const std::optional<Interval> before = spread_of(*cell.before), after = spread_of(*cell.after);
  const double change = b / a - 1;
  // A halving and a doubling are equally far.
  const double share = std::max(b / a, a / b) - 1;
  const bool beyond = before && after ? !before->overlaps(*after) && share > limits.time : share > limits.single_time;
  if (!beyond) return;
  cell.changes.push_back({b > a ? Sense::worse : Sense::better, "time", a, b,
                          fmt::format("time {} ms ({}{:.0f} %)", arrow(short_number(a), short_number(b)),
                                      change > 0 ? "+" : "\u2212", std::abs(100 * change))});
}

void compare_states(CellChange& cell, bool repeats) {
  const std::string &a = cell.before->hash, &b = cell.after->hash;
  if (repeats && cell.changes.empty() && !a.empty() && !b.empty() && a != b)
    cell.changes.push_back({Sense::changed, "state", std::nullopt, std::nullopt, "other bits at the end"});
}

/// Whether the times of the pair may be held against each other; counts why not.
bool times_compare(Comparison& comparison, const Row& before, const Row& after) {
  if (!before.completed() || !after.completed() || !before.time.median_ms || !after.time.median_ms) return false;
  const std::string a = hardware_of(before.origin.machine), b = hardware_of(after.origin.machine);
  if (a != b) {
    if (comparison.other_machine++ == 0) {
      comparison.machine_before = a;
      comparison.machine_after = b;
    }
    return false;
  }
  if (before.time.contended || after.time.contended) {
    ++comparison.contended;
    return false;
  }
  ++comparison.times;
  return true;
}

}  // namespace

std::string_view sense_word(Sense sense) {
  return sense == Sense::worse ? "worse" : sense == Sense::better ? "better" : "changed";
}

std::string hardware_of(const Json& machine) {
  std::string out;
  for (const char* name : {"cpu", "cores", "gpu", "device"}) {
    const auto found = machine.find(name);
    if (found == machine.end() || found->is_null()) continue;
    out +=
        (out.empty() ? "" : ", ") + (found->is_string() ? found->get<std::string>() : value_text(*found) + " " + name);
  }
  return out.empty() && !machine.empty() ? value_text(machine) : out;
}

std::size_t Comparison::count(Sense sense) const {
  return static_cast<std::size_t>(
      std::count_if(cells.begin(), cells.end(), [&](const CellChange& cell) { return cell.sense == sense; }));
}

Comparison compare_results(const std::vector<Row>& before, const std::vector<Row>& after, const AgainstLimits& limits) {
  Comparison comparison;
  std::map<std::string, const Row*> earlier;
  for (const Row& row : before) earlier[asked_for(row)] = &row;
  std::map<std::string, const Row*> unmatched = earlier;
  for (const Row& row : after) {
    const std::string key = asked_for(row);
    const auto found = earlier.find(key);
    if (found == earlier.end()) {
      comparison.only_after.push_back(&row);
      continue;
    }
    unmatched.erase(key);
    ++comparison.both;
    CellChange cell{found->second, &row, Sense::changed, {}};
    const bool repeats = repeats_itself(*cell.before) && repeats_itself(row);
    comparison.noisy += !repeats;
    compare_verdicts(cell);
    compare_metrics(cell, limits, repeats);
    if (times_compare(comparison, *cell.before, row)) compare_times(cell, limits);
    compare_states(cell, repeats);
    for (const Sense sense : {Sense::better, Sense::worse}) {
      const bool any = std::any_of(cell.changes.begin(), cell.changes.end(),
                                   [&](const Change& change) { return change.sense == sense; });
      if (any) cell.sense = sense;
    }
    if (!cell.changes.empty()) comparison.cells.push_back(std::move(cell));
  }
  for (const Row& row : before) {
    const auto found = unmatched.find(asked_for(row));
    if (found != unmatched.end() && found->second == &row) comparison.only_before.push_back(&row);
  }
  std::stable_sort(comparison.cells.begin(), comparison.cells.end(),
                   [](const CellChange& a, const CellChange& b) { return a.sense < b.sense; });
  return comparison;
}

}  // namespace plumb::harness
