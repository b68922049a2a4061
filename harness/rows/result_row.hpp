// One cell's result as the reports see it: read once, tolerantly, from the JSON line that `plumb run` wrote.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "rows/statistics.hpp"

namespace plumb::harness {

/// What came of a cell, best first. `ran` is a cell without anything scored; after `unjudged`, of which the harness
/// could not tell what came, all are the engine's loss.
enum class Verdict { gold, pass, ran, failed, unsupported, unjudged, crashed, timeout, out_of_memory, error };
inline constexpr std::size_t verdict_count = 10;

/// The word for people and machines: "gold", "out_of_memory" ...
[[nodiscard]] std::string_view verdict_word(Verdict verdict);

/// It is no word on the engine's skill: it cannot run the scene, or nobody could tell what came of it.
[[nodiscard]] constexpr bool says_nothing(Verdict verdict) {
  return verdict == Verdict::unsupported || verdict == Verdict::unjudged;
}

/// One metric of a cell. Numbers that were not finite (null in the file) are absent.
struct MetricResult {
  std::string name, unit, note;
  std::optional<double> value, truth, error, unbiased_error, threshold, gold;
  std::optional<bool> pass;  ///< absent where nothing is scored
  bool is_gold = false;

  [[nodiscard]] bool scored() const { return threshold || gold || pass; }
  /// Error over threshold (over gold where there is no threshold): above 1 is a miss, infinity where the error is not
  /// finite, and absent where nothing is scored.
  [[nodiscard]] std::optional<double> badness() const;
};

/// A cell. Text fields are "" and numbers absent where the line did not have them or had another type.
struct ResultRow {
  std::size_t index = 0;  ///< in the order of the file; names the row on the page
  std::string scene, slug, group, backend, backend_version, profile, needs, status, reason, hash;
  std::string date;                ///< when it ran, as the machine's entry said
  Json params, settings, machine;  ///< always objects; machine without its date, so that equal machines are equal
  Json defaults;                   ///< the engine's own values of settings that are off them; always an object
  std::vector<std::string> knobs;  ///< settings that buy accuracy with time
  bool tells_defaults = false;     ///< the line has them; those of older programs do not
  std::optional<double> dt, seconds, threads, repeats;
  std::vector<MetricResult> metrics;  ///< in the order of the line

  std::optional<double> median_ms, min_ms, max_ms, p99_ms;  ///< per step
  std::vector<double> runs_ms;                              ///< medians per step of each repetition
  std::optional<Interval> ci95;                             ///< of ms per step, over the repetitions
  double restarted = 0;                  ///< repetitions whose worker was killed from outside, and that ran once more
  std::optional<std::string> contended;  ///< why, where the machine had more to do than cores
  std::optional<double> window_first, window_last, steps, setup_ms;
  std::vector<std::pair<std::string, double>> phase_ms;  ///< medians by phase, where the engine tells
  std::optional<double> bodies, contacts_max, dropped, nonfinite, peak_mb;

  [[nodiscard]] Verdict verdict() const;
  /// The metric with the largest badness; null when nothing is scored.
  [[nodiscard]] const MetricResult* worst() const;
  [[nodiscard]] const MetricResult* metric(std::string_view name) const;
  /// median_ms where it may be compared: absent when the machine was contended.
  [[nodiscard]] std::optional<double> fair_ms() const { return contended ? std::nullopt : median_ms; }
  /// fair_ms() / dt; absent where either is, or is not above zero.
  [[nodiscard]] std::optional<double> ms_per_simulated_second() const;
  /// It declared what its scene needs, and nothing else.
  [[nodiscard]] bool own_needs() const { return needs.empty() || needs == "scene"; }
  /// It ran to its end, so that its errors and times mean something.
  [[nodiscard]] bool completed() const;
  /// It ran to its end and missed no threshold of its scene: only such a run may win anything.
  [[nodiscard]] bool passes() const { return verdict() <= Verdict::ran; }
  /// What it misses, by most first: "drift 0.0139 > 0.01, stands"; else why it has no result; "" for one that passes.
  [[nodiscard]] std::string missed() const;
  /// "H=50 mu=0.3", "" without parameters: what tells the variants of a scene apart.
  [[nodiscard]] std::string variant() const;
  /// The same without the parameter `seed`: rows that differ in it only are a distribution on one problem.
  [[nodiscard]] std::string problem_variant() const;
};

/// Never throws on wrong types inside; anything but an object gives an empty row with status "error".
[[nodiscard]] ResultRow parse_row(const Json& line, std::size_t index);
[[nodiscard]] std::vector<ResultRow> parse_rows(const std::vector<Json>& lines);

/// Order for people: A2 before A10, then by the rest of the text.
[[nodiscard]] bool natural_less(std::string_view a, std::string_view b);

/// A parameter's or setting's value as text: 50, 0.5, true, implicit.
[[nodiscard]] std::string value_text(const Json& value);

}  // namespace plumb::harness
