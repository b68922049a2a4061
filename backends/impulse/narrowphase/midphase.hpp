// The midphase, in scenes with planes, meshes or height fields: which triangles of a surface are worth a look.
//
// A pair of the broad phase that has a surface becomes one candidate for each of its triangles whose box the other
// shape's box touches, in the surface's own frame; any other pair is one candidate. Where the two have hardly moved
// against each other, so that all that touched may be recycled, that is all there is to look at. Planes have no box:
// each is held against every mover here.
#pragma once

#include "bodies/step_counters.hpp"
#include "broadphase/pair_filter.hpp"
#include "exec/sort.hpp"
#include "narrowphase/narrow_phase_work.hpp"

namespace plumb::impulse {

class Midphase {
 public:
  void reserve(std::uint32_t proxies, std::uint32_t pairs);

  /// Where the broad phase writes what it finds.
  [[nodiscard]] Pair* pairs() { return pairs_.data(); }
  [[nodiscard]] PairRange* ranges() { return ranges_.data(); }

  /// What this reads of the world.
  struct Input {
    NarrowPhaseWork work;
    PairFilter filter;
    const Box* boxes;
    ProxyRows movers, planes;
  };
  /// Writes pairs, triangles, ranges and touching (0 or kCarried) of work.cache, and counters->midphase_pairs. More
  /// candidates than there is room for count as so many pairs. swept: what some bodies must not pass through in the
  /// step is found, too.
  void find(Executor& executor, const Input& input, StepCounters* counters, bool swept);

 private:
  Buffer<Pair> pairs_;
  Buffer<PairRange> ranges_;
  Buffer<std::uint32_t> counts_, offsets_;  // by mover
  Scan scan_;
  std::uint32_t capacity_ = 0;
};

}  // namespace plumb::impulse
