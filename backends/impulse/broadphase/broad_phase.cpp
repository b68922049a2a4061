#include "broadphase/broad_phase.hpp"

#include <string>

#include "broadphase/long_search.hpp"
#include "broadphase/search.hpp"
#include "plumb/physics_world.hpp"
#if !defined(PLUMB_IMPULSE_CUDA)
#include "broadphase/group_search.hpp"
#endif

namespace plumb::impulse {

namespace {

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
#endif

/// What was noted, or where that is not all what is found again.
template <class Movers, class Sink>
PLUMB_HD void write_partners(const Search<Movers>& search, std::uint32_t i, std::uint32_t proxy,
                             const std::uint32_t* notes, std::uint32_t count, Sink& sink) {
  if (count > kNotes) return search(i, proxy, sink);
  for (std::uint32_t k = 0; k < count; ++k) sink(notes[k]);
}

struct ListPairs {
  Search<TreeMovers> search;
  const std::uint32_t *notes, *counts, *offsets;
  Pair* pairs;
  std::uint32_t capacity;
  PairRange* ranges;
  bool deals_out;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t proxy = search.movers.proxy(i), count = counts[i], first = min(offsets[i], capacity);
    ranges[proxy] = {first, min(count, capacity - first)};
    const std::uint32_t* own_notes = notes + std::size_t{i} * kNotes;
    if (deals_out && own_notes[0] == LongSearches::kDealtOut) return;
    WritePairs sink{pairs, proxy, first, capacity};
    write_partners(search, i, proxy, own_notes, count, sink);
  }
};

/// Writes the keys of a proxy's pairs one after the other, as far as there is room.
struct WriteKeys {
  const PairKeys& to;
  std::uint32_t proxy, at, capacity;
  PLUMB_HD void operator()(std::uint32_t partner) {
    if (at < capacity) to.keys[at++] = to.key(proxy, partner & ~kStaticMark);
  }
};

template <class Movers>
struct ListPairKeys {
  Search<Movers> search;
  const std::uint32_t *notes, *counts, *offsets;
  PairKeys to;
  std::uint32_t capacity;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t proxy = search.movers.proxy(i);
    WriteKeys sink{to, proxy, offsets[i], capacity};
    write_partners(search, i, proxy, notes + std::size_t{i} * kNotes, counts[i], sink);
  }
};

struct ClearNumber {
  std::uint32_t* number;
  PLUMB_HD void operator()(std::uint32_t) const { *number = 0; }
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
  const auto only_if = [](bool chosen, auto& part, const auto&... room) {
    if (!chosen) return part.reset();
    if (!part) part.emplace();
    part->reserve(room...);
  };
  only_if(method == Method::kLbvh, movers_, mover_capacity_, morton_bits);
  only_if(method == Method::kSweep, sweep_, mover_capacity_);
  only_if(method == Method::kGrid, grid_, mover_capacity_);
  only_if(method != Method::kLbvh, order_, mover_capacity_, static_capacity_, pair_capacity_, morton_bits);
  statics_.reserve(static_capacity_, morton_bits);
  scan_.reserve(mover_capacity_);
  counts_.grow(mover_capacity_);
  offsets_.grow(mover_capacity_);
  noted_.grow(std::size_t{mover_capacity_} * kNotes);
  if (!deals_out_long_searches) return;
  long_movers_.grow(LongSearches::kMost);
  long_parts_.grow(1);
  long_counts_.grow(std::size_t{LongSearches::kMost} * LongSearches::kParts);
}

void BroadPhase::build_statics(Executor& executor, const Box* boxes, const std::uint32_t* proxies, std::uint32_t n) {
  require("statics", n, static_capacity_);
  reduce_.run(executor, n, LoadExtent{boxes, proxies}, extent_.data());
  statics_.build(executor, boxes, proxies, n, extent_.data(), morton_bits);
}

void BroadPhase::find_pairs(Executor& executor, const Box* boxes, const ProxyRows& movers, const PairFilter& filter,
                            const PairList& found) {
  const std::uint32_t n = movers.count;
  require("movers", n, mover_capacity_);
  reduce_.run(executor, n, LoadExtent{boxes, movers.rows}, extent_.data());
  const auto list = [&](auto& ordered) {
    ordered.build(executor, boxes, movers.rows, n, extent_.data());
    list_in_order(executor, ordered.view(), boxes, movers, filter, found);
  };
  switch (method) {
    case Method::kLbvh:
      movers_->build(executor, boxes, movers.rows, n, extent_.data(), morton_bits);
      return list_of_tree(executor, filter, found);
    case Method::kSweep: return list(*sweep_);
    case Method::kGrid: return list(*grid_);
  }
}

void BroadPhase::list_of_tree(Executor& executor, const PairFilter& filter, const PairList& found) {
  const Search<TreeMovers> search{{movers_->view()}, statics_.view(), filter};
  const std::uint32_t n = search.movers.tree.leaves;
  const LongSearches longs{long_movers_.data(), long_parts_.data(), long_counts_.data()};
  const Count parts{longs.parts, LongSearches::kMost * LongSearches::kParts};
  // A tree has two nodes a leaf: among few leaves no search is long.
  const bool deals_out = deals_out_long_searches && 2 * (n + search.statics.leaves) > LongSearches::kVisits;
  if (deals_out) {
    executor.run(1U, ClearNumber{longs.parts});
    executor.run(n, CountShortSearches{search, noted_.data(), counts_.data(), longs});
    executor.run(parts, CountPart{{search, longs}});
    executor.run(LongSearches::kMost, SumParts{longs, counts_.data()});
  } else {
    const CountPartners<TreeMovers> count{search, noted_.data(), counts_.data()};
#if defined(PLUMB_IMPULSE_CUDA)
    executor.run(n, count);
#else
    executor.run((n + BoxGroup::kMost - 1) / BoxGroup::kMost, CountPartnersOfGroup{count, n});
#endif
  }
  scan_.run(executor, n, counts_.data(), offsets_.data(), found.count);
  executor.run(n, ListPairs{search, noted_.data(), counts_.data(), offsets_.data(), found.pairs, pair_capacity_,
                            found.ranges, deals_out});
  if (deals_out) executor.run(parts, ListPart{{search, longs}, offsets_.data(), found.pairs, pair_capacity_});
}

/// Of a method that finds them in another order than the tree.
template <class Movers>
void BroadPhase::list_in_order(Executor& executor, const Movers& movers, const Box* boxes, const ProxyRows& list,
                               const PairFilter& filter, const PairList& found) {
  const std::uint32_t n = list.count;
  const Search<Movers> search{movers, statics_.view(), filter};
  order_->number(executor, boxes, list.rows, n, extent_.data(), morton_bits, search.statics);
  executor.run(n, CountPartners<Movers>{search, noted_.data(), counts_.data()});
  scan_.run(executor, n, counts_.data(), offsets_.data(), found.count);
  executor.run(
      n, ListPairKeys<Movers>{search, noted_.data(), counts_.data(), offsets_.data(), order_->keys(), pair_capacity_});
  order_->list(executor, found.count, found.pairs, found.ranges);
}

}  // namespace plumb::impulse
