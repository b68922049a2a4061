// All elements merged into one, in a tree of fixed shape.
#pragma once

#include <cstdint>

#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "math/real.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

// Not within the class: nvcc makes no kernels of private types.
namespace reduce {

/// Threads that merge what they have without writing it: a warp of a GPU.
constexpr std::uint32_t kTogether = Executor::kWarps ? 32 : 1;

template <class T>
struct Loaded {
  const T* from;
  PLUMB_HD T operator()(std::uint32_t i) const { return from[i]; }
};

#if defined(__CUDACC__)
/// x of the thread that is `by` further on in the warp.
template <class T>
__device__ T from_further(const T& x, unsigned by) {
  constexpr std::size_t kWords = sizeof(T) / sizeof(unsigned);
  static_assert(kWords * sizeof(unsigned) == sizeof(T));
  unsigned words[kWords];
  __builtin_memcpy(words, &x, sizeof x);
  PLUMB_UNROLL
  for (unsigned& word : words) word = __shfl_down_sync(~0U, word, by);
  T other;
  __builtin_memcpy(&other, words, sizeof other);
  return other;
}
#endif

/// One thread's share, strided: neighbours read neighbours. The first of those that work together writes for them.
template <class T, class Load>
struct Part {
  Load load;
  std::uint32_t n, threads;
  T* to;
  PLUMB_HD void operator()(std::uint32_t t) const {
    T all = T::nothing();
    for (std::uint32_t i = t; i < n; i += threads) all = T::merged(all, load(i));
#if defined(__CUDA_ARCH__)
    PLUMB_UNROLL
    for (unsigned by = kTogether / 2; by > 0; by /= 2) all = T::merged(all, from_further(all, by));
#endif
    if (t % kTogether == 0) to[t / kTogether] = all;
  }
};

}  // namespace reduce

/// T has the static members nothing() and merged(const T&, const T&), which run where kernels run.
template <class T>
class Reduce {
 public:
  /// Makes room for reductions of up to `capacity` elements. Not within a step.
  void reserve(std::uint32_t capacity) {
    // The first level's results; the second level's and the fourth's go behind, and so on.
    partials_.grow(std::size_t{parts_of(capacity)} + parts_of(parts_of(capacity)) + 1);
    capacity_ = capacity_ < capacity ? capacity : capacity_;
  }

  /// *result = load(0) merged with load(1) ... load(n - 1).
  /// (A template also of the executor, for those who include this without a kernel compiler.)
  template <class AnyExecutor, class Load>
  void run(AnyExecutor& executor, std::uint32_t n, const Load& load, T* result) {
    PLUMB_ASSERT(n <= capacity_);
    std::uint32_t count = parts_of(n);
    T* here = partials_.data();
    T* other = here + parts_of(capacity_);
    run_level(executor, n, count, load, count == 1 ? result : here);
    while (count > 1) {
      const std::uint32_t next = parts_of(count);
      run_level(executor, count, next, reduce::Loaded<T>{here}, next == 1 ? result : other);
      T* const swapped = here;
      here = other;
      other = swapped;
      count = next;
    }
  }

 private:
  /// Elements of a thread on a CPU; on a GPU two of each thread of a warp, and up to sixteen where that leaves one
  /// warp.
  static constexpr std::uint32_t kFanIn = Executor::kWarps ? 64 : 16, kMostAlone = Executor::kWarps ? 512 : 32;
  static constexpr std::uint32_t parts_of(std::uint32_t n) { return n <= kMostAlone ? 1 : (n + kFanIn - 1) / kFanIn; }
  template <class AnyExecutor, class Load>
  static void run_level(AnyExecutor& executor, std::uint32_t n, std::uint32_t parts, const Load& load, T* to) {
    const std::uint32_t threads = parts * reduce::kTogether;
    executor.run(threads, reduce::Part<T, Load>{load, n, threads, to});
  }

  Buffer<T> partials_;
  std::uint32_t capacity_ = 0;
};

}  // namespace plumb::impulse
