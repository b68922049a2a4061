// Rows that the host alone writes and kernels read. What it touched travels before the next step, and no more.
#pragma once

#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

template <class T>
class Table {
 public:
  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  [[nodiscard]] const T& operator[](std::size_t i) const { return rows_[i]; }
  /// The row, to be written now.
  [[nodiscard]] T& edit(std::size_t i) {
    touch(i);
    return rows_[i];
  }
  /// Keeps what is there; new rows are zero bytes.
  void grow(std::size_t size) { rows_.grow(size); }

  /// Enqueues the copy of all rows from the first touched one to the last.
  void upload(Executor& executor) {
    if (first_ < end_) executor.to_device(rows_, end_ - first_, first_);
    first_ = kNothing;
    end_ = 0;
  }
  [[nodiscard]] const T* device() { return rows_.device(); }

 private:
  static constexpr std::size_t kNothing = ~std::size_t{0};

  void touch(std::size_t i) {
    PLUMB_ASSERT(i < rows_.size());
    if (kOneMemory) return;
    if (i < first_) first_ = i;
    if (i >= end_) end_ = i + 1;
  }

  Mirror<T> rows_;
  std::size_t first_ = kNothing, end_ = 0;
};

}  // namespace plumb::impulse
