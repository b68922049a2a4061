// Every run as data: the table of all, the details of each, and what a hover says of it where a figure leads to it.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "base/format.hpp"
#include "report/page/sections/sections.hpp"

namespace plumb::harness {
namespace {

/// Objects that many rows share, stored once.
class Pool {
 public:
  std::size_t index_of(const Json& value) {
    const auto [at, is_new] = indices_.try_emplace(value_text(value), indices_.size());
    if (is_new) values_.push_back(value);
    return at->second;
  }
  [[nodiscard]] const Json& values() const { return values_; }

 private:
  std::map<std::string, std::size_t> indices_;
  Json values_ = Json::array();
};

Json number(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

/// Eight digits: one more than the page shows, and half of what a double may take.
Json short_digits(const std::optional<double>& value) {
  return value ? Json::parse(fmt::format("{:.8g}", *value)) : Json();
}

/// What all runs of a scene share about a metric stands in the pool.
Json metric_data(const MetricResult& metric, Pool& metrics) {
  const char* verdict = !metric.scored()             ? ""
                        : metric.is_gold             ? "gold"
                        : metric.pass.value_or(true) ? "pass"
                                                     : "failed";
  const std::size_t shared = metrics.index_of(Json::array(
      {metric.name, metric.unit, number(metric.truth), number(metric.threshold), number(metric.gold), metric.note}));
  return Json::array(
      {shared, short_digits(metric.value), short_digits(metric.error), short_digits(metric.unbiased_error), verdict});
}

Json row_data(const PageContext& context, const Row& row, Pool& settings, Pool& machines, Pool& shared_metrics) {
  Json metrics = Json::array();
  for (const MetricResult& metric : row.metrics) metrics.push_back(metric_data(metric, shared_metrics));
  Json changed = Json::array();
  for (const auto& [name, value] : context.ordered.changed_settings(row)) changed.push_back(name);
  Json phases = Json::array();
  for (const auto& [name, ms] : row.time.phase_ms) phases.push_back({name, ms});
  const MetricResult* worst = row.completed() ? row.worst() : nullptr;
  const std::string decided =
      worst             ? fmt::format("{} {}", worst->name, worst->error ? short_number(*worst->error) : "not finite")
      : row.completed() ? std::string()
                        : row.reason;
  Json data = {{"engine", context.backend_index(row.backend)},
               {"title", problem_title(row)},
               {"configuration", context.ordered.configuration(row)},
               {"verdict", verdict_title(row.verdict())},
               {"decided", decided},
               {"metrics", metrics},
               {"settings", settings.index_of(row.settings)},
               {"changed", changed},
               {"command", context.ordered.command(row)},
               {"hash", row.hash},
               {"date", row.origin.date},
               {"reason", row.reason},
               {"contended", row.time.why_contended()},
               {"band", row.time.ci95 ? Json::array({row.time.ci95->low, row.time.ci95->high}) : Json()},
               {"machine", machines.index_of(row.origin.machine)},
               {"phases", phases},
               {"times",
                {number(row.time.median_ms), number(row.time.min_ms), number(row.time.max_ms), number(row.time.p99_ms),
                 number(row.time.setup_ms), number(row.time.steps), number(row.time.window_first),
                 number(row.time.window_last)}},
               {"counts",
                {number(row.counts.bodies), number(row.counts.contacts_max), number(row.counts.dropped),
                 number(row.counts.nonfinite), number(row.counts.peak_mb)}}};
  if (row.time.restarted.value_or(0) > 0) data["restarted"] = *row.time.restarted;
  return data;
}

}  // namespace

PageSection rows_section(const PageContext& context) {
  PageSection section{"runs", "Every run", ""};
  std::string words =
      "Open a line for its metrics, the settings in force, the state hash, the machine, and the command that runs it "
      "again. Decided by: the metric that comes closest to its threshold or exceeds it most, and its error.";
  if (std::any_of(context.ordered.rows.begin(), context.ordered.rows.end(),
                  [](const Row& row) { return row.time.contended.has_value(); }))
    words += " A time in parentheses was measured while the machine had other work, and counts nowhere.";
  section.words = about(words);
  Pool settings, machines, metrics;
  std::vector<Json> rows(context.ordered.rows.size());
  const std::size_t first = context.ordered.rows.empty() ? 0 : context.ordered.rows.front().origin.index;
  Json order = Json::array();
  for (const Problem& problem : context.ordered.problems) {
    const std::string key = filter_key(context, problem);
    std::vector<const Row*> ordered = problem.rows;
    std::stable_sort(ordered.begin(), ordered.end(), [&](const Row* a, const Row* b) {
      return context.backend_index(a->backend) < context.backend_index(b->backend);
    });
    for (const Row* row : ordered) {
      Json data = row_data(context, *row, settings, machines, metrics);
      data["k"] = key;
      rows[row->origin.index - first] = std::move(data);
      order.push_back(row->origin.index - first);
    }
  }
  section.blocks.push_back({{"runs",
                             {{"first", first},
                              {"order", std::move(order)},
                              {"settings", settings.values()},
                              {"machines", machines.values()},
                              {"metrics", metrics.values()},
                              {"rows", std::move(rows)}}}});
  return section;
}

}  // namespace plumb::harness
