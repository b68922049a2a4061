#include "report/ordered/ordered_rows.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/format.hpp"
#include "plumb/assert.hpp"

namespace plumb::harness {
namespace {

/// The most frequent of the values; of several the favourite, else the first.
template <typename Value>
class Mode {
 public:
  void add(const std::string& key, const Value& value) {
    const auto [at, is_new] = counts_.try_emplace(key, 0, value);
    if (is_new) order_.push_back(key);
    ++at->second.first;
  }
  [[nodiscard]] Value best(const std::string& favourite = "") const {
    int most = 0;
    Value best{};
    for (const std::string& key : order_) {
      const auto& [count, value] = counts_.at(key);
      if (count > most || (count == most && key == favourite)) {
        most = count;
        best = value;
      }
    }
    return best;
  }

 private:
  std::map<std::string, std::pair<int, Value>> counts_;
  std::vector<std::string> order_;
};

std::string key_of(const std::optional<double>& value) { return value ? shortest_number(*value) : ""; }

bool same(const std::optional<double>& a, const std::optional<double>& b) {
  if (!a || !b) return a.has_value() == b.has_value();
  return *a == *b || std::abs(*a - *b) <= 1e-12 * std::abs(*b);
}

bool default_profile(const Row& row) { return row.profile.empty() || row.profile == "default"; }

Baseline find_baseline(const std::vector<const Row*>& rows) {
  Mode<Json> settings;
  Mode<std::optional<double>> dt, threads;
  std::map<std::string, Mode<std::optional<double>>> scene_dt;
  for (const Row* row : rows) {
    if (!row->settings.empty()) settings.add(value_text(row->settings), row->settings);
    if (row->dt) dt.add(key_of(row->dt), row->dt);
    if (row->dt) scene_dt[row->scene].add(key_of(row->dt), row->dt);
    if (row->threads) threads.add(key_of(row->threads), row->threads);
  }
  Baseline baseline;
  baseline.settings = settings.best().is_object() ? settings.best() : Json::object();
  const auto telling = std::find_if(rows.begin(), rows.end(), [](const Row* row) {
    return row->engine.tells_defaults && !row->settings.empty() && default_profile(*row);
  });
  if (telling != rows.end()) {
    baseline.settings = (*telling)->settings;
    baseline.settings.update((*telling)->engine.defaults);
  }
  const std::string usual_dt = key_of(dt.best());
  for (const auto& [scene, steps] : scene_dt) baseline.dt[scene] = steps.best(usual_dt);
  baseline.threads = threads.best();
  return baseline;
}

/// Variants in the order of their numbers, which their text does not have: 0.25 before 0.5.
bool variant_less(const Row& a, const Row& b) {
  for (auto x = a.params.begin(), y = b.params.begin(); x != a.params.end() && y != b.params.end(); ++x, ++y) {
    if (x.key() != y.key()) return natural_less(x.key(), y.key());
    if (*x == *y) continue;
    if (x->is_number() && y->is_number()) return *x < *y;
    return natural_less(value_text(*x), value_text(*y));
  }
  return a.params.size() < b.params.size();
}

}  // namespace

OrderedRows::OrderedRows(std::vector<Row> given) : rows(std::move(given)) {
  std::map<std::string, std::vector<const Row*>> by_backend, default_by_backend;
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> by_problem;
  for (const Row& row : rows) {
    by_backend[row.backend].push_back(&row);
    if (default_profile(row)) default_by_backend[row.backend].push_back(&row);
    const auto [at, is_new] = by_problem.try_emplace({row.scene, row.group, row.problem_variant()}, problems.size());
    if (is_new) problems.push_back({row.scene, row.group, row.problem_variant(), {}});
    problems[at->second].rows.push_back(&row);
  }
  for (const auto& [name, of_backend] : by_backend) {
    backends.push_back(name);
    const auto defaults = default_by_backend.find(name);
    baselines_[name] = find_baseline(defaults == default_by_backend.end() ? of_backend : defaults->second);
  }
  std::sort(backends.begin(), backends.end(), natural_less);
  std::stable_sort(problems.begin(), problems.end(), [](const Problem& a, const Problem& b) {
    return a.scene != b.scene ? natural_less(a.scene, b.scene) : variant_less(*a.rows.front(), *b.rows.front());
  });
  for (const Problem& problem : problems) {
    if (std::find(groups.begin(), groups.end(), problem.group) == groups.end()) groups.push_back(problem.group);
  }
  is_default_.reserve(rows.size());
  for (const Row& row : rows) is_default_.push_back(find_default(row));
}

bool OrderedRows::is_default(const Row& row) const {
  const auto place = static_cast<std::size_t>(&row - rows.data());
  PLUMB_ASSERT(place < is_default_.size());  // it is one of ours, and no copy
  return is_default_[place];
}

bool OrderedRows::find_default(const Row& row) const {
  const Baseline& baseline = baselines_.at(row.backend);
  const auto dt = baseline.dt.find(row.scene);
  return default_profile(row) && same(row.dt, dt == baseline.dt.end() ? std::nullopt : dt->second) &&
         same(row.threads, baseline.threads) && row.own_needs() && changed_settings(row).empty();
}

std::vector<std::pair<std::string, std::string>> OrderedRows::changed_settings(const Row& row) const {
  const Json& usual = baselines_.at(row.backend).settings;
  std::vector<std::pair<std::string, std::string>> changed;
  for (const auto& [name, value] : row.settings.items()) {
    const auto found = usual.find(name);
    if (found == usual.end() || *found != value) changed.emplace_back(name, value_text(value));
  }
  return changed;
}

std::string OrderedRows::configuration(const Row& row) const {
  std::string out = row.dt ? dt_text(row.dt) + " s" : std::string();
  const auto add = [&](const std::string& part) { out += (out.empty() ? "" : ", ") + part; };
  if (!default_profile(row)) add(row.profile);
  for (const auto& [name, value] : changed_settings(row)) add(name + " " + value);
  if (!row.own_needs()) add("needs " + row.needs);
  if (row.threads && !same(row.threads, baselines_.at(row.backend).threads)) {
    add(shortest_number(*row.threads) + (*row.threads == 1 ? " thread" : " threads"));
  }
  return out;
}

std::string OrderedRows::command_for(const Row& row, const std::vector<std::string>& backends_of_it) const {
  std::string out = "plumb run " + shell_word(row.scene);
  for (const std::string& backend : backends_of_it) out += " --backend " + shell_word(backend);
  for (const auto& [name, value] : row.params.items()) out += " --param " + shell_word(name + "=" + value_text(value));
  if (!default_profile(row)) out += " --profile " + shell_word(row.profile);
  for (const auto& [name, value] : changed_settings(row)) out += " --set " + shell_word(name + "=" + value);
  if (row.dt) out += " --dt " + shortest_number(*row.dt);
  if (row.seconds) out += " --seconds " + shortest_number(*row.seconds);
  if (row.threads) out += " --threads " + shortest_number(*row.threads);
  if (row.time.repeats && *row.time.repeats > 1) out += " --repeat " + shortest_number(*row.time.repeats);
  if (!row.own_needs()) out += " --needs " + shell_word(row.needs);
  return out;
}

std::string OrderedRows::command(const Row& row) const { return command_for(row, {row.backend}); }

std::string OrderedRows::commands(const std::vector<const Row*>& of) const {
  constexpr std::size_t most = 3;
  std::vector<std::pair<const Row*, std::vector<std::string>>> alike;
  std::map<std::string, std::size_t> places;
  for (const Row* row : of) {
    const auto [place, is_new] = places.try_emplace(command_for(*row, {}), alike.size());
    if (is_new) alike.push_back({row, {}});
    std::vector<std::string>& names = alike[place->second].second;
    if (std::find(names.begin(), names.end(), row->backend) == names.end()) names.push_back(row->backend);
  }
  // The commands that stand for the most backends first.
  std::stable_sort(alike.begin(), alike.end(),
                   [](const auto& a, const auto& b) { return a.second.size() > b.second.size(); });
  std::string out;
  for (std::size_t i = 0; i < std::min(most, alike.size()); ++i)
    out += (i == 0 ? "" : "\n") + command_for(*alike[i].first, alike[i].second);
  if (alike.size() > most) out += "\n# and " + std::to_string(alike.size() - most) + " more: each run tells its own";
  return out;
}

const Row* OrderedRows::representative(const Problem& problem, const std::string& backend) const {
  std::vector<const Row*> defaults, others;
  for (const Row* row : problem.rows) {
    if (row->backend == backend && row->own_needs()) (is_default(*row) ? defaults : others).push_back(row);
  }
  if (defaults.empty()) return others.empty() ? nullptr : others.front();
  if (!defaults.front()->params.contains("seed")) return defaults.front();
  std::stable_sort(defaults.begin(), defaults.end(),
                   [](const Row* a, const Row* b) { return a->verdict() < b->verdict(); });
  return defaults[defaults.size() / 2];
}

std::vector<std::string> OrderedRows::scored_metrics(const Problem& problem) const {
  std::vector<std::string> scored, with_error;
  const auto add = [](std::vector<std::string>& list, const std::string& name) {
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
  };
  for (const Row* row : problem.rows) {
    for (const MetricResult& metric : row->metrics) {
      if (metric.scored()) add(scored, metric.name);
      if (metric.error) add(with_error, metric.name);
    }
  }
  return scored.empty() ? with_error : scored;
}

std::string shell_word(const std::string& word) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
           std::string_view("_-./=:,+@%").find(c) != std::string_view::npos;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), plain)) return word;
  std::string out = "'";
  for (const char c : word) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace plumb::harness
