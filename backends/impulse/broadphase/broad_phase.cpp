#include "broadphase/broad_phase.hpp"

#include <string>

#include "plumb/physics_world.hpp"
#if !defined(PLUMB_IMPULSE_CUDA)
#include "broadphase/group_search.hpp"
#endif

namespace plumb::impulse {

namespace {

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

struct WritePairs {
  Pair* pairs;
  std::uint32_t proxy, at, capacity;
  PLUMB_HD void operator()(std::uint32_t partner) {
    if (at >= capacity) return;
    const std::uint32_t other = partner & ~kStaticMark;
    pairs[at++] = partner != other || proxy < other ? Pair{proxy, other} : Pair{other, proxy};
  }
};

template <class Movers>
struct CountPartners {
  Search<Movers> search;
  std::uint32_t *notes, *counts;
  PLUMB_HD void operator()(std::uint32_t i) const {
    NotePartners sink{notes + std::size_t{i} * kNotes, 0};
    search(i, search.movers.proxy(i), sink);
    counts[i] = sink.count;
  }
};

template <class Movers>
void count_partners(Executor& executor, std::uint32_t n, const CountPartners<Movers>& count) {
  executor.run(n, count);
}

#if !defined(PLUMB_IMPULSE_CUDA)
/// The same for a group of neighbours in the tree.
struct CountPartnersOfGroup {
  CountPartners<TreeMovers> alone;
  std::uint32_t n;

  void operator()(std::uint32_t g) const {
    const std::uint32_t end = min(n, (g + 1) * BoxGroup::kMost);
    for (std::uint32_t first = g * BoxGroup::kMost; first < end;) {
      std::uint32_t width = end - first;
      while (width > 1 && !count(first, width)) width /= 2;
      if (width == 1) alone(first);
      first += width;
    }
  }

 private:
  struct NotesOfGroup {
    const PairFilter& filter;
    NotePartners sinks[BoxGroup::kMost];
    const ProxyFilter* own[BoxGroup::kMost];
    void operator()(std::uint32_t k, std::uint32_t proxy, bool is_static) {
      if (filter(*own[k], filter.proxies[proxy])) sinks[k](is_static ? proxy | kStaticMark : proxy);
    }
  };
  [[nodiscard]] bool count(std::uint32_t first, std::uint32_t width) const {
    const Search<TreeMovers>& search = alone.search;
    const TreeView& tree = search.movers.tree;
    NotesOfGroup found{search.filter, {}, {}};
    for (std::uint32_t k = 0; k < width; ++k) {
      found.sinks[k] = {alone.notes + std::size_t{first + k} * kNotes, 0};
      found.own[k] = &search.filter.proxies[tree.leaf(first + k).child];
    }
    if (!search_group(tree, search.statics, first, width, found)) return false;
    for (std::uint32_t k = 0; k < width; ++k) alone.counts[first + k] = found.sinks[k].count;
    return true;
  }
};

void count_partners(Executor& executor, std::uint32_t n, const CountPartners<TreeMovers>& count) {
  executor.run((n + BoxGroup::kMost - 1) / BoxGroup::kMost, CountPartnersOfGroup{count, n});
}
#endif

template <class Movers>
struct ListPairs {
  Search<Movers> search;
  const std::uint32_t *notes, *counts, *offsets;
  Pair* pairs;
  std::uint32_t capacity;
  PairRange* ranges;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t proxy = search.movers.proxy(i), count = counts[i], first = min(offsets[i], capacity);
    ranges[proxy] = {first, min(count, capacity - first)};
    WritePairs sink{pairs, proxy, first, capacity};
    if (count > kNotes) {
      search(i, proxy, sink);
    } else {
      for (std::uint32_t k = 0; k < count; ++k) sink(notes[std::size_t{i} * kNotes + k]);
    }
  }
};

void require(const char* what, std::uint32_t n, std::uint32_t capacity) {
  if (n > capacity)
    throw Error(PLUMB_E_INTERNAL, "the broad phase got " + std::to_string(n) + " " + what + " and has room for " +
                                      std::to_string(capacity) + "; reserve it before");
}

}  // namespace

void BroadPhase::reserve(Executor& /*executor*/, std::uint32_t movers, std::uint32_t statics, std::uint32_t pairs) {
  mover_capacity_ = max(mover_capacity_, movers);
  static_capacity_ = max(static_capacity_, statics);
  pair_capacity_ = max(pair_capacity_, pairs);
  reduce_.reserve(max(mover_capacity_, static_capacity_));
  extent_.grow(1);
  movers_.reserve(mover_capacity_);
  sweep_.reserve(mover_capacity_);
  grid_.reserve(mover_capacity_);
  statics_.reserve(static_capacity_);
  scan_.reserve(mover_capacity_);
  counts_.grow(mover_capacity_);
  offsets_.grow(mover_capacity_);
  noted_.grow(std::size_t{mover_capacity_} * kNotes);
}

void BroadPhase::build_statics(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n) {
  require("statics", n, static_capacity_);
  reduce_.run(executor, n, LoadExtent{boxes, proxies}, extent_.data());
  statics_.build(executor, boxes, proxies, n, extent_.data(), morton_bits);
}

void BroadPhase::find_pairs(Executor& executor, const Box* boxes, const std::uint32_t* movers, std::uint32_t n,
                            const PairFilter& filter, Pair* pairs, PairRange* ranges_by_proxy,
                            std::uint32_t* pair_count) {
  require("movers", n, mover_capacity_);
  reduce_.run(executor, n, LoadExtent{boxes, movers}, extent_.data());
  const auto list = [&](const auto& ordered) {
    list_pairs(executor, ordered, n, filter, pairs, ranges_by_proxy, pair_count);
  };
  switch (method) {
    case Method::kLbvh:
      movers_.build(executor, boxes, movers, n, extent_.data(), morton_bits);
      return list(TreeMovers{movers_.view()});
    case Method::kSweepAndPrune: sweep_.build(executor, boxes, movers, n, extent_.data()); return list(sweep_.view());
    case Method::kGrid: grid_.build(executor, boxes, movers, n, extent_.data()); return list(grid_.view());
  }
}

template <class Movers>
void BroadPhase::list_pairs(Executor& executor, const Movers& movers, std::uint32_t n, const PairFilter& filter,
                            Pair* pairs, PairRange* ranges_by_proxy, std::uint32_t* pair_count) {
  const Search<Movers> search{movers, statics_.view(), filter};
  count_partners(executor, n, CountPartners<Movers>{search, noted_.data(), counts_.data()});
  scan_.run(executor, n, counts_.data(), offsets_.data(), pair_count);
  executor.run(n, ListPairs<Movers>{search, noted_.data(), counts_.data(), offsets_.data(), pairs, pair_capacity_,
                                    ranges_by_proxy});
}

}  // namespace plumb::impulse
