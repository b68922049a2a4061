#include "report/ordered/sample.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "base/format.hpp"
#include "plumb/assert.hpp"
#include "report/ordered/ordered_rows.hpp"

namespace plumb::harness {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// All that must be equal for rows to be one sample: what was asked for, without the seed.
std::string configuration_key(const Row& row) {
  return value_text(
      Json::array({row.problem_variant(), row.backend, row.engine.version, row.profile, row.needs, row.dt.value_or(0),
                   row.seconds.value_or(0), row.threads.value_or(0), row.settings, row.origin.machine}));
}

}  // namespace

bool Sample::passes() const {
  PLUMB_ASSERT(!rows.empty());
  const auto passed = std::count_if(rows.begin(), rows.end(), [](const Row* row) { return row->passes(); });
  return 2 * static_cast<std::size_t>(passed) >= rows.size();
}

std::optional<Measured> Sample::cost() const {
  std::vector<double> all;
  std::optional<Interval> band;
  for (const Row* row : rows) {
    if (row->time.contended) return std::nullopt;
    const std::optional<double> ms = row->ms_per_simulated_second();
    if (!ms) continue;
    all.push_back(*ms);
    if (row->time.ci95) band = Interval{row->time.ci95->low / *row->dt, row->time.ci95->high / *row->dt};
  }
  if (all.empty()) return std::nullopt;
  if (all.size() == 1) return Measured{all.front(), band};
  return Measured{*median(all), median_interval(all)};
}

std::optional<Measured> Sample::error(const std::string& metric) const {
  std::vector<double> all;
  bool known = false;
  for (const Row* row : rows) {
    const MetricResult* result = row->completed() ? row->metric(metric) : nullptr;
    known = known || (result && result->error);
    all.push_back(result && result->error ? *result->error : infinite);
  }
  if (!known) return std::nullopt;
  const double middle = *median(all);
  if (!std::isfinite(middle)) return std::nullopt;
  if (all.size() == 1) return Measured{middle, std::nullopt};
  const auto [low, high] = std::minmax_element(all.begin(), all.end());
  return Measured{middle, Interval{*low, *high}};
}

std::vector<Sample> samples_of(const Problem& problem, const std::string& backend) {
  std::vector<Sample> samples;
  std::unordered_map<std::string, std::size_t> places;
  for (const Row* row : problem.rows) {
    if (!row->own_needs() || (!backend.empty() && row->backend != backend)) continue;
    // Without a seed nothing is a distribution: rows that are equal in all else stay apart.
    if (!row->params.contains("seed")) {
      samples.push_back({{row}});
      continue;
    }
    const auto [place, is_new] = places.try_emplace(configuration_key(*row), samples.size());
    if (is_new) samples.emplace_back();
    samples[place->second].rows.push_back(row);
  }
  // Whoever names a sample names its first row.
  for (Sample& sample : samples) {
    std::stable_partition(sample.rows.begin(), sample.rows.end(),
                          [passes = sample.passes()](const Row* row) { return row->passes() == passes; });
  }
  return samples;
}

Questions::Questions(const std::vector<std::string>& scored_metrics, const Problem& problem) {
  for (const std::string& metric : scored_metrics) {
    const bool measured = std::any_of(problem.rows.begin(), problem.rows.end(), [&](const Row* row) {
      return row->metric(metric) && row->metric(metric)->error;
    });
    if (!measured) continue;
    (is_yes_or_no(problem.rows, metric) ? asked_ : graded_).push_back(metric);
  }
}

std::string Questions::missed_by(const Row& row) const {
  std::string out;
  for (const std::string& name : asked_) {
    const MetricResult* metric = row.metric(name);
    if (metric && !metric->pass.value_or(true)) out += (out.empty() ? "" : ", ") + name;
  }
  return out;
}

bool Questions::missed_by(const Sample& sample) const {
  const auto missed =
      std::count_if(sample.rows.begin(), sample.rows.end(), [&](const Row* row) { return !missed_by(*row).empty(); });
  return 2 * static_cast<std::size_t>(missed) > sample.rows.size();
}

bool Questions::counts(const Sample& sample, const std::string& metric) const {
  return std::find(asked_.begin(), asked_.end(), metric) != asked_.end() || !missed_by(sample);
}

bool is_yes_or_no(const std::vector<const Row*>& rows, const std::string& metric) {
  bool answered = false;
  for (const Row* row : rows) {
    const MetricResult* result = row->completed() ? row->metric(metric) : nullptr;
    if (!result || !result->error) continue;
    if (*result->error != 0 && *result->error != 1) return false;
    answered = true;
  }
  return answered;
}

}  // namespace plumb::harness
