#include "report/text/csv.hpp"

#include <ostream>

#include "base/format.hpp"
#include "rows/result_row.hpp"

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

void write_csv(std::ostream& out, const std::vector<Json>& rows) {
  out << header;
  for (const ResultRow& row : parse_rows(rows)) {
    std::string head, tail;
    const auto add = [](std::string& line, const std::string& field) { line += field + ","; };
    for (const std::string& text :
         {row.scene, row.group, row.variant(), row.backend, row.backend_version, row.profile, row.needs}) {
      add(head, csv_field(text));
    }
    for (const auto& value : {row.dt, row.seconds, row.threads}) add(head, number_field(value));
    for (const std::string& text : {row.status, std::string(verdict_word(row.verdict())), row.reason}) {
      add(head, csv_field(text));
    }
    for (const auto& value :
         {row.median_ms, row.min_ms, row.max_ms, row.p99_ms, row.ms_per_simulated_second(), row.steps, row.setup_ms}) {
      add(tail, number_field(value));
    }
    add(tail, csv_field(row.contended.value_or("")));
    for (const auto& value : {row.bodies, row.contacts_max, row.dropped, row.nonfinite, row.peak_mb})
      add(tail, number_field(value));
    add(tail, csv_field(row.hash));
    add(tail, json_field(row.params));
    add(tail, json_field(row.settings));
    tail += json_field(row.machine) + "\n";

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
