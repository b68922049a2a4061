// A tree of boxes as kernels search it: how it is laid out in memory, and the loop that finds what a box touches.
#pragma once

#include <cstdint>

#include "exec/simd.hpp"
#include "math/box.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

/// Leaf i is node 2 i, inner node i is node 2 i + 1: what is near in the tree is near in memory.
struct alignas(32) TreeNode {
  Vec low;
  std::uint32_t child;  ///< inner node: its first child; leaf: its proxy
  Vec high;
  std::uint32_t next;  ///< what follows this subtree in depth-first order
};

/// A box that nodes are tested against.
class BoxQuery {
 public:
#if defined(PLUMB_IMPULSE_CUDA) || defined(PLUMB_IMPULSE_DOUBLE)
  PLUMB_HD explicit BoxQuery(const Box& box) : box_(box) {}
  [[nodiscard]] PLUMB_HD bool touches(const TreeNode& node) const { return overlap(box_, {node.low, node.high}); }

 private:
  Box box_;
#else
  explicit BoxQuery(const Box& box)
      : low_{{box.low.x, box.low.y, box.low.z, 0}}, high_{{box.high.x, box.high.y, box.high.z, 0}} {}
  /// Without branches, which nobody could foresee. The fourth lane, of child and next, is left out.
  [[nodiscard]] bool touches(const TreeNode& node) const {
    const Numbers low = Numbers::load(&node.low.x), high = Numbers::load(&node.high.x);
    return (simd::bits_of((low <= high_) & (high >= low_)) & 7U) == 7U;
  }

 private:
  using Numbers = simd::Packed<float>;
  Numbers low_, high_;
#endif
};

struct TreeView {
  static constexpr std::uint32_t kEnd = ~0U;

  const TreeNode* nodes;
  std::uint32_t leaves;

  [[nodiscard]] PLUMB_HD std::uint32_t root() const { return leaves == 0 ? kEnd : leaves == 1 ? 0U : 1U; }
  [[nodiscard]] PLUMB_HD static constexpr bool is_inner(std::uint32_t id) { return (id & 1U) != 0; }
  [[nodiscard]] PLUMB_HD const TreeNode& leaf(std::uint32_t i) const {
    PLUMB_ASSERT(i < leaves);
    return nodes[2 * i];
  }
  [[nodiscard]] PLUMB_HD Box box(std::uint32_t i) const { return {leaf(i).low, leaf(i).high}; }

  /// found(proxy) for every leaf from node `from` on, in order, whose box touches `box`.
  template <class Found>
  PLUMB_HD void overlaps(const Box& box, std::uint32_t from, Found& found) const {
    const BoxQuery query(box);
    for (std::uint32_t id = from; id != kEnd;) {
      const TreeNode node = nodes[id];
      const bool hit = query.touches(node), inner = is_inner(id);
      if (hit && !inner) found(node.child);
      id = hit && inner ? node.child : node.next;
    }
  }
};

}  // namespace plumb::impulse
