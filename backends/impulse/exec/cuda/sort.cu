// Sorting and prefix sums by CUB (CUDA Core Compute Libraries).
#include <thrust/iterator/counting_iterator.h>
#include <thrust/iterator/transform_iterator.h>
#include <cub/device/device_merge_sort.cuh>
#include <cub/device/device_radix_sort.cuh>
#include <cub/device/device_scan.cuh>
#include <cuda/std/limits>

#include <algorithm>
#include <bit>

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

template <class K>
struct LessInBits {
  K mask;
  __host__ __device__ bool operator()(K a, K b) const { return (a & mask) < (b & mask); }
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

template <class K>
struct SortArrays {
  const K* keys;
  const std::uint32_t* values;
  K* sorted_keys;
  std::uint32_t* sorted_values;
};

/// Copies what is to be sorted where it lies, with padding behind the last of *n; null: all are there.
template <class K>
struct CopyPairs {
  SortArrays<K> of;
  const std::uint32_t* n;
  __device__ void operator()(std::uint32_t i) const {
    of.sorted_keys[i] = n == nullptr || i < *n ? of.keys[i] : cuda::std::numeric_limits<K>::max();
    of.sorted_values[i] = of.values[i];
  }
};

__device__ std::uint32_t number_of(const Count& n) {
  return n.value == nullptr || *n.value > n.capacity ? n.capacity : *n.value;
}

/// By one block, for the few things of a small world: each is put behind those that come before it.
template <class K>
struct SortInBlock {
  SortArrays<K> of;
  Count n;
  K mask;

  __device__ void operator()() const {
    constexpr std::uint32_t kTile = 512;
    __shared__ K tile[kTile];
    const std::uint32_t count = number_of(n);
    for (std::uint32_t first = 0; first < count; first += blockDim.x) {
      const std::uint32_t i = first + threadIdx.x;
      const K own = i < count ? of.keys[i] & mask : K{0};
      std::uint32_t rank = 0;
      for (std::uint32_t begin = 0; begin < count; begin += kTile) {
        const std::uint32_t size = count - begin < kTile ? count - begin : kTile;
        __syncthreads();
        for (std::uint32_t t = threadIdx.x; t < size; t += blockDim.x) tile[t] = of.keys[begin + t] & mask;
        __syncthreads();
        for (std::uint32_t t = 0; t < size; ++t) rank += tile[t] < own || (tile[t] == own && begin + t < i) ? 1U : 0U;
      }
      if (i >= count) continue;
      of.sorted_keys[rank] = of.keys[i];
      of.sorted_values[rank] = of.values[i];
    }
  }
};

struct ScanInBlock {
  const std::uint32_t* values;
  std::uint32_t* sums;
  Count n;
  std::uint32_t* total;

  __device__ void operator()() const {
    constexpr std::uint32_t kWarp = 32;
    __shared__ std::uint32_t sums_of_warps[kTeamThreads / kWarp];
    const std::uint32_t count = number_of(n), lane = threadIdx.x % kWarp, warp = threadIdx.x / kWarp;
    std::uint32_t before = 0;  // of the parts that are done
    for (std::uint32_t first = 0; first < count; first += blockDim.x) {
      const std::uint32_t i = first + threadIdx.x;
      std::uint32_t sum = i < count ? values[i] : 0U;  // of the warp, up to here
      for (std::uint32_t by = 1; by < kWarp; by *= 2) {
        const std::uint32_t other = __shfl_up_sync(~0U, sum, by);
        if (lane >= by) sum = SaturatingSum{}(other, sum);
      }
      if (lane == kWarp - 1) sums_of_warps[warp] = sum;
      const std::uint32_t last = __shfl_up_sync(~0U, sum, 1);
      __syncthreads();
      std::uint32_t here = 0;
      for (std::uint32_t w = 0; w < blockDim.x / kWarp; ++w) {
        if (w == warp) here = SaturatingSum{}(before, lane == 0 ? 0U : last);
        before = SaturatingSum{}(before, sums_of_warps[w]);
      }
      if (i < count) sums[i] = here;
      __syncthreads();
    }
    if (threadIdx.x == 0) *total = before;
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
std::size_t sort(void* scratch, std::size_t bytes, const SortArrays<K>& of, std::uint32_t n, int bits,
                 cudaStream_t stream) {
  check_cuda(cub::DeviceRadixSort::SortPairs(scratch, bytes, of.keys, of.sorted_keys, of.values, of.sorted_values, n, 0,
                                             bits, stream),
             "cannot sort");
  return bytes;
}

template <class K>
constexpr int kKeyBits = static_cast<int>(8 * sizeof(K));

template <class K>
std::size_t merge_sort(void* scratch, std::size_t bytes, const SortArrays<K>& of, std::uint32_t n, int bits,
                       cudaStream_t stream) {
  const LessInBits<K> less{static_cast<K>(~K{0} >> (kKeyBits<K> - bits))};
  check_cuda(cub::DeviceMergeSort::StableSortPairs(scratch, bytes, of.sorted_keys, of.sorted_values, n, less, stream),
             "cannot sort");
  return bytes;
}

/// Whether merging takes clearly fewer rounds than there are digits: a round of either takes 7 to 10 us of a device,
/// however few things there are.
template <class K>
bool sorts_by_merging(std::uint32_t n, int bits) {
  constexpr std::uint32_t kTile = 4096 * sizeof(std::uint32_t) / sizeof(K);  // about what a block sorts by itself
  constexpr int kDigit = 8;
  return static_cast<int>(std::bit_width((n - 1) / kTile)) + 2 <= (bits + kDigit - 1) / kDigit;
}

template <class K>
void sort_by_merging(Executor& executor, Buffer<std::byte>& scratch, Count n, const SortArrays<K>& of, int bits) {
  executor.run(n.capacity, CopyPairs<K>{of, n.value});
  merge_sort(scratch.data(), scratch.size(), of, n.capacity, bits, executor.stream());
}

template <class K>
void sort_in_block(Executor& executor, Count n, const SortArrays<K>& of, int bits) {
  executor.list_block(SortInBlock<K>{of, n, static_cast<K>(~K{0} >> (kKeyBits<K> - bits))});
}

}  // namespace

template <class K>
void RadixSort<K>::reserve(std::uint32_t capacity) {
  if (capacity <= capacity_) return;
  scratch_.grow(std::max(sort<K>(nullptr, 0, {}, capacity, kKeyBits<K>, nullptr),
                         merge_sort<K>(nullptr, 0, {}, capacity, kKeyBits<K>, nullptr)));
  capacity_ = capacity;
}

// Padding comes last, for sorting is stable and no key is greater.
template <class K>
void RadixSort<K>::run(Executor& executor, Count n, K* keys, const std::uint32_t* values, K* sorted_keys,
                       std::uint32_t* sorted_values, int bits) {
  if (n.capacity == 0) return;
  const SortArrays<K> of = {keys, values, sorted_keys, sorted_values};
  if (executor.lists()) return sort_in_block(executor, n, of, bits);
  if (sorts_by_merging<K>(n.capacity, bits)) return sort_by_merging(executor, scratch_, n, of, bits);
  executor.run(n.capacity, PadKeys<K>{keys, n.value});
  run(executor, n.capacity, keys, values, sorted_keys, sorted_values, bits);
}

template <class K>
void RadixSort<K>::run(Executor& executor, std::uint32_t n, const K* keys, const std::uint32_t* values, K* sorted_keys,
                       std::uint32_t* sorted_values, int bits) {
  PLUMB_ASSERT(n <= capacity_);
  if (n == 0) return;
  const SortArrays<K> of = {keys, values, sorted_keys, sorted_values};
  if (executor.lists()) return sort_in_block(executor, {nullptr, n}, of, bits);
  if (sorts_by_merging<K>(n, bits)) return sort_by_merging(executor, scratch_, {nullptr, n}, of, bits);
  sort(scratch_.data(), scratch_.size(), of, n, bits, executor.stream());
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
  if (executor.lists()) return executor.list_block(ScanInBlock{values, sums, n, total});
  if (n.capacity != 0)
    scan(scratch_.data(), scratch_.size(), values_or_zeros(values, n.value), sums, n.capacity, executor.stream());
  executor.run(1U, Total{values, sums, n, total});
}

void Scan::run(Executor& executor, std::uint32_t n, const std::uint32_t* values, std::uint32_t* sums,
               std::uint32_t* total) {
  if (executor.lists()) return executor.list_block(ScanInBlock{values, sums, {nullptr, n}, total});
  if (n != 0) scan(scratch_.data(), scratch_.size(), values, sums, n, executor.stream());
  executor.run(1U, Total{values, sums, Count{nullptr, n}, total});
}

}  // namespace plumb::impulse
