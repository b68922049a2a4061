#include "study/row.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "rows/row_format.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {

namespace {

// From good to bad; a row says the worst that happened.
int badness(const std::string& status) {
  static const std::vector<std::string> order{"ok",    "failed",        "unjudged", "unsupported",
                                              "error", "out_of_memory", "timeout",  "crashed"};
  return static_cast<int>(std::find(order.begin(), order.end(), status) - order.begin());
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
Json percentile(const std::vector<double>& sorted, double share) {
  if (sorted.empty()) return nullptr;
  const auto rank = static_cast<std::size_t>(share * static_cast<double>(sorted.size()));
  return sorted[std::min(rank, sorted.size() - 1)];
}

// Repetitions that met a busy machine say nothing of the engine's time, where there are calm ones.
bool all_contended(const std::vector<Answer>& answers) {
  return std::none_of(answers.begin(), answers.end(), [](const Answer& a) { return a.contended.is_null(); });
}

Json worst_contention(const std::vector<Answer>& answers) {
  if (!all_contended(answers)) return nullptr;
  return std::max_element(answers.begin(), answers.end(),
                          [](const Answer& a, const Answer& b) {
                            return a.contended.value("load", 0.0) < b.contended.value("load", 0.0);
                          })
      ->contended;
}

Json confidence_of(const std::vector<double>& runs) {
  const std::optional<Interval> interval = log_normal_interval(runs);
  return interval ? Json::array({interval->low, interval->high}) : Json(nullptr);
}

Json time_of(const std::vector<Answer>& answers, const Answer& chosen) {
  std::vector<double> steps, setups;
  const bool none_calm = all_contended(answers);
  double wall = 0;
  for (const Answer& answer : answers) {
    wall += answer.wall_seconds;
    if (!answer.contended.is_null() && !none_calm) continue;
    for (const Json& ms : part_of(answer, "step_ms", Json::array())) {
      if (ms.is_number()) steps.push_back(ms.get<double>());
    }
    if (const Json setup = part_of(answer, "setup_ms", nullptr); setup.is_number())
      setups.push_back(setup.get<double>());
  }
  std::sort(steps.begin(), steps.end());
  std::sort(setups.begin(), setups.end());
  return {{"ms_per_step",
           {{"median", percentile(steps, 0.5)},
            {"min", percentile(steps, 0)},
            {"max", percentile(steps, 1)},
            {"p99", percentile(steps, 0.99)}}},
          {"runs", medians_of_runs(answers)},
          {"ci95", confidence_of(medians_of_runs(answers))},
          {"wall_s", wall},
          {"window", part_of(chosen, "window", Json::array())},
          {"steps", part_of(chosen, "steps", 0)},
          {"setup_ms", percentile(setups, 0.5)},
          {"phase_ms", part_of(chosen, "phase_ms", Json::object())}};
}

Json counts_of(const Answer& answer) {
  Json counts{{"bodies", nullptr}, {"contacts_max", nullptr}, {"dropped", nullptr}, {"nonfinite", nullptr}};
  counts.update(part_of(answer, "counts", Json::object()));
  return counts;
}

void note_determinism(Json& metrics, const std::vector<Answer>& answers) {
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
  metrics["determinism"] = {{"value", same ? 1 : 0}, {"unit", "1"},     {"truth", 1},     {"error", same ? 0 : 1},
                            {"threshold", nullptr},  {"gold", nullptr}, {"pass", nullptr}};
  metrics["determinism"]["note"] = "final states of " + std::to_string(complete) + " repetitions with " +
                                   std::to_string(hashes.size()) + (same ? " hash" : " different hashes");
}

Json peak_of(const std::vector<Answer>& answers) {
  Json peak = nullptr;
  for (const Answer& answer : answers) {
    const Json mb = part_of(answer, "peak_mb", nullptr);
    if (mb.is_number() && (peak.is_null() || mb.get<double>() > peak.get<double>())) peak = mb;
  }
  return peak;
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

// Settings that buy accuracy with time, by the backend's own word.
Json knobs_of(const Cell& cell) {
  Json knobs = Json::array();
  for (const SettingDescription& setting : cell.backend->settings) {
    if (setting.role == "quality") knobs.push_back(setting.name);
  }
  return knobs;
}

}  // namespace

std::vector<double> medians_of_runs(const std::vector<Answer>& answers) {
  const bool none_calm = all_contended(answers);
  std::vector<double> runs;
  for (const Answer& answer : answers) {
    if (!answer.contended.is_null() && !none_calm) continue;
    std::vector<double> steps;
    for (const Json& ms : part_of(answer, "step_ms", Json::array())) {
      if (ms.is_number()) steps.push_back(ms.get<double>());
    }
    std::sort(steps.begin(), steps.end());
    if (!steps.empty()) runs.push_back(percentile(steps, 0.5).get<double>());
  }
  return runs;
}

Json make_row(const Cell& cell, const std::vector<Answer>& answers, const Json& machine) {
  const Answer& chosen = *std::max_element(answers.begin(), answers.end(), [](const Answer& a, const Answer& b) {
    return badness(status_of(a)) < badness(status_of(b));
  });
  Json settings = settings_at_start(cell);
  settings.update(part_of(chosen, "settings", Json::object()));
  Json metrics = part_of(chosen, "metrics", Json::object());
  note_determinism(metrics, answers);
  return {{"format", row_format},
          {"scene", cell.scene->id},
          {"group", cell.scene->group},
          {"params", json_of(cell.shown)},
          {"backend", cell.backend->name},
          {"backend_version", cell.backend->version},
          {"settings", settings},
          {"profile", cell.profile},
          {"dt", cell.dt},
          {"seconds", cell.seconds},
          {"threads", cell.threads},
          {"status", status_of(chosen)},
          {"reason", reason_of(chosen)},
          {"metrics", metrics},
          {"time", time_of(answers, chosen)},
          {"counts", counts_of(chosen)},
          {"hash", part_of(chosen, "hash", "")},
          {"peak_mb", peak_of(answers)},
          {"machine", machine},
          {"contended", worst_contention(answers)},
          {"defaults", defaults_left(cell, settings)},
          {"knobs", knobs_of(cell)},
          {"slug", cell.scene->slug},
          {"needs", cell.needs},
          {"repeats", answers.size()},
          {"restarted", std::count_if(answers.begin(), answers.end(), [](const Answer& a) { return a.restarted; })},
          {"backend_build", cell.backend->build},
          {"cell", cell_id(cell)}};
}

}  // namespace plumb::harness
