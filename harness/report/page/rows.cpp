// Every run: one line each here; the script opens its details from the data that follows the table.
#include <fmt/format.h>

#include <map>

#include "report/format.hpp"
#include "report/page/markup.hpp"
#include "report/page/sections.hpp"

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

Json row_data(const PageContext& context, const ResultRow& row, Pool& settings, Pool& machines, Pool& shared_metrics) {
  Json metrics = Json::array();
  for (const MetricResult& metric : row.metrics) metrics.push_back(metric_data(metric, shared_metrics));
  Json changed = Json::array();
  for (const auto& [name, value] : context.study.changed_settings(row)) changed.push_back(name);
  Json phases = Json::array();
  for (const auto& [name, ms] : row.phase_ms) phases.push_back({name, ms});
  return {{"m", metrics},
          {"s", settings.index_of(row.settings)},
          {"d", changed},
          {"c", context.study.command(row)},
          {"h", row.hash},
          {"a", row.date},
          {"w", row.reason},
          {"o", row.contended.value_or("")},
          {"b", row.ci95 ? Json::array({row.ci95->low, row.ci95->high}) : Json()},
          {"x", machines.index_of(row.machine)},
          {"p", phases},
          {"t",
           {number(row.median_ms), number(row.min_ms), number(row.max_ms), number(row.p99_ms), number(row.setup_ms),
            number(row.steps), number(row.window_first), number(row.window_last)}},
          {"n",
           {number(row.bodies), number(row.contacts_max), number(row.dropped), number(row.nonfinite),
            number(row.peak_mb)}}};
}

std::string table_row(const PageContext& context, const Problem& problem, const ResultRow& row) {
  const MetricResult* worst = row.completed() ? row.worst() : nullptr;
  const Verdict verdict = row.verdict();
  std::string decided = row.completed() ? std::string() : row.reason;
  if (worst) decided = fmt::format("{} {}", worst->name, worst->error ? short_number(*worst->error) : "not finite");
  return fmt::format(
      R"(<tr id="r{}" class="e{}" {}><th scope="row"><button type="button">{}</button></th><td class="name">{}</td>)"
      R"(<td class="text">{}</td>)"
      R"(<td class="text" data-v="{}"><span class="chip {}">{}</span></td><td data-v="{}">{}</td><td class="text )"
      R"(why">{}</td></tr>)",
      row.index, context.backend_index(row.backend),
      filter_key(context, problem, fmt::format("{} {}", row.backend, verdict_title(verdict))),
      escape_html(problem.title()), backend_label(context, row.backend), escape_html(context.study.configuration(row)),
      static_cast<int>(verdict), verdict_word(verdict), escape_html(verdict_title(verdict)), row.median_ms.value_or(-1),
      row.contended ? "(" + short_number(row.median_ms) + ")" : short_number(row.median_ms), escape_html(decided));
}

}  // namespace

std::string rows_section(const PageContext& context) {
  std::string out =
      section_start(context, "runs", "Every run") +
      R"(<p class="about">Open a line for its metrics, the settings in force, )"
      R"(the state hash, the machine, and the )"
      R"(command that runs it again.</p><div class="scroll"><table class="numbers runs sortable"><thead><tr><th )"
      R"(scope="col" data-sort>scene</th>)"
      R"(<th scope="col" class="name" data-sort>backend</th><th scope="col" class="text" data-sort>configuration</th>)"
      R"(<th scope="col" class="text" data-sort>result</th><th scope="col" data-sort>ms per step</th><th )"
      R"(scope="col" class="text" data-sort>decided by</th></tr></thead><tbody>)";
  Pool settings, machines, metrics;
  std::vector<Json> data(context.study.rows.size());
  const std::size_t first = context.study.rows.empty() ? 0 : context.study.rows.front().index;
  for (const Problem& problem : context.study.problems) {
    for (const ResultRow* row : problem.rows) {
      out += table_row(context, problem, *row);
      data[row->index - first] = row_data(context, *row, settings, machines, metrics);
    }
  }
  out += "</tbody></table></div></section>";
  const Json all{
      {"settings", settings.values()}, {"machines", machines.values()}, {"metrics", metrics.values()}, {"rows", data}};
  return out + fmt::format(R"(<script type="application/json" class="data" data-first="{}">{}</script>)", first,
                           script_json(all));
}

}  // namespace plumb::harness
