// Baselines: what got better or worse since other results, beyond the noise.
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

enum class Sense { worse, better, changed };
[[nodiscard]] std::string_view sense_word(Sense sense);

/// What counts as a difference.
struct AgainstLimits {
  /// Relative change of an error of a run that repeats itself to the bit: more is no rounding of the file's digits.
  double error = 1e-9;
  /// Relative change of a time where one side was measured only once, so that nobody knows its spread.
  double single_time = 0.1;
  /// Least relative change of a time whose intervals do not overlap.
  double time = 0.02;

  /// On machines that others use, too, no time tells anything.
  void ignore_times() { single_time = time = std::numeric_limits<double>::infinity(); }
  [[nodiscard]] bool times_count() const { return std::isfinite(time); }
};

/// One thing about a cell.
struct Change {
  Sense sense;
  std::string what;  ///< "result", "time", "state", or a metric's name
  std::optional<double> before, after;
  std::string text;  ///< "drift 0.004 -> 0.02, threshold 0.01"
};

/// A cell that both results have, and that is not as it was. The worst of its changes decides its sense.
struct CellChange {
  const Row *before, *after;
  Sense sense;
  std::vector<Change> changes;
};

struct Comparison {
  std::vector<CellChange> cells;  ///< worse, better, changed; each in the order of the new results
  std::vector<const Row*> only_before, only_after;
  std::size_t both = 0;                       ///< cells that both have
  std::size_t times = 0;                      ///< of those, whose times were held against each other
  std::size_t other_machine = 0;              ///< of those, whose times were not, because the machines differ
  std::size_t contended = 0;                  ///< or because a machine was contended
  std::size_t noisy = 0;                      ///< cells that do not repeat themselves: only thresholds count
  std::string machine_before, machine_after;  ///< where other_machine is above 0: examples

  [[nodiscard]] std::size_t count(Sense sense) const;
};

/// Cells are the same when all that was asked for is: scene, parameters, backend (whatever its version), profile,
/// needs, time step, duration, threads and the settings that are not the engine's own. An error of a run that repeats
/// itself is worse or better when it moves at all, since it has no noise, or when it crosses a threshold; of a metric
/// without a threshold it has changed. A time is worse or better when the intervals (95 %, else from the fastest to the
/// slowest repetition) do not overlap. Results point into the rows.
[[nodiscard]] Comparison compare_results(const std::vector<Row>& before, const std::vector<Row>& after,
                                         const AgainstLimits& limits);

/// What times may be compared on: processor, cores, device; the whole entry where it names none of them.
[[nodiscard]] std::string hardware_of(const Json& machine);

}  // namespace plumb::harness
