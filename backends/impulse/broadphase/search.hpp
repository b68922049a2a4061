// What a mover finds: movers behind it in the order of a method, then statics, as far as the filter lets them through.
#pragma once

#include <cstdint>

#include "broadphase/pair_filter.hpp"
#include "broadphase/pairs.hpp"
#include "bvh/tree_view.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kNotes = 32;             // partners that a mover notes while it counts; few find more
constexpr std::uint32_t kStaticMark = 1U << 31;  // marks a noted partner as a static: proxies are fewer than 2^31

/// Movers in the order of a method, and what each finds behind itself there.
struct TreeMovers {
  TreeView tree;
  [[nodiscard]] PLUMB_HD std::uint32_t proxy(std::uint32_t i) const { return tree.leaf(i).child; }
  [[nodiscard]] PLUMB_HD Box box(std::uint32_t i) const { return tree.box(i); }
  template <class Found>
  PLUMB_HD void overlaps(std::uint32_t i, const Box& box, Found& found) const {
    tree.overlaps(box, tree.leaf(i).next, found);
  }
};

/// Passes on what the filter lets through.
template <class Sink>
struct Filtered {
  const PairFilter& filter;
  const ProxyFilter own;
  std::uint32_t mark;
  Sink& sink;
  PLUMB_HD void operator()(std::uint32_t proxy) {
    if (filter(own, filter.proxies[proxy])) sink(proxy | mark);
  }
};

template <class Movers>
struct Search {
  Movers movers;
  TreeView statics;
  PairFilter filter;

  /// sink(partner) for every partner that mover i finds, statics marked and last.
  template <class Sink>
  PLUMB_HD void operator()(std::uint32_t i, std::uint32_t proxy, Sink& sink) const {
    const Box box = movers.box(i);
    Filtered<Sink> found{filter, filter.proxies[proxy], 0, sink};
    movers.overlaps(i, box, found);
    found.mark = kStaticMark;
    statics.overlaps(box, statics.root(), found);
  }
};

struct NotePartners {
  std::uint32_t* notes;
  std::uint32_t count;
  PLUMB_HD void operator()(std::uint32_t partner) {
    if (count < kNotes) notes[count] = partner;
    ++count;
  }
};

/// Writes pairs of a proxy one after the other, as far as there is room.
struct WritePairs {
  Pair* pairs;
  std::uint32_t proxy, at, capacity;
  PLUMB_HD void operator()(std::uint32_t partner) {
    if (at >= capacity) return;
    const std::uint32_t other = partner & ~kStaticMark;
    pairs[at++] = partner != other || proxy < other ? Pair{proxy, other} : Pair{other, proxy};
  }
};

}  // namespace plumb::impulse
