#include "cell/metric_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace plumb::harness {

namespace {

std::optional<double> if_finite(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? value : std::nullopt;
}

const MetricSpec* find_spec(const std::vector<MetricSpec>& specs, const std::string& name) {
  const auto found =
      std::find_if(specs.begin(), specs.end(), [&](const MetricSpec& spec) { return spec.name == name; });
  return found == specs.end() ? nullptr : &*found;
}

MetricResult result_of(const Metric& metric, const MetricSpec* spec) {
  MetricResult result;
  result.name = metric.name;
  result.note = metric.note;
  result.value = if_finite(metric.value);
  result.truth = if_finite(metric.truth);
  result.error = if_finite(metric.error);
  result.unbiased_error = if_finite(metric.unbiased_error);
  result.tells_unbiased_error = metric.unbiased_error.has_value();
  if (spec == nullptr) return result;
  result.unit = spec->unit;
  result.threshold = spec->threshold;
  result.gold = spec->gold;
  if (spec->threshold) result.pass = metric.error <= *spec->threshold;  // false for NaN
  if (spec->gold) result.is_gold = metric.error <= *spec->gold;
  return result;
}

/// In place of an earlier one of the name.
void put(std::vector<MetricResult>& results, MetricResult result) {
  const auto same = std::find_if(results.begin(), results.end(),
                                 [&](const MetricResult& other) { return other.name == result.name; });
  if (same == results.end()) {
    results.push_back(std::move(result));
  } else {
    *same = std::move(result);
  }
}

bool has(const std::vector<MetricResult>& results, const std::string& name) {
  return std::any_of(results.begin(), results.end(), [&](const MetricResult& result) { return result.name == name; });
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
    MetricResult result = result_of(metric, spec);
    const bool missed = result.pass == false;
    put(judgement.metrics, std::move(result));
    if (!missed) continue;
    if (std::isnan(metric.error)) {
      say_silent(judgement, metric.name);
    } else {
      judgement.missed.push_back(fmt::format("{} {:.4g} > {:.4g}", metric.name, metric.error, *spec->threshold));
    }
  }
  for (MetricSpec spec : specs) {
    if (has(judgement.metrics, spec.name)) continue;
    // What may be left out and was is not scored: no report is to take it for a miss.
    if (spec.optional) spec.threshold = spec.gold = std::nullopt;
    const Metric absent{spec.name, NAN, std::nullopt, NAN, std::nullopt, "not measured"};
    put(judgement.metrics, result_of(absent, &spec));
    if (spec.threshold) say_silent(judgement, spec.name);
  }
  return judgement;
}

}  // namespace plumb::harness
