// Components of a graph by union-find without locks, an edge a thread: a root is hooked below a smaller one, so the
// root of a component is its smallest body, whatever the order of the threads (Jayanti and Tarjan, "A randomized
// concurrent algorithm for disjoint set union", PODC 2016, with indices for random numbers).
#pragma once

#include "exec/atomic.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

/// Hooks the larger below the smaller. Where the larger was hooked already, to another, the two are still to be united.
/// parent(i): where the parent of i is; at first i itself.
template <class Parent>
PLUMB_HD void unite(const Parent& parent, std::uint32_t a, std::uint32_t b) {
  while (a != b) {
    const std::uint32_t larger = max(a, b), smaller = min(a, b);
    PLUMB_ASSERT(*parent(larger) <= larger);  // trees hang below smaller ones: no way goes round
    const std::uint32_t before = atomic_min(parent(larger), smaller);
    if (before == larger) return;
    a = before;
    b = smaller;
  }
}

/// When all are united.
template <class Parent>
PLUMB_HD std::uint32_t find_root(const Parent& parent, std::uint32_t i) {
  while (*parent(i) != i) i = *parent(i);
  return i;
}

}  // namespace plumb::impulse
