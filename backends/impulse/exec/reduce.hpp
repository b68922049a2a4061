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

template <class T>
struct Loaded {
  const T* from;
  PLUMB_HD T operator()(std::uint32_t i) const { return from[i]; }
};

/// One thread's share, strided: neighbours read neighbours.
template <class T, class Load>
struct Part {
  Load load;
  std::uint32_t n, threads;
  T* to;
  PLUMB_HD void operator()(std::uint32_t t) const {
    T all = T::nothing();
    for (std::uint32_t i = t; i < n; i += threads) all = T::merged(all, load(i));
    to[t] = all;
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
    partials_.grow(std::size_t{threads_for(capacity)} + threads_for(threads_for(capacity)) + 1);
    capacity_ = capacity_ < capacity ? capacity : capacity_;
  }

  /// *result = load(0) merged with load(1) ... load(n - 1).
  /// (A template also of the executor, for those who include this without a kernel compiler.)
  template <class AnyExecutor, class Load>
  void run(AnyExecutor& executor, std::uint32_t n, const Load& load, T* result) {
    PLUMB_ASSERT(n <= capacity_);
    std::uint32_t count = threads_for(n);
    T* here = partials_.data();
    T* other = here + threads_for(capacity_);
    executor.run(count, reduce::Part<T, Load>{load, n, count, count == 1 ? result : here});
    while (count > 1) {
      const std::uint32_t next = threads_for(count);
      executor.run(next, reduce::Part<T, reduce::Loaded<T>>{{here}, count, next, next == 1 ? result : other});
      T* const swapped = here;
      here = other;
      other = swapped;
      count = next;
    }
  }

 private:
  static constexpr std::uint32_t kFanIn = 16;
  static constexpr std::uint32_t threads_for(std::uint32_t n) {
    return n <= 2 * kFanIn ? 1 : (n + kFanIn - 1) / kFanIn;
  }

  Buffer<T> partials_;
  std::uint32_t capacity_ = 0;
};

}  // namespace plumb::impulse
