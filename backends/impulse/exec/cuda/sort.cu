// Sorting and prefix sums by CUB (CUDA Core Compute Libraries).
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>
#include <cuda/std/limits>
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>

#include "exec/sort.hpp"

namespace plumb::impulse {

namespace {

template <class K>
struct PadKeys {
  K* keys;
  const std::uint32_t* n;
  __device__ void operator()(std::uint32_t i) const {
    if (i >= *n) keys[i] = cuda::std::numeric_limits<K>::max();
  }
};

struct ValueOrZero {
  const std::uint32_t* values;
  const std::uint32_t* n;
  __host__ __device__ std::uint32_t operator()(std::uint32_t i) const { return i < *n ? values[i] : 0U; }
};

struct Total {
  const std::uint32_t* values;
  const std::uint32_t* sums;
  Count n;
  std::uint32_t* total;
  __device__ void operator()(std::uint32_t) const {
    const std::uint32_t count = *n.value < n.capacity ? *n.value : n.capacity;
    *total = count == 0 ? 0 : sums[count - 1] + values[count - 1];
  }
};

auto values_or_zeros(const std::uint32_t* values, const std::uint32_t* n) {
  return thrust::make_transform_iterator(thrust::make_counting_iterator(0U), ValueOrZero{values, n});
}

}  // namespace

template <class K>
void RadixSort<K>::reserve(std::uint32_t capacity) {
  if (capacity <= capacity_) return;
  std::size_t bytes = 0;
  check_cuda(cub::DeviceRadixSort::SortPairs(nullptr, bytes, static_cast<K*>(nullptr), static_cast<K*>(nullptr),
                                             static_cast<std::uint32_t*>(nullptr), static_cast<std::uint32_t*>(nullptr),
                                             capacity),
             "cannot size a sort");
  scratch_.grow(bytes);
  capacity_ = capacity;
}

template <class K>
void RadixSort<K>::run(Executor& executor, Count n, K* keys, const std::uint32_t* values, K* sorted_keys,
                       std::uint32_t* sorted_values, int bits) {
  executor.run(n.capacity, PadKeys<K>{keys, n.value});
  std::size_t bytes = scratch_.size();
  // One bit more than the caller's keys have, so that the padding comes last: its bit there is 1.
  const int end = bits + 1 < static_cast<int>(8 * sizeof(K)) ? bits + 1 : static_cast<int>(8 * sizeof(K));
  check_cuda(cub::DeviceRadixSort::SortPairs(scratch_.data(), bytes, keys, sorted_keys, values, sorted_values,
                                             n.capacity, 0, end, executor.stream()),
             "cannot sort");
}

template class RadixSort<std::uint32_t>;
template class RadixSort<std::uint64_t>;

void Scan::reserve(std::uint32_t capacity) {
  if (capacity <= capacity_) return;
  std::size_t bytes = 0;
  check_cuda(cub::DeviceScan::ExclusiveSum(nullptr, bytes, values_or_zeros(nullptr, nullptr),
                                           static_cast<std::uint32_t*>(nullptr), capacity),
             "cannot size a scan");
  scratch_.grow(bytes);
  capacity_ = capacity;
}

void Scan::run(Executor& executor, Count n, const std::uint32_t* values, std::uint32_t* sums, std::uint32_t* total) {
  std::size_t bytes = scratch_.size();
  check_cuda(cub::DeviceScan::ExclusiveSum(scratch_.data(), bytes, values_or_zeros(values, n.value), sums, n.capacity,
                                           executor.stream()),
             "cannot scan");
  executor.run(1U, Total{values, sums, n, total});
}

}  // namespace plumb::impulse
