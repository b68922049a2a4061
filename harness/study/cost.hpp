// What a cell will cost, from what cells like it have cost.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "cell/cell.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

class CostModel {
 public:
  /// A finished row; rows without wall time teach nothing.
  void learn(const Row& row);
  /// Wall time of one repetition, s: by the cost of a step of the same scene and parameters on the same backend, else
  /// on all backends, times the steps, and times the whole-numbered quality settings above their defaults. None when
  /// nothing is known of the scene.
  [[nodiscard]] std::optional<double> seconds(const Cell& cell) const;
  /// The mean of a repetition over all that is known; 1 s when that is nothing.
  [[nodiscard]] double typical_seconds() const { return count_ == 0 ? 1 : sum_ / count_; }

 private:
  struct Mean {
    double sum = 0, count = 0;
  };
  std::map<std::string, Mean> steps_;  ///< wall time over steps and effort
  double sum_ = 0, count_ = 0;
};

}  // namespace plumb::harness
