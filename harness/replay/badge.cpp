#include "replay/badge.hpp"

#include <fmt/format.h>

#include "base/format.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

namespace {

std::string nearest_to_its_limit(const Row& row, bool is_gold) {
  const MetricResult* nearest = nullptr;
  double share = -1;
  for (const MetricResult& metric : row.metrics) {
    const std::optional<double> limit = is_gold && metric.gold ? metric.gold : metric.threshold;
    if (!limit || !metric.error) continue;
    const double used = *limit > 0 ? *metric.error / *limit : 0;
    if (used <= share) continue;
    share = used;
    nearest = &metric;
  }
  if (nearest == nullptr) return "";
  const bool held_to_gold = is_gold && nearest->gold;
  const double limit = held_to_gold ? *nearest->gold : *nearest->threshold;
  const std::string error = short_number(*nearest->error), allowed = limit_text(limit);
  if (limit > 0)
    return fmt::format("nearest to its limit: {} {} of {}{}", nearest->name, error, allowed,
                       held_to_gold ? " for gold" : "");
  return fmt::format("{} as it must be", nearest->name);
}

}  // namespace

Json badge_of(const Json& outcome) {
  if (!outcome.is_object()) return {{"verdict", "crashed"}, {"words", "the recording breaks off: its process ended"}};
  const Row row = parse_row(outcome, 0);
  const Verdict verdict = row.verdict();
  const bool went_well = verdict == Verdict::gold || verdict == Verdict::pass || verdict == Verdict::ran;
  if (went_well && !outcome.contains("metrics")) return nullptr;
  std::string words = row.reason;
  if (verdict == Verdict::ran) words = "nothing here has a threshold";
  if (verdict == Verdict::gold || verdict == Verdict::pass) words = nearest_to_its_limit(row, verdict == Verdict::gold);
  return {{"verdict", verdict_word(verdict)}, {"words", words}};
}

}  // namespace plumb::harness
