#include "schedule/row_of_cell.hpp"

#include <algorithm>
#include <numeric>
#include <optional>
#include <set>

#include "plumb/assert.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {

namespace {

// From good to bad; a row says the worst that happened.
int badness(const std::string& status) {
  static const std::vector<std::string> order{"ok",    "failed",        "unjudged", "unsupported",
                                              "error", "out_of_memory", "timeout",  "crashed"};
  const auto at = std::find(order.begin(), order.end(), status);
  PLUMB_ASSERT(at != order.end());
  return static_cast<int>(at - order.begin());
}

std::string status_of(const Answer& answer) {
  return answer.status == "ok" ? answer.json.value("status", "error") : answer.status;
}
std::string reason_of(const Answer& answer) {
  return answer.status == "ok" ? answer.json.value("reason", "") : answer.reason;
}

Json part_of(const Answer& answer, const char* key, Json otherwise) {
  return answer.json.is_object() && answer.json.contains(key) ? answer.json[key] : std::move(otherwise);
}

// Nearest rank (median: the upper of two).
std::optional<double> percentile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return std::nullopt;
  PLUMB_ASSERT(share >= 0 && share <= 1 && std::is_sorted(sorted.begin(), sorted.end()));
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(rank, sorted.size() - 1)];
}

std::optional<double> number_of(const Answer& answer, const char* key) {
  const Json value = part_of(answer, key, nullptr);
  return value.is_number() ? std::optional(value.get<double>()) : std::nullopt;
}

std::vector<double> sorted_steps(const Answer& answer) {
  std::vector<double> steps;
  for (const Json& ms : part_of(answer, "step_ms", Json::array())) {
    if (ms.is_number()) steps.push_back(ms.get<double>());
  }
  std::sort(steps.begin(), steps.end());
  return steps;
}

/// Repetitions that met a busy machine say nothing of the engine's time, where there are calm ones.
std::vector<const Answer*> timed(const std::vector<Answer>& answers) {
  std::vector<const Answer*> calm, all;
  for (const Answer& answer : answers) {
    all.push_back(&answer);
    if (!answer.contended) calm.push_back(&answer);
  }
  return calm.empty() ? all : calm;
}

std::optional<Contention> worst_contention(const std::vector<Answer>& answers) {
  std::optional<Contention> worst;
  for (const Answer* answer : timed(answers)) {
    if (answer->contended && (!worst || answer->contended->load > worst->load)) worst = answer->contended;
  }
  return worst;
}

RowTime time_of(const std::vector<Answer>& answers, const Answer& chosen) {
  RowTime time;
  std::vector<double> steps, setups;
  for (const Answer* answer : timed(answers)) {
    const std::vector<double> mine = sorted_steps(*answer);
    steps.insert(steps.end(), mine.begin(), mine.end());
    if (const auto setup = number_of(*answer, "setup_ms")) setups.push_back(*setup);
  }
  std::sort(steps.begin(), steps.end());
  std::sort(setups.begin(), setups.end());
  time.median_ms = percentile(steps, 0.5);
  time.min_ms = percentile(steps, 0);
  time.max_ms = percentile(steps, 1);
  time.p99_ms = percentile(steps, 0.99);
  time.runs_ms = medians_of_runs(answers);
  time.ci95 = log_normal_interval(time.runs_ms);
  time.wall_s = std::accumulate(answers.begin(), answers.end(), 0.0,
                                [](double sum, const Answer& answer) { return sum + answer.wall_seconds; });
  if (const Json window = part_of(chosen, "window", Json::array()); window.size() == 2) {
    time.window_first = window[0].get<double>();
    time.window_last = window[1].get<double>();
  }
  time.steps = number_of(chosen, "steps").value_or(0);
  time.setup_ms = percentile(setups, 0.5);
  const Json phases = part_of(chosen, "phase_ms", Json::object());
  for (const auto& [phase, ms] : phases.items()) time.phase_ms.emplace_back(phase, ms.get<double>());
  time.repeats = static_cast<double>(answers.size());
  time.restarted =
      static_cast<double>(std::count_if(answers.begin(), answers.end(), [](const Answer& a) { return a.restarted; }));
  time.contended = worst_contention(answers);
  return time;
}

RowCounts counts_of(const std::vector<Answer>& answers, const Answer& chosen) {
  RowCounts counts;
  const Json told = part_of(chosen, "counts", Json::object());
  const auto count = [&](const char* key) {
    const auto found = told.find(key);
    return found != told.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
  };
  counts.bodies = count("bodies");
  counts.contacts_max = count("contacts_max");
  counts.dropped = count("dropped");
  counts.nonfinite = count("nonfinite");
  for (const Answer& answer : answers) {
    const auto mb = number_of(answer, "peak_mb");
    if (mb && (!counts.peak_mb || *mb > *counts.peak_mb)) counts.peak_mb = mb;
  }
  return counts;
}

void note_determinism(std::vector<MetricResult>& metrics, const std::vector<Answer>& answers) {
  std::set<std::string> hashes;
  std::size_t complete = 0;
  for (const Answer& answer : answers) {
    const Json hash = part_of(answer, "hash", "");
    if (!hash.is_string() || hash == "") continue;
    hashes.insert(hash.get<std::string>());
    ++complete;
  }
  if (complete < 2) return;
  const bool same = hashes.size() == 1;
  MetricResult metric;
  metric.name = "determinism";
  metric.unit = "1";
  metric.value = same ? 1 : 0;
  metric.truth = 1;
  metric.error = same ? 0 : 1;
  metric.whole = true;
  metric.note = "final states of " + std::to_string(complete) + " repetitions with " + std::to_string(hashes.size()) +
                (same ? " hash" : " different hashes");
  metrics.push_back(std::move(metric));
}

// What a world of the cell starts with: it stands for the settings in force where none came to be.
Json settings_at_start(const Cell& cell) {
  Json settings = Json::object();
  for (const SettingDescription& setting : cell.backend->settings) settings[setting.name] = setting.default_value;
  settings.update(cell.settings);
  return settings;
}

// The engine's own values of those settings that are not at them: with the settings in force, all of its defaults.
Json defaults_left(const Cell& cell, const Json& settings) {
  Json left = Json::object();
  for (const SettingDescription& setting : cell.backend->settings) {
    if (settings[setting.name] != setting.default_value) left[setting.name] = setting.default_value;
  }
  return left;
}

RowEngine engine_of(const Cell& cell, const Json& settings) {
  RowEngine engine{cell.backend->version, cell.backend->build, defaults_left(cell, settings), {}, true};
  for (const SettingDescription& setting : cell.backend->settings) {
    if (setting.role == "quality") engine.knobs.push_back(setting.name);
  }
  return engine;
}

RowOrigin origin_of(const Cell& cell, const Json& machine) {
  RowOrigin origin;
  origin.cell = cell_id(cell);
  origin.machine = machine;
  origin.date = machine.value("date", "");
  origin.machine.erase("date");
  return origin;
}

}  // namespace

std::vector<double> medians_of_runs(const std::vector<Answer>& answers) {
  std::vector<double> runs;
  for (const Answer* answer : timed(answers)) {
    if (const auto middle = percentile(sorted_steps(*answer), 0.5)) runs.push_back(*middle);
  }
  return runs;
}

Row make_row(const Cell& cell, const std::vector<Answer>& answers, const Json& machine) {
  PLUMB_ASSERT(!answers.empty());
  const Answer& chosen = *std::max_element(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) {
    return badness(status_of(a)) < badness(status_of(b));
  });
  Row row;
  row.scene = cell.scene->id;
  row.slug = cell.scene->slug;
  row.group = cell.scene->group;
  row.params = json_of(cell.shown);
  row.backend = cell.backend->name;
  row.settings = settings_at_start(cell);
  row.settings.update(part_of(chosen, "settings", Json::object()));
  row.profile = cell.profile;
  row.needs = cell.needs;
  row.dt = cell.dt;
  row.seconds = cell.seconds;
  row.threads = cell.threads;
  row.status = status_of(chosen);
  row.reason = reason_of(chosen);
  row.hash = part_of(chosen, "hash", "").get<std::string>();
  row.metrics = parse_metrics(part_of(chosen, "metrics", Json::object()));
  note_determinism(row.metrics, answers);
  row.engine = engine_of(cell, row.settings);
  row.time = time_of(answers, chosen);
  row.counts = counts_of(answers, chosen);
  row.origin = origin_of(cell, machine);
  return row;
}

}  // namespace plumb::harness
