// The broad phase: all pairs of proxies whose boxes overlap and that the filter lets through, each once, in an order
// that depends on nothing but the boxes.
//
// Movers among themselves are found by one of three methods, as a setting: a tree (lbvh.hpp), sort and sweep
// (sweep.hpp) or a uniform grid (grid.hpp). All list the same pairs in the same order, which is that of the tree: what
// the other two find is sorted into it (pair_order.hpp). Statics lie in a tree of their own, which is built when they
// change and asked by every mover.
//
// Every mover is looked up once: it notes the first few partners, a scan of the counts gives it its place in the list,
// and it copies them there; only who found more than it could note looks again. On a device a search that takes very
// long is dealt out to many threads (long_search.hpp).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "broadphase/grid.hpp"
#include "broadphase/pair_filter.hpp"
#include "broadphase/pair_order.hpp"
#include "broadphase/pairs.hpp"
#include "broadphase/sweep.hpp"
#include "bvh/lbvh.hpp"
#include "bvh/scene_extent.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "exec/reduce.hpp"
#include "exec/sort.hpp"
#include "math/box.hpp"

namespace plumb::impulse {

class BroadPhase {
 public:
  enum class Method : std::uint32_t { kLbvh, kSweep, kGrid };
  enum class Tree : std::uint32_t { kMovers, kStatics };

  Method method = Method::kLbvh;                    ///< reserve after a change
  MortonBits morton_bits = MortonBits::k63;         ///< reserve after a change
  bool deals_out_long_searches = Executor::kWarps;  ///< of the tree; reserve after a change

  /// Makes room for that many movers, statics and pairs with the method, and gives back what another one had. Only
  /// between steps.
  void reserve(Executor& executor, std::uint32_t movers, std::uint32_t statics, std::uint32_t pairs);

  /// The statics are boxes[proxies[i]], i < n. Only between steps; enqueues. Boxes are copied into the tree.
  void build_statics(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n);

  /// Enqueues only. The movers are boxes[movers[i]]; more than were reserved are an Error. All pointers are the
  /// executor's memory, and are read and written when the kernels run. A recording of this holds their number, that of
  /// statics and the settings. A box that is not sound (scene_extent.hpp) touches nothing.
  /// `pairs` of reserve() at most are written, and which of them where there are more is the method's.
  void find_pairs(Executor& executor, const Box* boxes, const ProxyRows& movers, const PairFilter& filter,
                  const PairList& found);

  /// As it was built last, for kernels of the same step.
  [[nodiscard]] TreeView statics() const { return statics_.view(); }
  /// Nodes of a tree as it was built last, copied to the host; none of movers where the method has no tree.
  [[nodiscard]] std::vector<TreeNode> nodes(Tree tree) const {
    if (tree == Tree::kStatics) return statics_.nodes();
    return movers_ ? movers_->nodes() : std::vector<TreeNode>();
  }
  /// Which of the parts that not every method uses are there; one that is not holds no memory.
  struct Parts {
    bool tree = false, sweep = false, grid = false, order = false;
    bool operator==(const Parts&) const = default;
  };
  [[nodiscard]] Parts parts() const {
    return {movers_.has_value(), sweep_.has_value(), grid_.has_value(), order_.has_value()};
  }

 private:
  void list_of_tree(Executor& executor, const PairFilter& filter, const PairList& found);
  template <class Movers>
  void list_in_order(Executor& executor, const Movers& movers, const Box* boxes, const ProxyRows& list,
                     const PairFilter& filter, const PairList& found);

  Reduce<SceneExtent> reduce_;
  Buffer<SceneExtent> extent_;
  Lbvh statics_;
  std::optional<Lbvh> movers_;
  std::optional<Sweep> sweep_;
  std::optional<Grid> grid_;
  std::optional<PairOrder> order_;  // of what is not found by the tree
  Scan scan_;
  Buffer<std::uint32_t> counts_, offsets_, noted_;
  Buffer<std::uint32_t> long_movers_, long_parts_, long_counts_;  // where long searches are dealt out
  std::uint32_t mover_capacity_ = 0, static_capacity_ = 0, pair_capacity_ = 0;
};

}  // namespace plumb::impulse
