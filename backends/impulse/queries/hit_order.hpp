// The order of hits, and sorting those of one query where one thread does it.
#pragma once

#include "plumb/queries.h"
#include "queries/probes.hpp"

namespace plumb::impulse {

/// The order in which hits of a query are handed out.
struct NearerHit {
  PLUMB_HD bool operator()(const PlumbHit& a, const PlumbHit& b) const {
    if (a.fraction != b.fraction) return a.fraction < b.fraction;
    if (a.body != b.body) return row_of(a.body) < row_of(b.body);
    return a.child < b.child;
  }
};
/// The hits of a body side by side, its nearest first.
struct SameBodyHit {
  PLUMB_HD bool operator()(const PlumbHit& a, const PlumbHit& b) const {
    if (a.body != b.body) return row_of(a.body) < row_of(b.body);
    if (a.fraction != b.fraction) return a.fraction < b.fraction;
    return a.child < b.child;
  }
};

/// Heap sort (Williams 1964): in place, never slow, and equal wherever it runs. No two hits are equal in either order.
template <class Hit, class Less>
PLUMB_HD void sort_hits(Hit* hits, std::uint32_t n, const Less& less) {
  const auto sink = [&](std::uint32_t root, std::uint32_t end) {
    const Hit hit = hits[root];
    for (std::uint32_t child = 2 * root + 1; child < end; child = 2 * root + 1) {
      if (child + 1 < end && less(hits[child], hits[child + 1])) ++child;
      if (!less(hit, hits[child])) break;
      hits[root] = hits[child];
      root = child;
    }
    hits[root] = hit;
  };
  for (std::uint32_t root = n / 2; root-- > 0;) sink(root, n);
  for (std::uint32_t end = n; end-- > 1;) {
    const Hit last = hits[end];
    hits[end] = hits[0];
    hits[0] = last;
    sink(0, end);
  }
}

/// Keeps the first of each body of hits that lie side by side. Returns how many those are.
template <class Hit>
PLUMB_HD std::uint32_t keep_first_of_bodies(Hit* hits, std::uint32_t n) {
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < n; ++i)
    if (i == 0 || hits[i].body != hits[kept - 1].body) hits[kept++] = hits[i];
  return kept;
}

}  // namespace plumb::impulse
