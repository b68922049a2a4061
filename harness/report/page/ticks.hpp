// Where an axis has its ticks, and what they say.
#pragma once

#include <string>
#include <vector>

namespace plumb::harness {

struct Tick {
  double value;
  std::string label;  ///< "" for a minor tick
};

/// Multiples of 1, 2 or 5 times a power of ten within [low, high], at most `most` of them, all labelled.
[[nodiscard]] std::vector<Tick> linear_ticks(double low, double high, int most);

/// Powers of ten within [low, high], at most `most` of them labelled, with minor ticks at 2..9 between them; where
/// fewer than two powers fit, 1, 2 and 5 times powers are labelled too. 0 < low < high.
[[nodiscard]] std::vector<Tick> log_ticks(double low, double high, int most);

}  // namespace plumb::harness
