// What accuracy costs: for every problem, metric and backend the cheapest configuration that reaches an error.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "report/ordered/ordered_rows.hpp"
#include "report/ordered/sample.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

inline constexpr std::array<double, 3> target_errors{0.1, 0.01, 0.001};
inline constexpr std::size_t one_percent = 1, one_per_mille = 2;  ///< places in it

/// A configuration that reaches an error, and at which price.
struct Reached {
  const Row* row;                ///< its first, where seeds make it several
  double error;                  ///< median over the seeds
  std::optional<double> ms;      ///< wall time per simulated second; absent where only contended machines timed it
  std::optional<Interval> band;  ///< 95 % of ms, where known
  std::size_t untimed = 0;       ///< configurations that reach the error, too, and have no time that counts

  /// Nobody knows of a cheaper one. With `untimed` ones ms is an upper bound, and there is no telling who is cheaper.
  [[nodiscard]] bool priced() const { return ms && untimed == 0; }
};

struct CostLine {
  const Problem* problem;
  std::string metric, backend;
  using ByTarget = std::array<std::optional<Reached>, target_errors.size()>;  ///< by target_errors; empty: never
  ByTarget at;       ///< by runs that pass all thresholds of their scene: what is called reached anywhere
  ByTarget failing;  ///< where `at` is empty: by runs that miss one
  /// Smallest error of the runs that pass, else of the others; the cheapest of equals.
  std::optional<Reached> floor;
  const Row* representative;  ///< the backend's cell that says why, where nothing is reached; never null
};

/// Lines by problem, then metric, then backend; only backends with a cell on the problem. A cell counts for a metric
/// when it ran to its end with a finite error and missed none of the scene's yes/no questions: a tower that fell has
/// little overlap left, and no accuracy. Errors count whatever else the machine did; times of a contended one do not.
[[nodiscard]] std::vector<CostLine> cost_of_accuracy(const OrderedRows& ordered);

/// All lines of one problem and metric: what engines are held against each other on.
struct CostTest {
  std::span<const CostLine> lines;

  [[nodiscard]] const CostLine* line_of(const std::string& backend) const;  ///< null where it has no cell
  [[nodiscard]] bool reached(std::size_t target) const;                     ///< by anybody
  /// Least ms per simulated second; absent where nobody reaches the target, or somebody does at an unknown price.
  [[nodiscard]] std::optional<double> cheapest(std::size_t target) const;
  /// It reaches the target, and nobody of several does for less.
  [[nodiscard]] bool is_cheapest(const CostLine& line, std::size_t target) const;
};

/// In the order of the lines, into which they point.
[[nodiscard]] std::vector<CostTest> tests_of(const std::vector<CostLine>& lines);

/// How often a backend reaches a target, and how often nobody does so for less. Whatever counts that takes it from
/// here.
struct ReachCount {
  std::size_t tests = 0;     ///< that it has a cell of, those that it cannot run apart
  std::size_t reached = 0;   ///< of those
  std::size_t compared = 0;  ///< of the reached: others have a cell, too, and all prices are known
  std::size_t cheapest = 0;  ///< of the compared
};
[[nodiscard]] ReachCount count_reached(const std::vector<CostTest>& tests, const std::string& backend,
                                       std::size_t target);

}  // namespace plumb::harness
