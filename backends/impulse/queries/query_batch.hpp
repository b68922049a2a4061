// A batch of queries under way: its rows where kernels run, and its hits on the way back.
#pragma once

#include <span>

#include "plumb/queries.h"
#include "queries/batch_rows.hpp"
#include "queries/overlap_depth.hpp"
#include "queries/query_scene.hpp"
#include "queries/row_lists.hpp"

namespace plumb::impulse {

/// Used by one thread at a time. Hits live until the next batch. All wait until they are done.
class QueryBatch {
 public:
  std::span<const PlumbHit> rays(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                 std::span<const PlumbRay> rays);
  std::span<const PlumbHit> casts(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                  std::span<const PlumbCast> casts);
  std::span<const PlumbHit> turning_casts(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                          std::span<const PlumbTurningCast> casts);
  std::span<const PlumbHit> overlaps(Executor& executor, const QueryScene& scene,
                                     std::span<const PlumbOverlap> overlaps);
  std::span<const PlumbPenetration> penetrations(Executor& executor, const QueryScene& scene,
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
  std::uint32_t find_all(Executor& executor, const QueryScene& scene, const typename Probe::Row* rows, std::uint32_t n,
                         bool marks = false);
  /// Casts of either kind, of which those that overlap at their start are described.
  template <template <Kinds> class Probe, class Row>
  std::span<const PlumbHit> find_casts(Executor& executor, const QueryScene& scene, PlumbHitMode mode, const Row* rows,
                                       std::uint32_t n);
  std::uint32_t find_overlaps(Executor& executor, const QueryScene& scene, const PlumbOverlap* rows, std::uint32_t n,
                              bool marks);

  BatchRows<PlumbRay> rays_;
  BatchRows<PlumbCast> casts_;
  BatchRows<PlumbTurningCast> turning_casts_;
  BatchRows<PlumbOverlap> overlaps_;
  OverlapDepth depth_;
  RowLists<PlumbHit> hits_;
};

}  // namespace plumb::impulse
