// Sort and sweep on one axis: boxes sorted by where they begin, each scans those that begin before it ends.
//
// The axis is the one along which the centres spread farthest. Made for a few thousand boxes: the scan is as long as a
// slice of the scene, and a giant box scans most of it by itself.
#pragma once

#include <cstdint>

#include "broadphase/sorted_boxes.hpp"

namespace plumb::impulse {

/// Where a coordinate comes on the axis. Rounding to float keeps the order, and -0 becomes 0.
PLUMB_HD inline std::uint32_t sweep_key(Real x) { return order_key(static_cast<float>(x) + 0.0F); }

struct SweepView {
  const SortedBox* boxes;
  std::uint32_t count;
  const SceneExtent* extent;

  [[nodiscard]] PLUMB_HD std::uint32_t proxy(std::uint32_t i) const { return boxes[i].proxy; }
  [[nodiscard]] PLUMB_HD Box box(std::uint32_t i) const { return {boxes[i].low, boxes[i].high}; }
  /// found(proxy) for every box behind i that touches it.
  template <class Found>
  PLUMB_HD void overlaps(std::uint32_t i, const Box& box, Found& found) const {
    const std::uint32_t end = sweep_key(box.high[extent->longest_axis()]);
    for (std::uint32_t j = i + 1; j < count && boxes[j].key <= end; ++j) find_if_touching(box, boxes[j], found);
  }
};

class Sweep {
 public:
  void reserve(std::uint32_t capacity) { sorted_.reserve(capacity); }
  /// extent: of these boxes, in the executor's memory, and there as long as the view is used.
  void build(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n,
             const SceneExtent* extent);
  [[nodiscard]] SweepView view() const { return {sorted_.data(), count_, extent_}; }

 private:
  SortedBoxes sorted_;
  std::uint32_t count_ = 0;
  const SceneExtent* extent_ = nullptr;
};

}  // namespace plumb::impulse
