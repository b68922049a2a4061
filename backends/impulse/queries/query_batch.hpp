// A batch of queries under way: its rows where kernels run, and its hits on the way back.
#pragma once

#include <span>

#include "exec/sort.hpp"
#include "plumb/queries.h"
#include "queries/overlap_depth.hpp"
#include "queries/query_scene.hpp"

namespace plumb::impulse {

/// The rows of a batch where kernels run.
template <class Row>
class BatchRows {
 public:
  /// rows must stay as long as they are used.
  const Row* bring(std::span<const Row> rows) {
    if (kOneMemory) return rows.data();
    copy_.from_host(rows.data(), rows.size());
    return copy_.data();
  }

 private:
  Buffer<Row> copy_;
};

/// Used by one thread at a time. Hits live until the next batch. All wait until they are done.
class QueryBatch {
 public:
  std::span<const PlumbHit> rays(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                 std::span<const PlumbRay> rays);
  std::span<const PlumbHit> casts(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                  std::span<const PlumbCast> casts);
  std::span<const PlumbHit> overlaps(Executor& executor, const QueryScene& scene,
                                     std::span<const PlumbOverlap> overlaps);

  /// What closest rays are but for the way of rows and hits: enqueues only. Both are where kernels run.
  static void closest_rays(Executor& executor, const QueryScene& scene, const PlumbRay* rays, std::uint32_t n,
                           PlumbHit* hits);

 private:
  template <template <Kinds> class Probe, class Row>
  std::uint32_t find(Executor& executor, const QueryScene& scene, PlumbHitMode mode, const Row* rows, std::uint32_t n);
  template <class Probe>
  std::uint32_t find_of(Executor& executor, const QueryScene& scene, PlumbHitMode mode, const typename Probe::Row* rows,
                        std::uint32_t n);
  template <class Probe>
  std::uint32_t find_all(Executor& executor, const QueryScene& scene, const typename Probe::Row* rows, std::uint32_t n);
  std::uint32_t scan_counts(Executor& executor, std::uint32_t n, Buffer<std::uint32_t>& offsets);
  std::span<const PlumbHit> hand_out(Executor& executor, std::uint32_t count);

  BatchRows<PlumbRay> rays_;
  BatchRows<PlumbCast> casts_;
  BatchRows<PlumbOverlap> overlaps_;
  OverlapDepth depth_;
  Scan scan_;
  Buffer<std::uint32_t> counts_, offsets_, packed_offsets_, total_;
  Mirror<PlumbHit> hits_;
  Buffer<PlumbHit> found_;  // before those of one body are made one
};

}  // namespace plumb::impulse
