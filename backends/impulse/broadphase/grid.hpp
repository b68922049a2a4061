// A uniform grid: boxes sorted by the cell of their low corner, each tested against its own and the neighbour cells.
//
// A cell is a little wider than the longest side of a common box, one of up to four times the mean, so that those that
// touch have low corners in the same or in neighbour cells. Larger boxes lie in a list that all others go through: a
// grid suits scenes of one size of box. It has 1024 cells a side at most; a wider scene gets wider cells.
#pragma once

#include <cstdint>

#include "broadphase/sorted_boxes.hpp"
#include "exec/reduce.hpp"

namespace plumb::impulse {

/// The cells' keys: x in the lowest bits, so that three neighbours along x are one range of keys.
struct GridCells {
  static constexpr int kAxisBits = 10;
  static constexpr std::uint32_t kAcross = 1U << kAxisBits;
  static constexpr std::uint32_t kLarge = 1U << 3 * kAxisBits;  ///< the key of all large boxes
  static constexpr int kKeyBits = 3 * kAxisBits + 1;

  PLUMB_HD static constexpr std::uint32_t key(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
    return z << 2 * kAxisBits | y << kAxisBits | x;
  }
  PLUMB_HD static constexpr std::uint32_t coordinate(std::uint32_t key, int axis) {
    return key >> axis * kAxisBits & (kAcross - 1);
  }
};

/// Bits of the longest side among common boxes, which order as the numbers do.
struct CommonSide {
  std::uint32_t bits;

  /// A common box has at most this exponent.
  PLUMB_HD static int most_exponent(const SceneExtent& scene) { return scene.mean_exponent() + 1; }

  PLUMB_HD static CommonSide nothing() { return {0}; }
  PLUMB_HD static CommonSide merged(const CommonSide& a, const CommonSide& b) { return {max(a.bits, b.bits)}; }
};

struct GridView {
  const SortedBox* boxes;
  std::uint32_t count;
  const std::uint32_t* common_count;  ///< of the boxes that lie in cells; they come first

  [[nodiscard]] PLUMB_HD std::uint32_t proxy(std::uint32_t i) const { return boxes[i].proxy; }
  [[nodiscard]] PLUMB_HD Box box(std::uint32_t i) const { return {boxes[i].low, boxes[i].high}; }

  /// found(proxy) for every box behind i that touches it.
  template <class Found>
  PLUMB_HD void overlaps(std::uint32_t i, const Box& box, Found& found) const {
    const std::uint32_t common = *common_count, key = boxes[i].key;
    if (i >= common) return test(box, i + 1, count, key, found);

    constexpr std::uint32_t last = GridCells::kAcross - 1;
    const std::uint32_t x = GridCells::coordinate(key, 0), y = GridCells::coordinate(key, 1),
                        z = GridCells::coordinate(key, 2);
    const std::uint32_t x_low = x == 0 ? 0 : x - 1, x_high = x == last ? last : x + 1;
    // Of the 27 cells those behind: the rest of its own and the next one, then four rows of three.
    test(box, i + 1, common, GridCells::key(x_high, y, z), found);
    if (y < last) test_row(box, i, common, GridCells::key(x_low, y + 1, z), GridCells::key(x_high, y + 1, z), found);
    if (z < last) {
      for (std::uint32_t row = y == 0 ? 0 : y - 1; row <= (y == last ? last : y + 1); ++row)
        test_row(box, i, common, GridCells::key(x_low, row, z + 1), GridCells::key(x_high, row, z + 1), found);
    }
    test(box, common, count, GridCells::kLarge, found);
  }

 private:
  template <class Found>
  PLUMB_HD void test_row(const Box& box, std::uint32_t i, std::uint32_t common, std::uint32_t low_key,
                         std::uint32_t high_key, Found& found) const {
    test(box, first_from(boxes, i + 1, common, low_key), common, high_key, found);
  }
  template <class Found>
  PLUMB_HD void test(const Box& box, std::uint32_t first, std::uint32_t end, std::uint32_t high_key,
                     Found& found) const {
    for (std::uint32_t j = first; j < end && boxes[j].key <= high_key; ++j) find_if_touching(box, boxes[j], found);
  }
};

class Grid {
 public:
  void reserve(std::uint32_t capacity);
  /// extent: of these boxes, in the executor's memory.
  void build(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n,
             const SceneExtent* extent);
  [[nodiscard]] GridView view() const { return {sorted_.data(), count_, common_count_.data()}; }

 private:
  Reduce<CommonSide> reduce_;
  Buffer<CommonSide> side_;
  Buffer<std::uint32_t> common_count_;
  SortedBoxes sorted_;
  std::uint32_t count_ = 0;
};

}  // namespace plumb::impulse
