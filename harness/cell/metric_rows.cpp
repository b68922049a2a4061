#include "cell/metric_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plumb::harness {

namespace {

Json number_or_null(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

const MetricSpec* find_spec(const std::vector<MetricSpec>& specs, const std::string& name) {
  const auto found =
      std::find_if(specs.begin(), specs.end(), [&](const MetricSpec& spec) { return spec.name == name; });
  return found == specs.end() ? nullptr : &*found;
}

Json row_of(const Metric& metric, const MetricSpec* spec) {
  Json row{{"value", metric.value},
           {"unit", spec == nullptr ? "" : spec->unit},
           {"truth", number_or_null(metric.truth)},
           {"error", metric.error},
           {"threshold", spec == nullptr ? Json(nullptr) : number_or_null(spec->threshold)},
           {"gold", spec == nullptr ? Json(nullptr) : number_or_null(spec->gold)},
           {"pass", nullptr}};
  if (spec != nullptr && spec->threshold) row["pass"] = metric.error <= *spec->threshold;  // false for NaN
  if (metric.unbiased_error) row["unbiased_error"] = *metric.unbiased_error;
  if (!metric.note.empty()) row["note"] = metric.note;
  return row;
}

void say_silent(Judgement& judgement, const std::string& metric) {
  judgement.silent.push_back(metric);
  judgement.missed.push_back(metric + " was not measured");
}

}  // namespace

Judgement judge(const std::vector<Metric>& metrics, const std::vector<MetricSpec>& specs,
                const std::vector<MetricSpec>& general) {
  Judgement judgement;
  for (const Metric& metric : metrics) {
    const MetricSpec* spec = find_spec(specs, metric.name);
    if (spec == nullptr) spec = find_spec(general, metric.name);
    const Json row = row_of(metric, spec);
    judgement.metrics[metric.name] = row;
    if (row["pass"] != false) continue;
    if (std::isnan(metric.error)) {
      say_silent(judgement, metric.name);
    } else {
      judgement.missed.push_back(fmt::format("{} {:.4g} > {:.4g}", metric.name, metric.error, *spec->threshold));
    }
  }
  for (MetricSpec spec : specs) {
    if (judgement.metrics.contains(spec.name)) continue;
    // What may be left out and was is not scored: no report is to take it for a miss.
    if (spec.optional) spec.threshold = spec.gold = std::nullopt;
    const Metric absent{spec.name, NAN, std::nullopt, NAN, std::nullopt, "not measured"};
    judgement.metrics[spec.name] = row_of(absent, &spec);
    if (spec.threshold) say_silent(judgement, spec.name);
  }
  return judgement;
}

}  // namespace plumb::harness
