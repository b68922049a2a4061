// Atomic operations on whole numbers, the same call on both devices. There are none on floating-point numbers: their
// sums would depend on the order. What order of calls these may leave open (which slot a thread gets) must not reach a
// result.
#pragma once

#include <atomic>
#include <cstdint>

#include "math/real.hpp"

namespace plumb::impulse {

#if defined(__CUDA_ARCH__)
/// The type that CUDA's atomic functions have for a whole number of that size.
template <class U>
__device__ inline auto* atomic_word(U* at) {
  if constexpr (sizeof(U) == sizeof(unsigned long long)) {
    return reinterpret_cast<unsigned long long*>(at);
  } else {
    return at;
  }
}
#endif

/// All return the value before.
template <class U>
PLUMB_HD inline U atomic_add(U* at, U value) {
#if defined(__CUDA_ARCH__)
  return atomicAdd(atomic_word(at), value);
#else
  return std::atomic_ref<U>(*at).fetch_add(value, std::memory_order_relaxed);
#endif
}
template <class U>
PLUMB_HD inline U atomic_or(U* at, U value) {
#if defined(__CUDA_ARCH__)
  return atomicOr(atomic_word(at), value);
#else
  return std::atomic_ref<U>(*at).fetch_or(value, std::memory_order_relaxed);
#endif
}
template <class U>
PLUMB_HD inline U atomic_min(U* at, U value) {
#if defined(__CUDA_ARCH__)
  return atomicMin(atomic_word(at), value);
#else
  std::atomic_ref<U> target(*at);
  U old = target.load(std::memory_order_relaxed);
  while (value < old && !target.compare_exchange_weak(old, value, std::memory_order_relaxed)) {
  }
  return old;
#endif
}
template <class U>
PLUMB_HD inline U atomic_max(U* at, U value) {
#if defined(__CUDA_ARCH__)
  return atomicMax(atomic_word(at), value);
#else
  std::atomic_ref<U> target(*at);
  U old = target.load(std::memory_order_relaxed);
  while (old < value && !target.compare_exchange_weak(old, value, std::memory_order_relaxed)) {
  }
  return old;
#endif
}
/// Adds 1, and makes all that this thread wrote before visible to whoever sees the 1, and the other way round: the
/// fence between two threads that meet in a node of a tree.
PLUMB_HD inline std::uint32_t atomic_arrive(std::uint32_t* at) {
#if defined(__CUDA_ARCH__)
  __threadfence();
  const std::uint32_t before = atomicAdd(at, 1U);
  __threadfence();
  return before;
#else
  return std::atomic_ref<std::uint32_t>(*at).fetch_add(1U, std::memory_order_acq_rel);
#endif
}

}  // namespace plumb::impulse
