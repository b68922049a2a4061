// What the numbers say in words: counts of verdicts, where a backend is best and where it breaks.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "report/ordered/cost.hpp"
#include "report/ordered/ordered_rows.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

/// A backend over all problems, each counted once by its run at the defaults.
struct BackendOverview {
  std::string backend, version;
  std::array<int, verdict_count> counts{};  ///< by Verdict
  int problems = 0;
  int elsewhere = 0;                                     ///< problems that it ran with other settings only
  std::array<ReachCount, target_errors.size()> reach{};  ///< by target
  std::vector<std::string> best_groups, worst_groups;    ///< by share of problems passed; empty when all are alike
  std::vector<const Row*> failures;                      ///< failed, the farthest from its threshold first
  std::vector<const Row*> broken;                        ///< crashed, timed out, out of memory, errors
  std::vector<const Row*> lost;                          ///< both of them, in the order of problems
  std::vector<const Row*> unsupported, unjudged;

  [[nodiscard]] int count(Verdict verdict) const { return counts[static_cast<std::size_t>(verdict)]; }
};

[[nodiscard]] std::vector<BackendOverview> overviews(const OrderedRows& ordered, const std::vector<CostLine>& costs);

/// "5 more problems ran with other settings only."; "" where none did.
[[nodiscard]] std::string elsewhere_text(const BackendOverview& overview);

/// "Of 209 problems: 119 gold, 71 passed, 19 failed."
[[nodiscard]] std::string describe_counts(const BackendOverview& overview);
/// One paragraph.
[[nodiscard]] std::string describe_backend(const BackendOverview& overview, bool alone);
/// "within 1 % in 12 of 40 metrics, the cheapest in 3 of them"
[[nodiscard]] std::string reach_text(const ReachCount& count, bool alone);
/// What was compared, in sentences: backends, scenes, cells, dt and profiles.
[[nodiscard]] std::string describe_study(const OrderedRows& ordered);
/// "cpu: AMD EPYC, cores: 2" for each machine that answered.
[[nodiscard]] std::vector<std::string> describe_machines(const OrderedRows& ordered);

}  // namespace plumb::harness
