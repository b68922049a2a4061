// Atomic operations on whole numbers, the same call on both devices. There are none on floating-point numbers: their
// sums would depend on the order. What order of calls these may leave open (which slot a thread gets) must not reach a
// result.
#pragma once

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
  return __atomic_fetch_add(at, value, __ATOMIC_RELAXED);
#endif
}
template <class U>
PLUMB_HD inline U atomic_or(U* at, U value) {
#if defined(__CUDA_ARCH__)
  return atomicOr(atomic_word(at), value);
#else
  return __atomic_fetch_or(at, value, __ATOMIC_RELAXED);
#endif
}
template <class U>
PLUMB_HD inline U atomic_min(U* at, U value) {
#if defined(__CUDA_ARCH__)
  return atomicMin(atomic_word(at), value);
#else
  U old = __atomic_load_n(at, __ATOMIC_RELAXED);
  while (value < old && !__atomic_compare_exchange_n(at, &old, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
  return old;
#endif
}
template <class U>
PLUMB_HD inline U atomic_max(U* at, U value) {
#if defined(__CUDA_ARCH__)
  return atomicMax(atomic_word(at), value);
#else
  U old = __atomic_load_n(at, __ATOMIC_RELAXED);
  while (old < value && !__atomic_compare_exchange_n(at, &old, value, true, __ATOMIC_RELAXED, __ATOMIC_RELAXED)) {
  }
  return old;
#endif
}
/// As atomic_max where most calls change nothing.
template <class U>
PLUMB_HD inline void atomic_raise(U* at, U value) {
#if defined(__CUDA_ARCH__)
  if (*static_cast<volatile U*>(at) >= value) return;
#endif
  (void)atomic_max(at, value);
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
  return __atomic_fetch_add(at, 1U, __ATOMIC_ACQ_REL);
#endif
}

}  // namespace plumb::impulse
