// Memory where kernels run. Buffers are made and grown between steps only; a step allocates nothing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>
#include <vector>

#include "plumb/assert.hpp"

namespace plumb::impulse {

/// Raw memory of the executor, 256-byte aligned. Throws plumb::Error PLUMB_E_OUT_OF_MEMORY. (cpu/memory.cpp,
/// cuda/memory.cpp)
namespace memory {
void* allocate(std::size_t bytes);
void release(void* data) noexcept;
/// Host memory that the device copies from and to without help of the CPU.
void* allocate_host(std::size_t bytes);
void release_host(void* data) noexcept;
/// These wait until they are done, and for all kernels before.
void fill(void* data, int byte, std::size_t bytes);
void copy_between(void* to, const void* from, std::size_t bytes);  // kernels' memory to kernels' memory
void upload(void* to, const void* from_host, std::size_t bytes);
void download(void* to_host, const void* from, std::size_t bytes);
}  // namespace memory

/// An array where kernels run. New elements are zero bytes.
template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;
  explicit Buffer(std::size_t size) { grow(size); }
  Buffer(Buffer&& other) noexcept : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0)) {}
  Buffer& operator=(Buffer&& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
    return *this;
  }
  ~Buffer() { memory::release(data_); }

  [[nodiscard]] T* data() { return data_; }
  [[nodiscard]] const T* data() const { return data_; }
  [[nodiscard]] std::size_t size() const { return size_; }

  /// Makes room for `size` elements and keeps those there are. Never shrinks.
  void grow(std::size_t size) {
    if (size <= size_) return;
    T* data = static_cast<T*>(memory::allocate(size * sizeof(T)));
    if (size_ != 0) memory::copy_between(data, data_, size_ * sizeof(T));
    memory::fill(data + size_, 0, (size - size_) * sizeof(T));
    memory::release(data_);
    data_ = data;
    size_ = size;
  }

  /// The first `count` elements, copied to the host.
  [[nodiscard]] std::vector<T> to_host(std::size_t count) const {
    PLUMB_ASSERT(count <= size_);
    std::vector<T> host(count);
    if (count != 0) memory::download(host.data(), data_, count * sizeof(T));
    return host;
  }
  void from_host(const T* host, std::size_t count) { from_bytes(host, count); }
  /// Likewise of elements that may lie at any address.
  void from_bytes(const void* host, std::size_t count) {
    if (count > size_) {  // none stays as it is, so that there is nothing to copy or to clear
      T* data = static_cast<T*>(memory::allocate(count * sizeof(T)));
      memory::release(data_);
      data_ = data;
      size_ = count;
    }
    if (count != 0) memory::upload(data_, host, count * sizeof(T));
  }
  void assign(const std::vector<T>& host) { from_host(host.data(), host.size()); }
  /// The elements from `first` on are 0 again, as they were when there was room for them.
  void clear_from(std::size_t first) {
    if (first < size_) memory::fill(data_ + first, 0, (size_ - first) * sizeof(T));
  }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

/// Whether the host and the kernels share their memory. They do on the CPU, but for programs that test what travels:
/// what is linked decides (cpu/one_memory.cpp or cpu/memory_apart.cpp), so that they are made of the same objects.
#if defined(PLUMB_IMPULSE_CUDA)
constexpr bool kOneMemory = false;
#else
extern const bool kOneMemory;
#endif

/// An array of which the host has a twin. On the CPU both are one. Who writes the one side says so by copying.
template <class T>
class Mirror {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Mirror() = default;
  Mirror(const Mirror&) = delete;
  Mirror& operator=(const Mirror&) = delete;
  ~Mirror() { memory::release_host(host_); }

  [[nodiscard]] T* device() { return kOneMemory ? host_ : device_.data(); }
  [[nodiscard]] T* host() { return host_; }
  [[nodiscard]] const T* host() const { return host_; }
  [[nodiscard]] T& operator[](std::size_t i) {
    PLUMB_ASSERT(i < size_);
    return host_[i];
  }
  [[nodiscard]] const T& operator[](std::size_t i) const {
    PLUMB_ASSERT(i < size_);
    return host_[i];
  }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] static constexpr std::size_t bytes(std::size_t count) { return count * sizeof(T); }

  /// Grows both sides and keeps what is there; new elements are zero bytes. Where memory runs out, size() stays.
  void grow(std::size_t size) {
    if (size <= size_) return;
    if (!kOneMemory) device_.grow(size);
    T* host = static_cast<T*>(memory::allocate_host(size * sizeof(T)));
    if (size_ != 0) std::memcpy(static_cast<void*>(host), host_, size_ * sizeof(T));
    std::memset(static_cast<void*>(host + size_), 0, (size - size_) * sizeof(T));
    memory::release_host(host_);
    host_ = host;
    size_ = size;
  }

 private:
  T* host_ = nullptr;
  std::size_t size_ = 0;
  Buffer<T> device_;
};

}  // namespace plumb::impulse
