// Where a set of boxes lies and how large they are: what codes and cells are relative to.
//
// Whole numbers only (order keys, binary exponents), so that it does not matter in which order they are merged.
#pragma once

#include <cstdint>

#include "bvh/morton.hpp"
#include "math/box.hpp"

namespace plumb::impulse {

/// A box that takes part: not empty, of numbers, and not as good as infinite.
PLUMB_HD constexpr bool is_sound(const Box& box) {
  return box.low.x <= box.high.x && box.low.y <= box.high.y && box.low.z <= box.high.z && box.low.x >= -kHuge &&
         box.low.y >= -kHuge && box.low.z >= -kHuge && box.high.x <= kHuge && box.high.y <= kHuge &&
         box.high.z <= kHuge;
}
/// What is not sound touches nothing, and must not spoil what it is merged with.
PLUMB_HD constexpr Box sound_or_empty(const Box& box) { return is_sound(box) ? box : empty_box(); }
PLUMB_HD constexpr Vec centre(const Box& box) { return Real(.5) * (box.low + box.high); }
PLUMB_HD constexpr float longest_side(const Box& box) {
  const Vec side = box.high - box.low;
  return static_cast<float>(max(side.x, max(side.y, side.z)));
}
/// Binary exponent of a number that is not negative, from 0 for 0 to 255.
PLUMB_HD constexpr int exponent_of(float x) {
  return static_cast<int>(__builtin_bit_cast(std::uint32_t, x) >> 23 & 255U);
}

/// Farthest coordinate from the origin of the boxes.
PLUMB_HD constexpr float reach(const Box& box) {
  const Vec most = max(box.high, -box.low);
  return static_cast<float>(max(most.x, max(most.y, most.z)));
}

/// A cube's low corner and its side, in which codes and cells are counted.
struct SceneFrame {
  float corner[3];
  float side;
};

struct SceneExtent {
  std::uint32_t low[3], high[3];          ///< order keys of the bounds of the boxes' centres, rounded to float
  std::uint32_t side_exponents, sized;    ///< sum over the longest sides of those that have one, and how many have
  std::uint32_t reach_exponents, placed;  ///< sum over the reaches of those that are not at 0, and how many are not

  PLUMB_HD static SceneExtent nothing() { return {{~0U, ~0U, ~0U}, {0, 0, 0}, 0, 0, 0, 0}; }
  PLUMB_HD static SceneExtent merged(const SceneExtent& a, const SceneExtent& b) {
    SceneExtent both{};
    for (int k = 0; k < 3; ++k) {
      both.low[k] = min(a.low[k], b.low[k]);
      both.high[k] = max(a.high[k], b.high[k]);
    }
    both.side_exponents = a.side_exponents + b.side_exponents;
    both.sized = a.sized + b.sized;
    both.reach_exponents = a.reach_exponents + b.reach_exponents;
    both.placed = a.placed + b.placed;
    return both;
  }
  PLUMB_HD static SceneExtent of(const Box& box) {
    if (!is_sound(box)) return nothing();
    const Vec middle = centre(box);
    const std::uint32_t x = order_key(static_cast<float>(middle.x)), y = order_key(static_cast<float>(middle.y)),
                        z = order_key(static_cast<float>(middle.z));
    const auto side = static_cast<std::uint32_t>(exponent_of(longest_side(box))),
               far = static_cast<std::uint32_t>(exponent_of(reach(box)));
    return {{x, y, z}, {x, y, z}, side, min(side, 1U), far, min(far, 1U)};
  }

  [[nodiscard]] PLUMB_HD bool empty() const { return low[0] > high[0]; }
  /// Exponent of the geometric mean of the longest sides: one giant among many hardly moves it.
  [[nodiscard]] PLUMB_HD int mean_exponent() const { return sized == 0 ? 0 : static_cast<int>(side_exponents / sized); }
  [[nodiscard]] PLUMB_HD int longest_axis() const {
    const int first = length(1) > length(0) ? 1 : 0;
    return length(2) > length(first) ? 2 : first;
  }

  /// A cube about the centres. A few that are lost far out do not widen it: it ends at 2^bits times the geometric mean
  /// of the boxes' reaches, and what lies beyond counts as being at its edge.
  [[nodiscard]] PLUMB_HD SceneFrame frame(int bits) const {
    const std::uint32_t exponent = (placed == 0 ? 0 : reach_exponents / placed) + 1U + static_cast<std::uint32_t>(bits);
    const auto edge = __builtin_bit_cast(float, min(exponent, 254U) << 23);
    SceneFrame cube{{0, 0, 0}, 0};
    for (int k = 0; k < 3 && !empty(); ++k) {
      cube.corner[k] = max(from_order_key(low[k]), -edge);
      cube.side = max(cube.side, min(from_order_key(high[k]), edge) - cube.corner[k]);
    }
    return cube;
  }

 private:
  [[nodiscard]] PLUMB_HD float length(int axis) const {
    return empty() ? 0.0F : from_order_key(high[axis]) - from_order_key(low[axis]);
  }
};

struct LoadExtent {
  const Box* boxes;
  const std::uint32_t* proxies;
  PLUMB_HD SceneExtent operator()(std::uint32_t i) const { return SceneExtent::of(boxes[proxies[i]]); }
};

}  // namespace plumb::impulse
