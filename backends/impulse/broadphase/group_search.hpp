// The tree's search as the CPU runs it: a few neighbouring leaves go through the tree together, and what their common
// box touches is tested against all of them at once. Finds the same in the same order as each leaf would by itself,
// because the order is that of the tree's leaves.
#pragma once

#include <cstdint>

#include "bvh/lbvh.hpp"
#include "exec/simd.hpp"
#include "math/bits.hpp"

namespace plumb::impulse {

/// Up to 8 boxes, number by number.
class BoxGroup {
 public:
  static constexpr std::uint32_t kMost = 8;

  void set(std::uint32_t k, const Box& box) {
    for (int axis = 0; axis < 3; ++axis) {
      low_[axis][k] = box.low[axis];
      high_[axis][k] = box.high[axis];
    }
  }
  /// Bit k: box k touches. Bits of boxes that were not set mean nothing.
  [[nodiscard]] std::uint32_t touching(const Box& box) const {
    std::uint32_t bits = 0;
    for (std::uint32_t k = 0; k < kMost; k += Numbers::kCount) bits |= touching_from(k, box) << k;
    return bits;
  }

 private:
  using Numbers = simd::Packed<Real>;

  [[nodiscard]] std::uint32_t touching_from(std::uint32_t k, const Box& box) const {
    Numbers::Mask all = Numbers::Mask{} == 0;
    for (int axis = 0; axis < 3; ++axis) {
      all &= Numbers::load(&low_[axis][k]) <= Numbers::all(box.high[axis]);
      all &= Numbers::load(&high_[axis][k]) >= Numbers::all(box.low[axis]);
    }
    return simd::bits_of(all);
  }

  alignas(16) Real low_[3][kMost] = {};
  alignas(16) Real high_[3][kMost] = {};
};

/// Neighbouring leaves first .. end - 1.
struct LeafRange {
  std::uint32_t first, end;
};

/// Small subtrees that the common box of a group touches. Looking into them one node after the other would take longer
/// than testing all of their leaves: each step waits for the one before.
class GroupCandidates {
 public:
  /// Those from node `from` on, whose subtree begins at leaf from / 2. False, and worth nothing, where there are too
  /// many: the group lies scattered.
  bool collect(const TreeView& tree, const Box& box, std::uint32_t from) {
    const BoxQuery query(box);
    count_ = 0;
    std::uint32_t first = from / 2;
    for (std::uint32_t id = from; id != TreeView::kEnd;) {
      const TreeNode& node = tree.nodes[id];
      const std::uint32_t end = node.next == TreeView::kEnd ? tree.leaves : node.next / 2;
      const bool hit = query.touches(node), small = end - first <= kSmall;
      ranges_[count_] = {first, end};  // kept where it counts: no branch that nobody could foresee
      count_ += static_cast<std::uint32_t>(hit & small);
      if (count_ == kMost) return false;
      const bool descend = hit & !small;
      id = descend ? node.child : node.next;
      first = descend ? first : end;
    }
    return true;
  }
  [[nodiscard]] const LeafRange* begin() const { return ranges_; }
  [[nodiscard]] const LeafRange* end() const { return ranges_ + count_; }

 private:
  static constexpr std::uint32_t kSmall = 8, kMost = 64;
  LeafRange ranges_[kMost + 1];
  std::uint32_t count_ = 0;
};

/// found(k, proxy, is_static) for every partner of leaf first + k, k < count: movers behind the leaf, then statics.
/// False, with nothing found, where the group is too scattered to be looked up together.
template <class Found>
bool search_group(const TreeView& movers, const TreeView& statics, std::uint32_t first, std::uint32_t count,
                  Found& found) {
  BoxGroup group;
  Box common = empty_box();
  for (std::uint32_t k = 0; k < count; ++k) {
    const Box box = movers.box(first + k);
    group.set(k, box);
    common = merged(common, box);
  }
  GroupCandidates of_movers, of_statics;
  if (!of_movers.collect(movers, common, movers.leaf(first).next)) return false;
  if (!of_statics.collect(statics, common, statics.root())) return false;

  const std::uint32_t all = (1U << count) - 1U;
  for (const LeafRange& range : of_movers)
    for (std::uint32_t leaf = range.first; leaf < range.end; ++leaf) {
      const std::uint32_t before = leaf - first < count ? (1U << (leaf - first)) - 1U : all;
      for (std::uint32_t bits = group.touching(movers.box(leaf)) & before; bits != 0; bits &= bits - 1)
        found(static_cast<std::uint32_t>(trailing_zeros(bits)), movers.leaf(leaf).child, false);
    }
  for (const LeafRange& range : of_statics)
    for (std::uint32_t leaf = range.first; leaf < range.end; ++leaf)
      for (std::uint32_t bits = group.touching(statics.box(leaf)) & all; bits != 0; bits &= bits - 1)
        found(static_cast<std::uint32_t>(trailing_zeros(bits)), statics.leaf(leaf).child, true);
  return true;
}

}  // namespace plumb::impulse
