#include "rows/result_row.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>

#include "base/format.hpp"

namespace plumb::harness {
namespace {

constexpr std::array<std::string_view, verdict_count> verdict_words{
    "gold", "pass", "ran", "failed", "unsupported", "unjudged", "crashed", "timeout", "out_of_memory", "error"};

const Json& member(const Json& object, const char* key) {
  static const Json none;
  if (!object.is_object()) return none;
  const auto found = object.find(key);
  return found == object.end() ? none : *found;
}

std::string text(const Json& object, const char* key) {
  const Json& value = member(object, key);
  return value.is_string() ? value.get<std::string>() : value.is_null() ? std::string() : value_text(value);
}

std::optional<double> as_number(const Json& value) {
  if (!value.is_number()) return std::nullopt;
  const double number = value.get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

std::optional<double> number(const Json& object, const char* key) { return as_number(member(object, key)); }

Json object_or_empty(const Json& value) { return value.is_object() ? value : Json::object(); }

std::string params_text(const Json& params, bool with_seed) {
  std::string out;
  for (const auto& [name, value] : params.items()) {
    if (name == "seed" && !with_seed) continue;
    if (!out.empty()) out += ' ';
    out += name + "=" + value_text(value);
  }
  return out;
}

/// Times over repetitions, and what spoilt them; lines of older programs have none of it.
void parse_repetitions(ResultRow& row, const Json& line) {
  const Json& time = member(line, "time");
  if (const Json& runs = member(time, "runs"); runs.is_array()) {
    for (const Json& run : runs) {
      if (const auto ms = as_number(run)) row.runs_ms.push_back(*ms);
    }
  }
  if (const Json& band = member(time, "ci95"); band.is_array() && band.size() == 2) {
    const auto low = as_number(band[0]), high = as_number(band[1]);
    if (low && high && *low <= *high) row.ci95 = Interval{*low, *high};
  }
  row.restarted = number(line, "restarted").value_or(0);
  if (const Json& contended = member(line, "contended"); !contended.is_null() && contended != Json(false))
    row.contended = contended.is_object() ? text(contended, "why") : value_text(contended);
}

MetricResult parse_metric(const std::string& name, const Json& from) {
  MetricResult metric;
  metric.name = name;
  metric.unit = text(from, "unit");
  metric.note = text(from, "note");
  metric.value = number(from, "value");
  metric.truth = number(from, "truth");
  metric.error = number(from, "error");
  metric.unbiased_error = number(from, "unbiased_error");
  metric.threshold = number(from, "threshold");
  metric.gold = number(from, "gold");
  if (const Json& pass = member(from, "pass"); pass.is_boolean()) metric.pass = pass.get<bool>();
  // A scored error that is not finite misses whatever it is held against.
  if (!metric.pass && metric.threshold) metric.pass = metric.error && *metric.error <= *metric.threshold;
  if (const Json& gold = member(from, "gold"); gold.is_boolean()) metric.is_gold = gold.get<bool>();
  if (metric.gold) metric.is_gold = metric.error && *metric.error <= *metric.gold;
  return metric;
}

}  // namespace

std::string_view verdict_word(Verdict verdict) { return verdict_words[static_cast<std::size_t>(verdict)]; }

std::optional<double> MetricResult::badness() const {
  const std::optional<double> limit = threshold ? threshold : gold;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (!limit) {
    if (!pass) return std::nullopt;
    return *pass ? 0 : infinite;
  }
  if (!error) return infinite;
  if (*limit > 0) return *error / *limit;
  return *error > *limit ? infinite : 0;
}

Verdict ResultRow::verdict() const {
  for (const Verdict verdict :
       {Verdict::unsupported, Verdict::unjudged, Verdict::crashed, Verdict::timeout, Verdict::out_of_memory}) {
    if (status == verdict_word(verdict)) return verdict;
  }
  if (!completed()) return Verdict::error;
  bool scored = false, gold = false, all_gold = true, passed = status == "ok";
  for (const MetricResult& metric : metrics) {
    if (!metric.scored()) continue;
    scored = true;
    if (metric.pass && !*metric.pass) passed = false;
    gold = gold || metric.is_gold;
    all_gold = all_gold && (metric.is_gold || !metric.gold);
  }
  if (!passed) return Verdict::failed;
  if (!scored) return Verdict::ran;
  return gold && all_gold ? Verdict::gold : Verdict::pass;
}

const MetricResult* ResultRow::worst() const {
  const MetricResult* worst = nullptr;
  for (const MetricResult& metric : metrics) {
    if (metric.badness() && (!worst || *metric.badness() > *worst->badness())) worst = &metric;
  }
  return worst;
}

const MetricResult* ResultRow::metric(std::string_view name) const {
  for (const MetricResult& metric : metrics) {
    if (metric.name == name) return &metric;
  }
  return nullptr;
}

std::optional<double> ResultRow::ms_per_simulated_second() const {
  const std::optional<double> ms = fair_ms();
  if (!ms || !dt || *ms <= 0 || *dt <= 0) return std::nullopt;
  return *ms / *dt;
}

std::string ResultRow::missed() const {
  if (passes()) return "";
  std::vector<const MetricResult*> misses;
  for (const MetricResult& metric : metrics) {
    if (completed() && metric.scored() && !metric.pass.value_or(true)) misses.push_back(&metric);
  }
  std::stable_sort(misses.begin(), misses.end(),
                   [](const auto* a, const auto* b) { return a->badness().value_or(0) > b->badness().value_or(0); });
  std::string out;
  for (const MetricResult* metric : misses) {
    out += (out.empty() ? "" : ", ") + metric->name;
    const bool is_question = metric->threshold == 0.0 && metric->error == 1.0;
    if (!metric->error) out += " not finite";
    if (metric->error && metric->threshold && !is_question)
      out += " " + short_number(*metric->error) + " > " + limit_text(*metric->threshold);
  }
  if (out.empty()) out = reason.empty() ? std::string(verdict_word(verdict())) : reason;
  return out;
}

bool ResultRow::completed() const { return status == "ok" || status == "failed"; }

std::string ResultRow::variant() const { return params_text(params, true); }

std::string ResultRow::problem_variant() const { return params_text(params, false); }

ResultRow parse_row(const Json& line, std::size_t index) {
  ResultRow row;
  row.index = index;
  row.scene = text(line, "scene");
  row.group = text(line, "group");
  row.backend = text(line, "backend");
  row.backend_version = text(line, "backend_version");
  row.profile = text(line, "profile");
  row.status = text(line, "status");
  row.reason = text(line, "reason");
  row.hash = text(line, "hash");
  row.slug = text(line, "slug");
  row.needs = text(line, "needs");
  row.params = object_or_empty(member(line, "params"));
  row.settings = object_or_empty(member(line, "settings"));
  row.tells_defaults = member(line, "defaults").is_object();
  row.defaults = object_or_empty(member(line, "defaults"));
  if (const Json& knobs = member(line, "knobs"); knobs.is_array()) {
    for (const Json& knob : knobs) {
      if (knob.is_string()) row.knobs.push_back(knob);
    }
  }
  row.machine = object_or_empty(member(line, "machine"));
  row.date = text(row.machine, "date");
  row.machine.erase("date");
  row.dt = number(line, "dt");
  row.seconds = number(line, "seconds");
  row.threads = number(line, "threads");
  row.repeats = number(line, "repeats");
  if (const Json& metrics = member(line, "metrics"); metrics.is_object()) {
    for (const auto& [name, metric] : metrics.items()) row.metrics.push_back(parse_metric(name, metric));
  }
  const Json& time = member(line, "time");
  const Json& per_step = member(time, "ms_per_step");
  row.median_ms = number(per_step, "median");
  row.min_ms = number(per_step, "min");
  row.max_ms = number(per_step, "max");
  row.p99_ms = number(per_step, "p99");
  if (const Json& window = member(time, "window"); window.is_array() && window.size() == 2) {
    row.window_first = as_number(window[0]);
    row.window_last = as_number(window[1]);
  }
  parse_repetitions(row, line);
  row.steps = number(time, "steps");
  row.setup_ms = number(time, "setup_ms");
  if (const Json& phases = member(time, "phase_ms"); phases.is_object()) {
    for (const auto& [name, ms] : phases.items()) {
      if (const auto value = as_number(ms)) row.phase_ms.emplace_back(name, *value);
    }
  }
  const Json& counts = member(line, "counts");
  row.bodies = number(counts, "bodies");
  row.contacts_max = number(counts, "contacts_max");
  row.dropped = number(counts, "dropped");
  row.nonfinite = number(counts, "nonfinite");
  row.peak_mb = number(line, "peak_mb");
  if (row.status.empty()) {
    row.status = "error";
    if (row.reason.empty()) row.reason = "the line in the results has no status";
  }
  return row;
}

std::vector<ResultRow> parse_rows(const std::vector<Json>& lines) {
  std::vector<ResultRow> rows;
  rows.reserve(lines.size());
  for (const Json& line : lines) rows.push_back(parse_row(line, rows.size()));
  return rows;
}

bool natural_less(std::string_view a, std::string_view b) {
  const auto digit = [](char c) { return c >= '0' && c <= '9'; };
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    if (digit(a[i]) && digit(b[j])) {
      const auto run = [&](std::string_view s, std::size_t& at) {
        while (at < s.size() && s[at] == '0') ++at;
        const std::size_t first = at;
        while (at < s.size() && digit(s[at])) ++at;
        return s.substr(first, at - first);
      };
      const std::string_view x = run(a, i), y = run(b, j);
      if (x.size() != y.size()) return x.size() < y.size();
      if (x != y) return x < y;
    } else {
      if (a[i] != b[j]) return a[i] < b[j];
      ++i, ++j;
    }
  }
  if (i < a.size() || j < b.size()) return i == a.size();
  return a < b;  // "01" and "1" read alike, yet are two names
}

std::string value_text(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  if (value.is_number_float()) return shortest_number(value.get<double>());
  return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace plumb::harness
