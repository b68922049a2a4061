#include "report/text/csv.hpp"

#include <ostream>

#include "base/format.hpp"
#include "rows/row.hpp"

namespace plumb::harness {
namespace {

std::string number_field(const std::optional<double>& value) { return value ? shortest_number(*value) : ""; }

std::string json_field(const Json& value) {
  return csv_field(value.dump(-1, ' ', false, Json::error_handler_t::replace));
}

std::string truth_field(const std::optional<bool>& value) { return value ? *value ? "true" : "false" : ""; }

constexpr const char* header =
    "scene,group,variant,backend,backend_version,profile,needs,dt,seconds,threads,status,verdict,reason,"
    "metric,value,unit,truth,error,unbiased_error,threshold,gold,pass,is_gold,note,"
    "ms_per_step_median,ms_per_step_min,ms_per_step_max,ms_per_step_p99,ms_per_simulated_second,steps,setup_ms,"
    "contended,bodies,contacts_max,dropped,nonfinite,peak_mb,hash,params,settings,machine\n";

}  // namespace

std::string csv_field(std::string_view text) {
  const bool formula = !text.empty() && std::string_view("=+-@\t\r").find(text.front()) != std::string_view::npos;
  std::string plain(formula ? 1 : 0, '\'');
  plain += text;
  if (plain.find_first_of(",\"\r\n") == std::string::npos) return plain;
  std::string quoted = "\"";
  for (const char c : plain) {
    quoted += c;
    if (c == '"') quoted += c;
  }
  return quoted + '"';
}

void write_csv(std::ostream& out, const std::vector<Row>& rows) {
  out << header;
  for (const Row& row : rows) {
    std::string head, tail;
    const auto add = [](std::string& line, const std::string& field) { line += field + ","; };
    for (const std::string& text :
         {row.scene, row.group, row.variant(), row.backend, row.engine.version, row.profile, row.needs}) {
      add(head, csv_field(text));
    }
    for (const auto& value : {row.dt, row.seconds, row.threads}) add(head, number_field(value));
    for (const std::string& text : {row.status, std::string(verdict_word(row.verdict())), row.reason}) {
      add(head, csv_field(text));
    }
    for (const auto& value : {row.time.median_ms, row.time.min_ms, row.time.max_ms, row.time.p99_ms,
                              row.ms_per_simulated_second(), row.time.steps, row.time.setup_ms}) {
      add(tail, number_field(value));
    }
    add(tail, csv_field(row.time.why_contended()));
    for (const auto& value :
         {row.counts.bodies, row.counts.contacts_max, row.counts.dropped, row.counts.nonfinite, row.counts.peak_mb})
      add(tail, number_field(value));
    add(tail, csv_field(row.hash));
    add(tail, json_field(row.params));
    add(tail, json_field(row.settings));
    tail += json_field(row.origin.machine) + "\n";

    for (const MetricResult& metric : row.metrics) {
      out << head << csv_field(metric.name) << ',' << number_field(metric.value) << ',' << csv_field(metric.unit) << ','
          << number_field(metric.truth) << ',' << number_field(metric.error) << ','
          << number_field(metric.unbiased_error) << ',' << number_field(metric.threshold) << ','
          << number_field(metric.gold) << ',' << truth_field(metric.pass) << ','
          << truth_field(metric.scored() ? std::optional(metric.is_gold) : std::nullopt) << ','
          << csv_field(metric.note) << ',' << tail;
    }
    if (row.metrics.empty()) out << head << std::string(11, ',') << tail;
  }
}

}  // namespace plumb::harness
