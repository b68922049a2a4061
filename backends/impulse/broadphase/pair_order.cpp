#include "broadphase/pair_order.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

struct PlaceMovers {
  const std::uint32_t *movers, *order;
  std::uint32_t *place, *proxies;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t proxy = movers[order[i]];
    proxies[i] = proxy;
    place[proxy] = i;
  }
};

struct PlaceStatics {
  TreeView tree;
  std::uint32_t movers;
  std::uint32_t *place, *proxies;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t proxy = tree.leaf(i).child;
    proxies[movers + i] = proxy;
    // A row that was nobody's when the tree was built may be a mover's by now.
    if (is_sound(tree.box(i))) place[proxy] = movers + i;
  }
};

struct PairsOfKeys {
  PairKeys sorted;
  std::uint32_t movers;
  Pair* pairs;
  PLUMB_HD void operator()(std::uint32_t k) const {
    const std::uint64_t key = sorted.keys[k];
    const auto first = static_cast<std::uint32_t>(key >> sorted.place_bits),
               second = static_cast<std::uint32_t>(key & ((std::uint64_t{1} << sorted.place_bits) - 1U));
    const std::uint32_t a = sorted.proxies[first], b = sorted.proxies[second];
    pairs[k] = second >= movers || a < b ? Pair{a, b} : Pair{b, a};
  }
};

struct RangesOfKeys {
  PairKeys sorted;
  Count count;
  PairRange* ranges;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t first = first_of(i);
    ranges[sorted.proxies[i]] = {first, first_of(i + 1) - first};
  }

 private:
  /// The first key of a mover at this place or behind it.
  [[nodiscard]] PLUMB_HD std::uint32_t first_of(std::uint32_t place) const {
    std::uint32_t low = 0, high = min(*count.value, count.capacity);
    while (low < high) {
      const std::uint32_t middle = low + (high - low) / 2;
      if (sorted.keys[middle] >> sorted.place_bits < place)
        low = middle + 1;
      else
        high = middle;
    }
    return low;
  }
};

}  // namespace

void PairOrder::reserve(std::uint32_t movers, std::uint32_t statics, std::uint32_t pairs, MortonBits bits) {
  order_.reserve(movers, bits);
  place_.grow(std::size_t{movers} + statics);
  proxies_.grow(std::size_t{movers} + statics);
  pair_capacity_ = max(pair_capacity_, pairs);
  keys_.grow(pair_capacity_);
  sorted_.grow(pair_capacity_);
  unused_.grow(pair_capacity_);
  unused_sorted_.grow(pair_capacity_);
  sort_.reserve(pair_capacity_);
}

void PairOrder::number(Executor& executor, const Box* boxes, const std::uint32_t* movers, std::uint32_t n,
                       const SceneExtent* extent, MortonBits bits, const TreeView& statics) {
  PLUMB_ASSERT(n + std::size_t{statics.leaves} <= place_.size());
  movers_ = n;
  statics_ = statics.leaves;
  place_bits_ = static_cast<int>(std::bit_width(n + statics_));
  order_.sort(executor, boxes, movers, n, extent, bits);
  executor.run(n, PlaceMovers{movers, order_.order(), place_.data(), proxies_.data()});
  executor.run(statics_, PlaceStatics{statics, n, place_.data(), proxies_.data()});
}

void PairOrder::list(Executor& executor, const std::uint32_t* count, Pair* pairs, PairRange* ranges_by_proxy) {
  const Count all = {count, pair_capacity_};
  PLUMB_ASSERT(place_bits_ + static_cast<int>(std::bit_width(movers_)) <= 64);
  const int bits = place_bits_ + static_cast<int>(std::bit_width(movers_));
  sort_.run(executor, all, keys_.data(), unused_.data(), sorted_.data(), unused_sorted_.data(), bits);
  PairKeys sorted = keys();
  sorted.keys = sorted_.data();
  executor.run(all, PairsOfKeys{sorted, movers_, pairs});
  executor.run(movers_, RangesOfKeys{sorted, all, ranges_by_proxy});
}

}  // namespace plumb::impulse
