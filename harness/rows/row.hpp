// A row of results: what came of one cell. It is what results*.jsonl hold, an object a line; row.cpp has the only list
// of its keys.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/json.hpp"
#include "rows/statistics.hpp"
#include "rows/verdict.hpp"

namespace plumb::harness {

/// What rows say under "format". It grows when a key that was there means something else, or is gone.
inline constexpr int row_format = 1;

/// One metric of a cell. Numbers that were not finite (null in the file) are absent.
struct MetricResult {
  std::string name, unit, note;
  std::optional<double> value, truth, error, unbiased_error, threshold, gold;
  std::optional<bool> pass;  ///< absent where nothing is scored
  bool is_gold = false;
  bool tells_unbiased_error = false;  ///< be it that it was not finite
  bool whole = false;                 ///< value, truth and error are counts, written without a point

  [[nodiscard]] bool scored() const { return threshold || gold || pass; }
  /// Error over threshold (over gold where there is no threshold): above 1 is a miss, infinity where the error is not
  /// finite, and absent where nothing is scored.
  [[nodiscard]] std::optional<double> badness() const;
};

/// Of the backend that ran the cell, beside its name and the settings in force.
struct RowEngine {
  std::string version, build;
  Json defaults = Json::object();  ///< the engine's own values of settings that are off them
  std::vector<std::string> knobs;  ///< settings that buy accuracy with time
  bool tells_defaults = false;     ///< the line has them; those of older programs do not
};

/// That a machine had more to do than cores.
struct Contention {
  std::optional<double> load;  ///< cores that all together asked for
  std::string why;
};

/// Wall times over the repetitions, and what spoilt them.
struct RowTime {
  std::optional<double> median_ms, min_ms, max_ms, p99_ms;  ///< per step
  std::vector<double> runs_ms;                              ///< medians per step of each repetition
  std::optional<Interval> ci95;                             ///< of ms per step, over the repetitions
  std::optional<double> wall_s;                             ///< of all repetitions
  std::optional<double> window_first, window_last, steps, setup_ms;
  std::vector<std::pair<std::string, double>> phase_ms;  ///< medians by phase, where the engine tells
  std::optional<double> repeats;
  std::optional<double> restarted;      ///< repetitions whose worker was killed from outside, and that ran once more
  std::optional<Contention> contended;  ///< of those that the times are of

  [[nodiscard]] std::string why_contended() const { return contended ? contended->why : ""; }
};

struct RowCounts {
  std::optional<double> bodies, contacts_max, dropped, nonfinite, peak_mb;
};

/// Where a row is from and what it is called.
struct RowOrigin {
  std::size_t index = 0;          ///< among the rows of a report; names the row on the page
  std::string cell;               ///< cell_id()
  std::string study;              ///< its name, where the row is of one
  Json machine = Json::object();  ///< without its date, so that equal machines are equal
  std::string date;               ///< when it ran, as the machine's entry said
};

/// Text fields are "" and numbers absent where the line did not have them or had another type.
struct Row {
  std::string scene, slug, group, backend, profile, needs, status, reason, hash;
  Json params = Json::object(), settings = Json::object();  ///< always objects
  std::optional<double> dt, seconds, threads;
  std::vector<MetricResult> metrics;  ///< in the order of the line
  RowEngine engine;
  RowTime time;
  RowCounts counts;
  RowOrigin origin;

  [[nodiscard]] Verdict verdict() const;
  /// The metric with the largest badness; null when nothing is scored.
  [[nodiscard]] const MetricResult* worst() const;
  [[nodiscard]] const MetricResult* metric(std::string_view name) const;
  /// The median time of a step where it may be compared: absent when the machine was contended.
  [[nodiscard]] std::optional<double> fair_ms() const { return time.contended ? std::nullopt : time.median_ms; }
  /// fair_ms() / dt; absent where either is, or is not above zero.
  [[nodiscard]] std::optional<double> ms_per_simulated_second() const;
  /// It declared what its scene needs, and nothing else.
  [[nodiscard]] bool own_needs() const { return needs.empty() || needs == "scene"; }
  /// It ran to its end, so that its errors and times mean something.
  [[nodiscard]] bool completed() const { return status == "ok" || status == "failed"; }
  /// It ran to its end and missed no threshold of its scene: only such a run may win anything.
  [[nodiscard]] bool passes() const { return verdict() <= Verdict::ran; }
  /// What it misses, by most first: "drift 0.0139 > 0.01, stands"; else why it has no result; "" for one that passes.
  [[nodiscard]] std::string missed() const;
  /// "H=50 mu=0.3", "" without parameters: what tells the variants of a scene apart.
  [[nodiscard]] std::string variant() const;
  /// The same without the parameter `seed`: rows that differ in it only are a distribution on one problem.
  [[nodiscard]] std::string problem_variant() const;
};

/// The row as it stands in results.jsonl.
[[nodiscard]] Json to_json(const Row& row);
/// Metrics by name, as rows have them.
[[nodiscard]] Json to_json(const std::vector<MetricResult>& metrics);

/// Tolerant: never throws on wrong types inside; anything but an object gives an empty row with status "error".
[[nodiscard]] Row parse_row(const Json& line, std::size_t index);
[[nodiscard]] std::vector<Row> parse_rows(const std::vector<Json>& lines);
[[nodiscard]] std::vector<MetricResult> parse_metrics(const Json& metrics);

/// The row in line `number` (from 1) of a file; none where the line is no object, as a kill may leave one. Throws
/// Error(PLUMB_E_CORRUPT) "FILE:LINE: ..." for objects that are no row, and for rows of other formats.
[[nodiscard]] std::optional<Row> read_row(const std::string& line, const std::filesystem::path& file,
                                          std::size_t number);

/// What makes two rows the same: the cell, and the machine that answered, whenever that was.
[[nodiscard]] std::string row_key(const Row& row);

}  // namespace plumb::harness
