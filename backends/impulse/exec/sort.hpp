// Sorting and prefix sums where kernels run. Both are stable and depend on nothing but their input.
#pragma once

#include <cstddef>
#include <cstdint>

#include "exec/executor.hpp"
#include "exec/memory.hpp"

namespace plumb::impulse {

/// Stable radix sort of (key, value) pairs by the low `bits` bits of the keys; a device merges where that takes fewer
/// rounds. K is uint32_t or uint64_t.
template <class K>
class RadixSort {
 public:
  /// Makes room for sorts of up to `capacity` pairs. Not within a step.
  void reserve(std::uint32_t capacity);

  /// Sorts the first n pairs of keys, values into sorted_keys, sorted_values (other arrays). A device sorts n.capacity
  /// pairs, and may write maximal keys behind the last of `keys` for that.
  void run(Executor& executor, Count n, K* keys, const std::uint32_t* values, K* sorted_keys,
           std::uint32_t* sorted_values, int bits);
  /// The same for a number that the host knows; keys stay as they are.
  void run(Executor& executor, std::uint32_t n, const K* keys, const std::uint32_t* values, K* sorted_keys,
           std::uint32_t* sorted_values, int bits);

 private:
  Buffer<std::byte> scratch_;
  std::uint32_t capacity_ = 0;
};

/// sums[i] = values[0] + ... + values[i-1] for every i < n, and *total the sum of all. Sums beyond 2^32 - 1 are that:
/// a count that is too great for its array is still found to be.
class Scan {
 public:
  void reserve(std::uint32_t capacity);
  void run(Executor& executor, Count n, const std::uint32_t* values, std::uint32_t* sums, std::uint32_t* total);
  void run(Executor& executor, std::uint32_t n, const std::uint32_t* values, std::uint32_t* sums, std::uint32_t* total);

 private:
  Buffer<std::byte> scratch_;
  std::uint32_t capacity_ = 0;
};

}  // namespace plumb::impulse
