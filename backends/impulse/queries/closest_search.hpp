// The box about a shape goes through a tree for what is near: a node is as far away at least as its box is from the
// shape's. The tree's numbers are floats, and a node must not be missed for that: the shape's box is larger by what is
// rounded, and distances between boxes are made shorter by it.
#pragma once

#include "queries/sweep_search.hpp"

namespace plumb::impulse {

/// As SweptBox is for what moves: with visit_nearest_first and visit_all.
class BoxAround {
 public:
  /// start: from the origin of the boxes; carried: about the start; most: the distance that counts, m.
  PLUMB_HD BoxAround(const Vec64& start, const Box& carried, double most) {
    constexpr auto kFar = static_cast<double>(kHuge);
    for (int k = 0; k < 3; ++k) {
      const Real at = static_cast<Real>(clamp(start[k], -kFar, kFar));
      const Real rounding = 4 * kEpsilon * (abs(at) + abs(carried.low[k]) + abs(carried.high[k]));
      low_[k] = at + carried.low[k] - rounding;
      high_[k] = at + carried.high[k] + rounding;
    }
    last = place_of(most);
  }

  Real last;  ///< beyond this nothing is looked for any more

  /// A distance as `last` has it.
  [[nodiscard]] PLUMB_HD Real place_of(double distance) const {
    const Real place = static_cast<Real>(min(distance, 8 * static_cast<double>(kHuge)));
    return place + kSlack * place;
  }

  /// Whether something in the node may be nearer than `last`, and how near at least.
  [[nodiscard]] PLUMB_HD bool meets(const TreeNode& node, Real& from) const {
    const Vec none = {0, 0, 0}, apart = max(none, max(node.low - high_, low_ - node.high));
    const Real square = length_squared(apart);
    from = square < kHuge ? sqrt(square) : max(apart.x, max(apart.y, apart.z));
    from -= kSlack * from;
    return from <= last;
  }

 private:
  static constexpr Real kSlack = 8 * kEpsilon;

  Vec low_, high_;
};

}  // namespace plumb::impulse
