// Memory for what grows with a scene: the host's, where it lent some (PlumbHost.allocate), else the process's own. The
// guard keeps its handles and records there; keep what your engine's world is made of there too, and say so of
// PLUMB_CAP_HOST_MEMORY.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

#include "plumb/plumb.h"

namespace plumb::backend {

/// bytes > 0; alignment: a power of two, at most 256. Null where there is no more. On any thread.
[[nodiscard]] void* take_memory(std::size_t bytes, std::size_t alignment) noexcept;
/// What take_memory gave for the same alignment, or null.
void give_back_memory(void* memory, std::size_t alignment) noexcept;

/// From now on memory is the host's, where it lends any; before anything was taken.
void use_memory_of(const PlumbHost* host) noexcept;

/// For the containers of the standard library. Throws std::bad_alloc, which becomes PLUMB_E_OUT_OF_MEMORY.
template <class T>
struct HostAllocator {
  using value_type = T;

  HostAllocator() = default;
  template <class U>
  HostAllocator(const HostAllocator<U>& /*other*/) noexcept {}

  [[nodiscard]] T* allocate(std::size_t count) {
    void* const memory = count > std::size_t(-1) / sizeof(T) ? nullptr : take_memory(count * sizeof(T), alignof(T));
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }
  void deallocate(T* memory, std::size_t /*count*/) noexcept { give_back_memory(memory, alignof(T)); }
  [[nodiscard]] bool operator==(const HostAllocator& /*other*/) const { return true; }
};
template <class T>
using HostVector = std::vector<T, HostAllocator<T>>;

}  // namespace plumb::backend
