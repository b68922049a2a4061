// The linear bounding volume hierarchy: a tree of boxes over what is sorted along the Morton curve.
//
//   codes    Morton code of each box's centre in the scene's extent, above it a bit or two for the size (below)
//   sort     by code
//   tree     binary radix tree of the codes, all inner nodes at once (Karras, "Maximizing parallelism in the
//            construction of BVHs, octrees, and k-d trees", HPG 2012, section 4); equal codes differ by their index
//   bounds   from the leaves up, one thread a leaf: the first that comes to a node leaves, the second merges
//   query    a loop without a stack: each node knows its first child, and the node that follows its subtree in depth-
//            first order (Prokopenko and Lebrun-Grandie, "Revising Apetrei's bounding volume hierarchy construction
//            algorithm to allow stackless traversal", 2024). Nothing can overflow, however deep the tree is.
//
// What follows the subtree of leaf i are exactly the leaves behind i: a mover that starts there finds each pair once,
// and never goes through what lies before it.
//
// A box much larger than the others would have a thread of its own find most of the scene. The bits for size, above
// the code, put the larger behind all smaller; so it is the many small boxes that find the giant, in parallel, and the
// giant, at the end of the order, has nothing left to find. The boxes of one size stay in a subtree without giants.
#pragma once

#include <cstdint>
#include <vector>

#include "bvh/scene_extent.hpp"
#include "bvh/tree_view.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "exec/reduce.hpp"
#include "exec/sort.hpp"
#include "math/box.hpp"

namespace plumb::impulse {

enum class MortonBits : std::uint32_t { k30 = 30, k63 = 63 };

/// Boxes in the order of the tree's leaves.
class MortonOrder {
 public:
  /// Makes room for up to `capacity` boxes and codes of that many bits. Not within a step.
  void reserve(std::uint32_t capacity, MortonBits bits);
  /// Enqueues the sorting of boxes[proxies[i]], i < n. extent: of these boxes, in the executor's memory.
  void sort(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n,
            const SceneExtent* extent, MortonBits bits);
  /// Leaf i is proxies[order()[i]].
  [[nodiscard]] const std::uint32_t* order() const { return order_.data(); }
  /// f(keys): the sorted codes of that many bits.
  template <class F>
  void with_codes(MortonBits bits, const F& f) const {
    bits == MortonBits::k30 ? f(keys_30_.sorted.data()) : f(keys_63_.sorted.data());
  }

 private:
  template <class K>
  struct Keys {
    Buffer<K> codes, sorted;
    RadixSort<K> sort;
  };
  template <class K>
  void reserve(Keys<K>& keys, std::uint32_t capacity);
  template <class K>
  void sort_by(Keys<K>& keys, Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n,
               const SceneExtent* extent);

  Keys<std::uint32_t> keys_30_;
  Keys<std::uint64_t> keys_63_;
  Buffer<std::uint32_t> indices_, order_;
};

class Lbvh {
 public:
  /// Makes room for trees of up to `capacity` boxes. Not within a step.
  void reserve(std::uint32_t capacity, MortonBits bits = MortonBits::k63);
  /// Enqueues the building of the tree of boxes[proxies[i]], i < n. extent: of these boxes, in the executor's memory.
  void build(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n,
             const SceneExtent* extent, MortonBits bits = MortonBits::k63);
  /// The tree that was enqueued last.
  [[nodiscard]] TreeView view() const { return {nodes_.data(), leaves_}; }
  /// Its nodes, copied to the host; for what looks at them from outside.
  [[nodiscard]] std::vector<TreeNode> nodes() const { return nodes_.to_host(leaves_ == 0 ? 0 : 2 * leaves_ - 1); }
  /// The nodes of that tree, built by now, to be kept elsewhere; nothing is left here but to reserve again.
  [[nodiscard]] Buffer<TreeNode> take_nodes() { return std::move(nodes_); }

 private:
  MortonOrder order_;
  Buffer<TreeNode> nodes_;
  Buffer<std::uint32_t> parents_;   // by node
  Buffer<std::uint32_t> seconds_;   // by split: its second child
  Buffer<std::uint32_t> arrivals_;  // by inner node
  std::uint32_t leaves_ = 0;
};

}  // namespace plumb::impulse
