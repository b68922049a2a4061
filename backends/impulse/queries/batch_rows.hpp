// The rows of a batch of questions where kernels run.
#pragma once

#include <span>

#include "exec/memory.hpp"

namespace plumb::impulse {

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

}  // namespace plumb::impulse
