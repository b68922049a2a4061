// The order of the tree for pairs that another method found: by the finder's place among the movers, then by that of
// its partner, statics last. The order of the pairs numbers the contacts, so that with it all methods give the same
// bits.
#pragma once

#include <bit>
#include <cstdint>

#include "broadphase/pairs.hpp"
#include "bvh/lbvh.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "exec/sort.hpp"

namespace plumb::impulse {

/// Pairs as keys that sort as the tree lists them.
struct PairKeys {
  const std::uint32_t* place;    ///< by proxy: of movers in the tree's order, then statics
  const std::uint32_t* proxies;  ///< by place
  int place_bits;
  std::uint64_t* keys;

  [[nodiscard]] PLUMB_HD std::uint64_t key(std::uint32_t proxy, std::uint32_t partner) const {
    const std::uint32_t a = place[proxy], b = place[partner];
    return static_cast<std::uint64_t>(min(a, b)) << place_bits | max(a, b);
  }
};

class PairOrder {
 public:
  void reserve(std::uint32_t movers, std::uint32_t statics, std::uint32_t pairs, MortonBits bits);

  /// Numbers movers and statics. extent: of the movers, in the executor's memory.
  void number(Executor& executor, const Box* boxes, const std::uint32_t* movers, std::uint32_t n,
              const SceneExtent* extent, MortonBits bits, const TreeView& statics);
  /// Where the keys of the pairs are to be written, in any order.
  [[nodiscard]] PairKeys keys() { return {place_.data(), proxies_.data(), place_bits_, keys_.data()}; }
  /// Sorts the first *count of them, as far as there are so many, into pairs, and finds each mover's.
  void list(Executor& executor, const std::uint32_t* count, Pair* pairs, PairRange* ranges_by_proxy);

 private:
  MortonOrder order_;
  Buffer<std::uint32_t> place_, proxies_;
  Buffer<std::uint64_t> keys_, sorted_;
  Buffer<std::uint32_t> unused_, unused_sorted_;  // values that go with the keys
  RadixSort<std::uint64_t> sort_;
  std::uint32_t movers_ = 0, statics_ = 0, pair_capacity_ = 0;
  int place_bits_ = 0;
};

}  // namespace plumb::impulse
