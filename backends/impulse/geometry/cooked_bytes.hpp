// What cooked meshes and hulls share: elements in bytes at any address, and whether they stay in bounds.
#pragma once

#include <cstring>
#include <span>

#include "math/vec3.hpp"
#include "plumb/backend/cooking.hpp"

namespace plumb::impulse {

/// Elements that may lie at any address.
template <class T>
class CookedItems {
 public:
  explicit CookedItems(std::span<const std::byte> bytes) : bytes_(bytes) {}
  CookedItems(backend::CookedReader& in, std::uint64_t count) : bytes_(in.take(count, sizeof(T))) {}

  [[nodiscard]] std::span<const std::byte> bytes() const { return bytes_; }
  [[nodiscard]] std::size_t size() const { return bytes_.size() / sizeof(T); }
  [[nodiscard]] T operator[](std::size_t i) const {
    T item;
    std::memcpy(static_cast<void*>(&item), bytes_.data() + i * sizeof(T), sizeof(T));
    return item;
  }
  /// Of every one.
  template <class Test>
  [[nodiscard]] bool all(const Test& test) const {
    bool passed = true;  // of all without a way out, which is more than one at a time
    for (std::size_t i = 0; i < size(); ++i) passed &= test((*this)[i]);
    return passed;
  }

 private:
  std::span<const std::byte> bytes_;
};

/// As what descriptors have: the engine squares coordinates.
[[nodiscard]] inline bool is_in_range(const Vec& v) {
  return is_finite(v.x * v.x) && is_finite(v.y * v.y) && is_finite(v.z * v.z);
}

}  // namespace plumb::impulse
