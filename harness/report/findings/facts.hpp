// What results say of an engine beyond verdicts: energy, friction, accuracy it never reaches, scenes where it is
// beaten.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "report/findings/robustness.hpp"
#include "report/ordered/cost.hpp"
#include "report/ordered/ordered_rows.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

/// A statement, and the run that shows it; null where many do.
struct Statement {
  std::string text;
  const Row* row = nullptr;
  std::vector<Statement> more = {};  ///< those that the text only counts: "and 16 more"
};

/// Energy over the engine's runs at its defaults.
struct EnergyFacts {
  std::size_t drifts = 0;                    ///< runs of scenes that score it: metric energy_drift
  double worst_drift = 0, median_drift = 0;  ///< largest on the way, relative
  const Row* drift_row = nullptr;
  bool gains = false;    ///< the worst one ended with more than it began with
  std::size_t lost = 0;  ///< runs of such scenes that did not come through, or whose energy is not finite
  const Row* lost_row = nullptr;
  /// What robustness() tells of the same runs and of all others: of drifts, and of the sums of all rises. Here and
  /// there the numbers are the same, since they are those.
  std::optional<RobustnessCell> all_drifts, all_rises;

  /// Wherever a scene has a threshold for it, it is kept, by runs that pass.
  [[nodiscard]] bool conserves() const;
};
[[nodiscard]] EnergyFacts energy_of(const OrderedRows& ordered, const std::string& backend);
/// "loses up to 98 % (A7 joint=ball), half of 8 runs stay within 0.3 %"; "" where nothing was measured.
[[nodiscard]] Statement energy_statement(const EnergyFacts& facts);

inline constexpr double conserving = 0.01;      ///< relative drift that an engine may have and be called conserving
inline constexpr double pyramid_spread = 0.15;  ///< of the stopping distance over headings: more is no cone
inline constexpr double ideal_pyramid = 0.36;   ///< spread of a four-sided pyramid over 16 headings, in closed form
inline constexpr double cone_spread = 0.02;     ///< the scene's threshold

/// How the stopping distance depends on the heading (metric `spread` of the scene with slug sliding-stop).
struct FrictionFacts {
  const Row* row = nullptr;  ///< at the defaults; null where nothing was measured. Of variants the worst
  double spread = 0;
  const Row* best_row = nullptr;  ///< any configuration
  double best_spread = 0;

  [[nodiscard]] bool pyramid() const { return row && spread >= pyramid_spread; }
};
[[nodiscard]] FrictionFacts friction_of(const OrderedRows& ordered, const std::string& backend);

/// Lines of the backend on which no configuration reaches target_errors[target], while another engine's does.
[[nodiscard]] std::vector<const CostLine*> never_reached(const std::vector<CostTest>& tests, const std::string& backend,
                                                         std::size_t target);
/// "D1 H=50 drift" of each, with the run that says why.
[[nodiscard]] std::vector<Statement> names_of(const std::vector<const CostLine*>& lines);
/// The beginning, the first few of at least one name, and the rest behind "and 16 more".
[[nodiscard]] Statement name_some(const std::string& beginning, const std::vector<Statement>& names);

/// Where another engine reaches the target for less, all prices being known.
struct Beaten {
  const CostLine *line, *by;
  double factor;  ///< above 1: how many times dearer
};
/// The largest factor first.
[[nodiscard]] std::vector<Beaten> beaten_at(const std::vector<CostTest>& tests, const std::string& backend,
                                            std::size_t target);

/// "D1 H=20: sink 0.4 m (truth 0), threshold 0.01" for a run that failed, "crashed in D1 H=20: SIGSEGV" for one that
/// did not come through.
[[nodiscard]] std::string failure_text(const Row& row);
/// The first few as statements of their own, the rest behind "and 16 more".
[[nodiscard]] std::vector<Statement> name_failures(const std::vector<const Row*>& rows);

/// 0.35 as "35 %".
[[nodiscard]] std::string percent_text(double share);
/// "D1 H=50"
[[nodiscard]] std::string row_title(const Row& row);

}  // namespace plumb::harness
