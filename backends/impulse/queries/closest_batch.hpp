// A batch of queries for the closest bodies under way.
#pragma once

#include <span>

#include "plumb/closest.h"
#include "queries/batch_rows.hpp"
#include "queries/query_scene.hpp"
#include "queries/row_lists.hpp"

namespace plumb::impulse {

/// Used by one thread at a time. Rows live until the next batch.
class ClosestBatch {
 public:
  /// Waits until it is done.
  std::span<const PlumbClosest> find(Executor& executor, const QueryScene& scene, PlumbHitMode mode,
                                     std::span<const PlumbProbe> probes);

 private:
  template <class Probe>
  std::uint32_t find_of(Executor& executor, const QueryScene& scene, PlumbHitMode mode, const PlumbProbe* probes,
                        std::uint32_t n);

  BatchRows<PlumbProbe> probes_;
  RowLists<PlumbClosest> rows_;
};

}  // namespace plumb::impulse
