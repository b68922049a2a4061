// What a batch of queries finds, where each may find several: counted, then written side by side, then packed where
// those of one body were made one.
#pragma once

#include <span>

#include "exec/sort.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::impulse {

/// Closes the gaps that rows of the same body have left.
template <class Row>
struct PackRows {
  const Row* from;
  const std::uint32_t *from_offsets, *offsets, *counts;
  Row* to;
  PLUMB_HD void operator()(std::uint32_t i) const {
    for (std::uint32_t k = 0; k < counts[i]; ++k) to[offsets[i] + k] = from[from_offsets[i] + k];
  }
};

/// Used by one batch at a time; rows live until the next.
template <class Row>
class RowLists {
 public:
  /// Room for n rows where kernels run.
  Row* room(std::uint32_t n) {
    rows_.grow(n);
    return rows_.device();
  }
  [[nodiscard]] Row* device() { return rows_.device(); }

  /// count(counts) enqueues what writes how many rows each of the n queries finds, and list(offsets, counts, rows) what
  /// writes them, each query's from its offset on. Where several is set it lowers the counts to what it left. Returns
  /// how many rows there are; waits. E is Executor: files without kernels, which do not see how it runs them, hold
  /// these, too.
  template <class E, class CountRows, class List>
  std::uint32_t find(E& executor, std::uint32_t n, bool several, const CountRows& count, const List& list) {
    if (n == 0) return 0;
    counts_.grow(n);
    count(counts_.data());
    const std::uint32_t met = scan_counts(executor, n, offsets_);
    if (!several) {
      list(offsets_.data(), counts_.data(), room(met));
      return met;
    }
    found_.grow(met);
    list(offsets_.data(), counts_.data(), found_.data());
    const std::uint32_t left = scan_counts(executor, n, packed_offsets_);
    executor.run(n, PackRows<Row>{found_.data(), offsets_.data(), packed_offsets_.data(), counts_.data(), room(left)});
    return left;
  }

  std::span<const Row> hand_out(Executor& executor, std::uint32_t count) {
    executor.to_host(rows_, count);
    executor.wait();
    return {rows_.host(), count};
  }

 private:
  /// Offsets of the counts; returns their sum.
  std::uint32_t scan_counts(Executor& executor, std::uint32_t n, Buffer<std::uint32_t>& offsets) {
    scan_.reserve(n);
    offsets.grow(n);
    total_.grow(1);
    scan_.run(executor, n, counts_.data(), offsets.data(), total_.data());
    executor.wait();
    const std::uint32_t total = total_.to_host(1)[0];
    if (total == ~0U)
      throw Error(PLUMB_E_OUT_OF_MEMORY, "a batch of queries has more hits than can be counted; ask fewer at a time");
    return total;
  }

  Scan scan_;
  Buffer<std::uint32_t> counts_, offsets_, packed_offsets_, total_;
  Mirror<Row> rows_;
  Buffer<Row> found_;  // before those of one body are made one
};

}  // namespace plumb::impulse
