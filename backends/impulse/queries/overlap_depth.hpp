// Shapes that overlap a body, casts from their start on: where, how deep, and which way out, as the narrow phase's
// contact tells.
#pragma once

#include <limits>
#include <span>

#include "exec/sort.hpp"
#include "plumb/queries.h"
#include "queries/pair_contacts.hpp"
#include "queries/query_scene.hpp"

namespace plumb::impulse {

/// Until it is described such a hit holds its proxy in place of the position.
PLUMB_HD inline void mark_overlap(std::uint32_t proxy, PlumbHit& hit) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  hit.position = {static_cast<double>(proxy), kUnknown, kUnknown};
  hit.normal = {kUnknown, kUnknown, kUnknown};
}

class OverlapDepth {
 public:
  /// Fills in the marked ones among the first n hits. casts: PlumbCast or PlumbTurningCast, by query. Both are where
  /// kernels run.
  template <class Cast>
  void describe(Executor& executor, const QueryScene& scene, const Cast* casts, PlumbHit* hits, std::uint32_t n);

  /// Of n hits, all of them marked, in their order. overlaps: by query. Both are where kernels run, the answer where
  /// the host reads it, until the next; waits.
  std::span<PlumbPenetration> tell(Executor& executor, const QueryScene& scene, const PlumbOverlap* overlaps,
                                   const PlumbHit* hits, std::uint32_t n);

 private:
  Scan scan_;
  Buffer<std::uint32_t> marked_, rows_, total_;
  Buffer<PosedPair> pairs_;
  Buffer<PairAnswer> answers_;
  Mirror<PlumbPenetration> told_;
};

}  // namespace plumb::impulse
