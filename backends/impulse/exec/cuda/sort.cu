// Sorting and prefix sums by CUB (CUDA Core Compute Libraries).
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>
#include <cuda/std/limits>

#include "exec/sort.hpp"
#include "plumb/assert.hpp"

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

struct SaturatingSum {
  __host__ __device__ std::uint32_t operator()(std::uint32_t a, std::uint32_t b) const {
    const std::uint32_t sum = a + b;
    return sum < a ? ~0U : sum;
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
    const std::uint32_t all = n.value == nullptr ? n.capacity : *n.value;
    const std::uint32_t count = all < n.capacity ? all : n.capacity;
    *total = count == 0 ? 0 : SaturatingSum{}(sums[count - 1], values[count - 1]);
  }
};

auto values_or_zeros(const std::uint32_t* values, const std::uint32_t* n) {
  return thrust::make_transform_iterator(thrust::make_counting_iterator(0U), ValueOrZero{values, n});
}

/// CUB's scan in its two phases: what it needs where scratch is null, else the scan.
template <class Values>
std::size_t scan(void* scratch, std::size_t bytes, Values values, std::uint32_t* sums, std::uint32_t n,
                 cudaStream_t stream) {
  check_cuda(cub::DeviceScan::ExclusiveScan(scratch, bytes, values, sums, SaturatingSum{}, 0U, n, stream),
             "cannot scan");
  return bytes;
}

template <class K>
struct SortArrays {
  const K* keys;
  const std::uint32_t* values;
  K* sorted_keys;
  std::uint32_t* sorted_values;
};

template <class K>
std::size_t sort(void* scratch, std::size_t bytes, const SortArrays<K>& of, std::uint32_t n, int bits,
                 cudaStream_t stream) {
  check_cuda(cub::DeviceRadixSort::SortPairs(scratch, bytes, of.keys, of.sorted_keys, of.values, of.sorted_values, n, 0,
                                             bits, stream),
             "cannot sort");
  return bytes;
}

template <class K>
constexpr int kKeyBits = static_cast<int>(8 * sizeof(K));

}  // namespace

template <class K>
void RadixSort<K>::reserve(std::uint32_t capacity) {
  if (capacity <= capacity_) return;
  scratch_.grow(sort<K>(nullptr, 0, {}, capacity, kKeyBits<K>, nullptr));
  capacity_ = capacity;
}

template <class K>
void RadixSort<K>::run(Executor& executor, Count n, K* keys, const std::uint32_t* values, K* sorted_keys,
                       std::uint32_t* sorted_values, int bits) {
  executor.run(n.capacity, PadKeys<K>{keys, n.value});
  // One bit more than the caller's keys have, so that the padding comes last: its bit there is 1.
  run(executor, n.capacity, keys, values, sorted_keys, sorted_values, bits < kKeyBits<K> ? bits + 1 : bits);
}

template <class K>
void RadixSort<K>::run(Executor& executor, std::uint32_t n, const K* keys, const std::uint32_t* values, K* sorted_keys,
                       std::uint32_t* sorted_values, int bits) {
  PLUMB_ASSERT(n <= capacity_);
  if (n == 0) return;
  sort<K>(scratch_.data(), scratch_.size(), {keys, values, sorted_keys, sorted_values}, n, bits, executor.stream());
}

template class RadixSort<std::uint32_t>;
template class RadixSort<std::uint64_t>;

void Scan::reserve(std::uint32_t capacity) {
  if (capacity <= capacity_) return;
  const std::size_t counted = scan(nullptr, 0, values_or_zeros(nullptr, nullptr), nullptr, capacity, nullptr);
  const std::size_t known = scan(nullptr, 0, static_cast<const std::uint32_t*>(nullptr), nullptr, capacity, nullptr);
  scratch_.grow(counted < known ? known : counted);
  capacity_ = capacity;
}

void Scan::run(Executor& executor, Count n, const std::uint32_t* values, std::uint32_t* sums, std::uint32_t* total) {
  if (n.capacity != 0)
    scan(scratch_.data(), scratch_.size(), values_or_zeros(values, n.value), sums, n.capacity, executor.stream());
  executor.run(1U, Total{values, sums, n, total});
}

void Scan::run(Executor& executor, std::uint32_t n, const std::uint32_t* values, std::uint32_t* sums,
               std::uint32_t* total) {
  if (n != 0) scan(scratch_.data(), scratch_.size(), values, sums, n, executor.stream());
  executor.run(1U, Total{values, sums, Count{nullptr, n}, total});
}

}  // namespace plumb::impulse
