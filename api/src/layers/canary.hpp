// A stand-in for the memory that a host lends for output. The backend writes here; what it writes where it may not is
// seen, and the host's memory gets only what is its due.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

namespace plumb::layers {

class Canary {
 public:
  /// Of `capacity` rows, each row_size bytes that may be written in `stride` bytes.
  Canary(std::size_t row_size, std::size_t stride, std::size_t capacity)
      : row_size_(row_size), stride_(stride), capacity_(capacity), bytes_(stride * capacity + guard(stride), pattern) {}

  [[nodiscard]] std::byte* data() { return bytes_.data(); }
  [[nodiscard]] std::byte* row(std::size_t index) { return bytes_.data() + index * stride_; }

  /// Nothing was written beyond the last row.
  [[nodiscard]] bool end_intact() const { return untouched(stride_ * capacity_, bytes_.size()); }
  /// Nothing was written between the end of a row and the next.
  [[nodiscard]] bool padding_intact() const {
    for (std::size_t i = 0; i < capacity_; ++i)
      if (!untouched(i * stride_ + row_size_, (i + 1) * stride_)) return false;
    return true;
  }
  /// Nothing was written at all.
  [[nodiscard]] bool untouched() const { return untouched(0, bytes_.size()); }
  /// The first of `count` rows that nobody wrote, or count.
  [[nodiscard]] std::size_t first_unwritten(std::size_t count) const {
    std::size_t i = 0;
    while (i < count && !untouched(i * stride_, i * stride_ + row_size_)) ++i;
    return i;
  }

  /// Hands the first `count` rows on, without the padding between them.
  void copy_to(void* out, std::size_t count) const {
    for (std::size_t i = 0; i < count; ++i)
      std::memcpy(static_cast<std::byte*>(out) + i * stride_, bytes_.data() + i * stride_, row_size_);
  }

 private:
  static constexpr std::byte pattern{0xa5};  // as a double -1e-130: no engine answers that by itself
  // Wide enough to hold a whole row too many.
  static std::size_t guard(std::size_t stride) { return std::max<std::size_t>(stride, 256); }
  [[nodiscard]] bool untouched(std::size_t from, std::size_t to) const {
    return std::all_of(bytes_.begin() + static_cast<std::ptrdiff_t>(from),
                       bytes_.begin() + static_cast<std::ptrdiff_t>(to), [](std::byte b) { return b == pattern; });
  }

  std::size_t row_size_, stride_, capacity_;
  std::vector<std::byte> bytes_;
};

}  // namespace plumb::layers
