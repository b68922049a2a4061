// Searches of the tree that would keep one thread busy while all others have long ended: of a box so much larger than
// the others that it touches thousands of them. Where neighbouring boxes are searched for in step, as on a GPU, such a
// search is given up after a few hundred nodes, and its leaves are dealt out to many threads in equal parts. A part
// counts what it finds, the counts of a search are summed up, and each part writes behind the one before: the pairs
// come in the order in which one thread would have found them.
#pragma once

#include "broadphase/search.hpp"
#include "exec/atomic.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"

namespace plumb::impulse {

struct LongSearches {
  static constexpr std::uint32_t kVisits = 512;  ///< nodes after which a search is a long one
  static constexpr std::uint32_t kParts = 256;
  static constexpr std::uint32_t kMost = 1024;  ///< where there are more they keep all threads busy as they are
  static constexpr std::uint32_t kDealtOut = ~0U;

  std::uint32_t* movers;  ///< by long search
  std::uint32_t* parts;   ///< how many of all of them
  std::uint32_t* counts;  ///< by part; after SumParts what the parts before it in its search found

  /// Whether there is room for one more.
  PLUMB_HD bool add(std::uint32_t mover) const {
    const std::uint32_t place = atomic_add(parts, kParts) / kParts;
    if (place < kMost) movers[place] = mover;
    return place < kMost;
  }
};

/// found(proxy) for every leaf first .. end - 1, in order, whose box touches `box`; at most `visits` nodes are looked
/// at. Returns how many visits are left: 0 where there was more to see.
template <class Found>
PLUMB_HD std::uint32_t overlaps_among(const TreeView& tree, const Box& box, std::uint32_t first, std::uint32_t end,
                                      std::uint32_t visits, Found& found) {
  const BoxQuery query(box);
  std::uint32_t id = first == 0 ? tree.root() : first < tree.leaves ? tree.leaf(first - 1).next : TreeView::kEnd;
  while (id != TreeView::kEnd && first < end) {
    if (visits-- == 0) return 0;
    const TreeNode node = tree.nodes[id];
    const bool hit = query.touches(node), inner = TreeView::is_inner(id);
    if (hit && !inner) found(node.child);
    const bool descend = hit && inner;
    id = descend ? node.child : node.next;
    first = descend ? first : id / 2;  // what follows a subtree bears the number of its first leaf
  }
  return visits;
}

/// As CountPartners of the tree, but for the long ones.
struct CountShortSearches {
  Search<TreeMovers> search;
  std::uint32_t *notes, *counts;
  LongSearches longs;

  PLUMB_HD void operator()(std::uint32_t i) const {
    const TreeView& tree = search.movers.tree;
    const std::uint32_t proxy = search.movers.proxy(i);
    std::uint32_t* own_notes = notes + std::size_t{i} * kNotes;
    NotePartners sink{own_notes, 0};
    const Box box = search.movers.box(i);
    Filtered<NotePartners> found{search.filter, search.filter.proxies[proxy], 0, sink};
    std::uint32_t visits = overlaps_among(tree, box, i + 1, tree.leaves, LongSearches::kVisits, found);
    found.mark = kStaticMark;
    if (visits != 0) visits = overlaps_among(search.statics, box, 0, search.statics.leaves, visits, found);
    if (visits == 0) {
      sink = {own_notes, 0};
      if (longs.add(i))
        own_notes[0] = LongSearches::kDealtOut;
      else
        search(i, proxy, sink);
    }
    counts[i] = sink.count;
  }
};

/// The leaves of a search that are a part's: movers behind the one that searches, then statics.
struct PartOfSearch {
  Search<TreeMovers> search;
  LongSearches longs;

  template <class Sink>
  PLUMB_HD void operator()(std::uint32_t part, Sink& sink) const {
    const TreeView &tree = search.movers.tree, &statics = search.statics;
    const std::uint32_t i = longs.movers[part / LongSearches::kParts], number = part % LongSearches::kParts;
    const std::uint32_t behind = tree.leaves - (i + 1), all = behind + statics.leaves;
    const std::uint32_t width = (all + LongSearches::kParts - 1) / LongSearches::kParts;
    const std::uint32_t first = min(all, number * width), end = min(all, first + width);
    const Box box = search.movers.box(i);
    Filtered<Sink> found{search.filter, search.filter.proxies[search.movers.proxy(i)], 0, sink};
    overlaps_among(tree, box, i + 1 + min(first, behind), i + 1 + min(end, behind), ~0U, found);
    found.mark = kStaticMark;
    overlaps_among(statics, box, max(first, behind) - behind, max(end, behind) - behind, ~0U, found);
  }
};

struct CountPart {
  PartOfSearch search;
  PLUMB_HD void operator()(std::uint32_t part) const {
    struct {
      std::uint32_t count;
      PLUMB_HD void operator()(std::uint32_t) { ++count; }
    } sink{0};
    search(part, sink);
    search.longs.counts[part] = sink.count;
  }
};

struct SumParts {
  LongSearches longs;
  std::uint32_t* counts;  ///< by mover
  PLUMB_HD void operator()(std::uint32_t i) const {
    if (i * LongSearches::kParts >= *longs.parts) return;
    constexpr std::uint32_t kAtOnce = 16;  // are on their way from memory together
    std::uint32_t sum = 0;
    for (std::uint32_t first = 0; first < LongSearches::kParts; first += kAtOnce) {
      std::uint32_t* of_parts = longs.counts + i * LongSearches::kParts + first;
      std::uint32_t own[kAtOnce];
      for (std::uint32_t k = 0; k < kAtOnce; ++k) own[k] = of_parts[k];
      for (std::uint32_t k = 0; k < kAtOnce; ++k) {
        of_parts[k] = sum;
        sum += own[k];
      }
    }
    counts[longs.movers[i]] = sum;
  }
};

struct ListPart {
  PartOfSearch search;
  const std::uint32_t* offsets;  ///< by mover
  Pair* pairs;
  std::uint32_t capacity;
  PLUMB_HD void operator()(std::uint32_t part) const {
    const std::uint32_t mover = search.longs.movers[part / LongSearches::kParts];
    const std::uint32_t first = min(offsets[mover], capacity);
    const std::uint32_t at = first + min(search.longs.counts[part], capacity - first);
    WritePairs sink{pairs, search.search.movers.proxy(mover), at, capacity};
    search(part, sink);
  }
};

}  // namespace plumb::impulse
