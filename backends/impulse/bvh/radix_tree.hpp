// One inner node of the binary radix tree over sorted keys, from the keys alone (Karras, HPG 2012, section 4).
#pragma once

#include <cstdint>

#include "math/bits.hpp"

namespace plumb::impulse {

template <class K>
struct SortedKeys {
  const K* keys;
  std::uint32_t count;

  /// Length of the common prefix of keys i and j, -1 where there is no j. The index continues the key, so that no two
  /// are equal.
  [[nodiscard]] PLUMB_HD int common_prefix(std::uint32_t i, std::int64_t j) const {
    if (j < 0 || j >= static_cast<std::int64_t>(count)) return -1;
    const auto other = static_cast<std::uint32_t>(j);
    const K difference = keys[i] ^ keys[other];
    return difference != 0 ? leading_zeros(difference) : static_cast<int>(8 * sizeof(K)) + leading_zeros(i ^ other);
  }
};

/// The leaves first .. last below an inner node, and `split`, the last of its first child's.
struct InnerNode {
  std::uint32_t first, last, split;
};

/// Inner node i < count - 1. It is its range's first or last leaf that has the number i.
template <class K>
PLUMB_HD InnerNode inner_node(const SortedKeys<K>& sorted, std::uint32_t i) {
  const auto here = static_cast<std::int64_t>(i);
  const int direction = sorted.common_prefix(i, here + 1) > sorted.common_prefix(i, here - 1) ? 1 : -1;

  // The other end: all in the range share more with i than the neighbour on the wrong side does.
  const int least = sorted.common_prefix(i, here - direction);
  std::int64_t bound = 2;
  while (sorted.common_prefix(i, here + bound * direction) > least) bound *= 2;
  std::int64_t length = 0;
  for (std::int64_t step = bound / 2; step > 0; step /= 2)
    if (sorted.common_prefix(i, here + (length + step) * direction) > least) length += step;
  const std::int64_t end = here + length * direction;

  // The split: where the prefix of the whole range ends.
  const int whole = sorted.common_prefix(i, end);
  std::int64_t offset = 0;
  for (std::int64_t step = length; step > 1;) {
    step = (step + 1) / 2;
    if (sorted.common_prefix(i, here + (offset + step) * direction) > whole) offset += step;
  }
  const std::int64_t split = here + offset * direction + (direction < 0 ? -1 : 0);
  return {static_cast<std::uint32_t>(direction > 0 ? here : end),
          static_cast<std::uint32_t>(direction > 0 ? end : here), static_cast<std::uint32_t>(split)};
}

}  // namespace plumb::impulse
