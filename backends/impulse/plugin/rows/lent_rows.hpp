// A DLPack tensor over rows that somebody else has too.
#pragma once

#include <memory>

#include "bodies/state_rows.hpp"
#include "plumb/plumb.h"

namespace plumb::impulse {

/// Keeps the block alive and dies with the tensor's deleter, whenever and in whichever thread that is.
template <class Row>
class LentRows {
 public:
  static PlumbDLManagedTensor* lend(std::shared_ptr<RowBlock<Row>> block, std::size_t rows, bool on_device) {
    auto lent = std::unique_ptr<LentRows>(new LentRows(std::move(block), {1, rows}, on_device));
    return &lent.release()->tensor_;
  }
  /// Of many worlds, so many rows of each: worlds x rows x columns.
  static PlumbDLManagedTensor* lend(std::shared_ptr<RowBlock<Row>> block, std::size_t worlds, std::size_t rows,
                                    bool on_device) {
    auto lent = std::unique_ptr<LentRows>(new LentRows(std::move(block), {worlds, rows}, on_device));
    lent->tensor_.dl_tensor.ndim = 3;
    lent->tensor_.dl_tensor.shape = lent->shape_;
    lent->tensor_.dl_tensor.strides = lent->strides_;
    return &lent.release()->tensor_;
  }

 private:
  using Number = std::remove_reference_t<decltype(Row{}.numbers[0])>;
  static constexpr std::int64_t kColumns = sizeof(Row) / sizeof(Number);

  struct Size {
    std::size_t worlds, rows;
  };
  LentRows(std::shared_ptr<RowBlock<Row>> block, const Size& size, bool on_device)
      : block_(std::move(block)),
        shape_{static_cast<std::int64_t>(size.worlds), static_cast<std::int64_t>(size.rows), kColumns},
        strides_{static_cast<std::int64_t>(size.rows) * kColumns, kColumns, 1} {
    constexpr std::uint64_t kReadOnly = 1, kCopy = 2;
    constexpr std::uint8_t kFloat = 2;
    tensor_.version = {1, 0};
    tensor_.manager_ctx = this;
    tensor_.deleter = [](PlumbDLManagedTensor* self) { delete static_cast<LentRows*>(self->manager_ctx); };
    tensor_.flags = on_device ? kReadOnly : kReadOnly | kCopy;
    PlumbDLTensor& tensor = tensor_.dl_tensor;
    tensor.data = on_device ? block_->rows.device() : block_->rows.host();
    if (on_device)
      tensor.device = {Executor::device_type(), Executor::device_id()};
    else
      tensor.device = {1, 0};
    tensor.ndim = 2;
    tensor.dtype = {kFloat, 8 * sizeof(Number), 1};
    tensor.shape = shape_ + 1;
    tensor.strides = strides_ + 1;
  }

  std::shared_ptr<RowBlock<Row>> block_;
  std::int64_t shape_[3], strides_[3];  // of one world the last two
  PlumbDLManagedTensor tensor_{};
};

}  // namespace plumb::impulse
