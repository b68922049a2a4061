// Two engines on the same scenes: which scenes tell them apart, by how much, and what that cost in the same runs.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "rows/row.hpp"

namespace plumb::harness {

/// What each engine did on one variant of a scene, on the same machine, with the same step and duration.
struct DuelPair {
  std::array<const Row*, 2> rows;

  [[nodiscard]] std::string title() const;  ///< "D1 H=50"
};

/// Why a pair tells the engines apart, the strongest reason first.
enum class Apart {
  passes,   ///< one passes the scene and the other does not
  verdict,  ///< another difference of verdicts: gold and pass, failed and crashed
  error,    ///< both pass, one with a smaller error
  wrong     ///< both fail, one by less
};
/// "one passes", "verdicts differ", ...
[[nodiscard]] std::string_view apart_text(Apart apart);

/// A metric that both rows have, or the one that did not come through lacks.
struct DuelMetric {
  std::string name, unit;
  std::array<const MetricResult*, 2> of;  ///< null where a row lacks it
  std::size_t ahead = 0;                  ///< whose error is smaller
  double factor = 1;  ///< the larger error over the smaller one; infinite where one is not finite, or a yes/no missed
};

struct DuelFinding {
  DuelPair pair;
  Apart apart;
  std::size_t ahead;   ///< 0 or 1
  std::string metric;  ///< that shows it; "" where a run did not come through
  double factor;       ///< of that metric
};

/// A scene that tells them apart.
struct DuelScene {
  DuelFinding best;                 ///< of all its variants
  std::vector<DuelFinding> others;  ///< the variants that do, too
};

struct Duel {
  std::array<std::string, 2> names;
  std::vector<DuelScene> apart;           ///< those that tell most first
  std::vector<DuelPair> alike;            ///< both ran, and nothing above tells them apart
  std::vector<DuelPair> one_only;         ///< the other engine cannot run it, or nobody could tell what came of it
  std::vector<DuelPair> neither;          ///< likewise of both
  std::vector<const Row*> without_match;  ///< the other engine has no such row
  std::array<std::size_t, 2> ahead{};     ///< scenes in `apart`
  std::size_t pairs = 0;
  std::optional<double> time_factor;  ///< median over pairs that both came through of second's time over the first's
  std::size_t timed = 0;              ///< such pairs
};

/// How many times larger an error must be to tell engines apart where verdicts do not.
inline constexpr double telling_factor = 2;

/// Both engines' rows, at most one of each a variant and machine; they must outlive the duel.
[[nodiscard]] Duel duel_of(const std::array<std::string, 2>& names, const std::vector<Row>& first,
                           const std::vector<Row>& second);

/// All scored metrics of a pair, in the order of the first row that has them. An error below a thousandth of its limit
/// counts as that: nobody asks for more, and noise is no merit.
[[nodiscard]] std::vector<DuelMetric> duel_metrics(const DuelPair& pair);

/// The second's time of a step over the first's; absent where either has none that counts.
[[nodiscard]] std::optional<double> time_factor_of(const DuelPair& pair);

}  // namespace plumb::harness
