// State rows lent as a copy, for engines whose rows do not lie in memory as a tensor.
#pragma once

#include <memory>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::backend {

inline constexpr std::int32_t kHostDevice = 1;

/// A block of rows that owns itself and dies with its tensor's deleter, whenever and in whichever thread that is.
class CopiedRows {
 public:
  CopiedRows(std::size_t rows, std::size_t columns, PlumbDataType type)
      : type_(type),
        shape_{static_cast<std::int64_t>(rows), static_cast<std::int64_t>(columns)},
        strides_{static_cast<std::int64_t>(columns), 1},
        bytes_(rows * columns * element_size()) {}

  [[nodiscard]] PlumbDataType type() const { return type_; }
  [[nodiscard]] void* data() { return bytes_.data(); }
  [[nodiscard]] std::size_t row_size() const { return static_cast<std::size_t>(shape_[1]) * element_size(); }

  [[nodiscard]] static PlumbDLManagedTensor* lend(std::unique_ptr<CopiedRows> rows) {
    PlumbDLManagedTensor& tensor = rows->tensor_;
    tensor.version = {1, 0};
    tensor.manager_ctx = rows.get();
    tensor.deleter = [](PlumbDLManagedTensor* self) { delete static_cast<CopiedRows*>(self->manager_ctx); };
    tensor.flags = 3;  // read only, and a copy
    tensor.dl_tensor.data = rows->bytes_.data();
    tensor.dl_tensor.device = {kHostDevice, 0};
    tensor.dl_tensor.ndim = 2;
    tensor.dl_tensor.dtype = {2, static_cast<std::uint8_t>(8 * rows->element_size()), 1};
    tensor.dl_tensor.shape = rows->shape_;
    tensor.dl_tensor.strides = rows->strides_;
    tensor.dl_tensor.byte_offset = 0;
    return &rows.release()->tensor_;
  }

 private:
  [[nodiscard]] std::size_t element_size() const { return type_ == PLUMB_F64 ? sizeof(double) : sizeof(float); }

  PlumbDataType type_;
  std::int64_t shape_[2];
  std::int64_t strides_[2];
  std::vector<std::byte> bytes_;
  PlumbDLManagedTensor tensor_{};
};

}  // namespace plumb::backend
