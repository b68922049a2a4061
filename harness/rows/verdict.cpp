// What a row is worth.
#include "rows/verdict.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include "base/format.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

namespace {

constexpr std::array<std::string_view, verdict_count> verdict_words{
    "gold", "pass", "ran", "failed", "unsupported", "unjudged", "crashed", "timeout", "out_of_memory", "error"};

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

Verdict Row::verdict() const {
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

const MetricResult* Row::worst() const {
  const MetricResult* worst = nullptr;
  for (const MetricResult& metric : metrics) {
    if (metric.badness() && (!worst || *metric.badness() > *worst->badness())) worst = &metric;
  }
  return worst;
}

std::string Row::missed() const {
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

}  // namespace plumb::harness
