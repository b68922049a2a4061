// Boxes in the order of a key: what sort and sweep and the uniform grid go through.
#pragma once

#include <cstdint>

#include "bvh/scene_extent.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "exec/sort.hpp"
#include "math/box.hpp"

namespace plumb::impulse {

struct alignas(32) SortedBox {
  Vec low;
  std::uint32_t proxy;
  Vec high;
  std::uint32_t key;
};

/// Passes the proxy of `other` on where it touches.
template <class Found>
PLUMB_HD void find_if_touching(const Box& box, const SortedBox& other, Found& found) {
  if (overlap(box, Box{other.low, other.high})) found(other.proxy);
}

/// The first of the boxes first .. last - 1 whose key is not below `key`; last where there is none.
PLUMB_HD inline std::uint32_t first_from(const SortedBox* boxes, std::uint32_t first, std::uint32_t last,
                                         std::uint32_t key) {
  while (first < last) {
    const std::uint32_t middle = first + (last - first) / 2;
    if (boxes[middle].key < key) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  return first;
}

class SortedBoxes {
 public:
  void reserve(std::uint32_t capacity) {
    keys.grow(capacity);
    sorted_keys_.grow(capacity);
    indices.grow(capacity);
    order_.grow(capacity);
    boxes_.grow(capacity);
    sort_.reserve(capacity);
  }
  /// Sorts by what was enqueued to be written to keys, with indices[i] = i. Equal keys stay in their order.
  void sort(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n, int bits);
  [[nodiscard]] const SortedBox* data() const { return boxes_.data(); }

  Buffer<std::uint32_t> keys, indices;

 private:
  Buffer<std::uint32_t> sorted_keys_, order_;
  Buffer<SortedBox> boxes_;
  RadixSort<std::uint32_t> sort_;
};

}  // namespace plumb::impulse
