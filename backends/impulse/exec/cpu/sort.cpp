// Least significant digit first, 8 bits a pass, one histogram a chunk so that passes run on all threads and the result
// does not depend on how many there are (Knuth, TAOCP 3, 5.2.5).
#include "exec/sort.hpp"

#include <algorithm>
#include <cstring>

#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

constexpr int kDigitBits = 8;
constexpr std::uint32_t kDigits = 1U << kDigitBits;
constexpr std::uint32_t kMostChunks = 64;
constexpr std::uint32_t kFew = 32;  // are sorted before a histogram has been cleared

std::uint32_t chunks_for(std::uint32_t n, std::uint32_t threads) {
  return threads == 1 ? 1 : std::clamp(n / 4096, 1U, std::min(kMostChunks, threads * 2));
}

struct Digit {
  int shift, bits;
  template <class K>
  std::uint32_t of(K key) const {
    return static_cast<std::uint32_t>(key >> shift) & ((1U << bits) - 1U);
  }
};

/// Keys and what goes with them.
template <class K>
struct Keyed {
  K* keys;
  std::uint32_t* values;
};

template <class K>
struct KeyedInput {
  const K* keys;
  const std::uint32_t* values;
};

template <class K>
void pass(ThreadPool& pool, std::uint32_t n, std::uint32_t chunks, Digit digit, KeyedInput<K> from, Keyed<K> to,
          std::uint32_t* histograms) {
  const std::uint32_t chunk = (n + chunks - 1) / chunks;
  const auto in_chunks = [&](auto&& work) {
    struct Job {
      decltype(work)& f;
    } job{work};
    pool.run_chunks(chunks, &job, [](void* context, std::uint32_t c) { static_cast<Job*>(context)->f(c); });
  };
  in_chunks([&](std::uint32_t c) {
    std::uint32_t* counts = histograms + std::size_t{c} * kDigits;
    std::memset(counts, 0, kDigits * sizeof *counts);
    for (std::uint32_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) ++counts[digit.of(from.keys[i])];
  });
  std::uint32_t sum = 0;
  for (std::uint32_t d = 0; d < kDigits; ++d)
    for (std::uint32_t c = 0; c < chunks; ++c) {
      std::uint32_t& count = histograms[std::size_t{c} * kDigits + d];
      sum += std::exchange(count, sum);
    }
  in_chunks([&](std::uint32_t c) {
    std::uint32_t* next = histograms + std::size_t{c} * kDigits;
    for (std::uint32_t i = c * chunk; i < std::min(n, (c + 1) * chunk); ++i) {
      const std::uint32_t at = next[digit.of(from.keys[i])]++;
      to.keys[at] = from.keys[i];
      to.values[at] = from.values[i];
    }
  });
}

/// By insertion, by the low bits of the keys. Stable.
template <class K>
void sort_few(std::uint32_t n, int bits, KeyedInput<K> from, Keyed<K> to) {
  const K mask = bits < static_cast<int>(8 * sizeof(K)) ? (K{1} << bits) - 1 : ~K{0};
  for (std::uint32_t i = 0; i < n; ++i) {
    const K key = from.keys[i];
    std::uint32_t at = i;
    for (; at > 0 && (to.keys[at - 1] & mask) > (key & mask); --at) {
      to.keys[at] = to.keys[at - 1];
      to.values[at] = to.values[at - 1];
    }
    to.keys[at] = key;
    to.values[at] = from.values[i];
  }
}

}  // namespace

template <class K>
void RadixSort<K>::reserve(std::uint32_t capacity) {
  if (capacity <= capacity_) return;
  scratch_.grow(std::size_t{capacity} * (sizeof(K) + sizeof(std::uint32_t)) +
                std::size_t{kMostChunks} * kDigits * sizeof(std::uint32_t));
  capacity_ = capacity;
}

template <class K>
void RadixSort<K>::run(Executor& executor, Count n, K* keys, const std::uint32_t* values, K* sorted_keys,
                       std::uint32_t* sorted_values, int bits) {
  run(executor, std::min(*n.value, n.capacity), keys, values, sorted_keys, sorted_values, bits);
}

template <class K>
void RadixSort<K>::run(Executor& executor, std::uint32_t n, const K* keys, const std::uint32_t* values, K* sorted_keys,
                       std::uint32_t* sorted_values, int bits) {
  PLUMB_ASSERT(n <= capacity_);
  PLUMB_ASSERT(bits >= 0 && bits <= static_cast<int>(8 * sizeof(K)));
  if (n <= kFew) return sort_few<K>(n, bits, {keys, values}, {sorted_keys, sorted_values});
  auto* histograms = reinterpret_cast<std::uint32_t*>(scratch_.data());
  auto* other_keys = reinterpret_cast<K*>(histograms + std::size_t{kMostChunks} * kDigits);
  const Keyed<K> other = {other_keys, reinterpret_cast<std::uint32_t*>(other_keys + capacity_)};
  const Keyed<K> sorted = {sorted_keys, sorted_values};
  const int passes = std::max(1, (bits + kDigitBits - 1) / kDigitBits);
  const std::uint32_t chunks = chunks_for(n, executor.threads());

  KeyedInput<K> from = {keys, values};
  for (int p = 0; p < passes; ++p) {
    const Keyed<K>& to = (passes - p) % 2 == 1 ? sorted : other;  // so that the last pass ends there
    pass(executor.pool(), n, chunks, Digit{kDigitBits * p, std::min(kDigitBits, bits - kDigitBits * p)}, from, to,
         histograms);
    from = {to.keys, to.values};
  }
}

template class RadixSort<std::uint32_t>;
template class RadixSort<std::uint64_t>;

void Scan::reserve(std::uint32_t capacity) { capacity_ = std::max(capacity, capacity_); }

void Scan::run(Executor& executor, Count n, const std::uint32_t* values, std::uint32_t* sums, std::uint32_t* total) {
  run(executor, std::min(*n.value, n.capacity), values, sums, total);
}

void Scan::run(Executor& /*executor*/, std::uint32_t n, const std::uint32_t* values, std::uint32_t* sums,
               std::uint32_t* total) {
  PLUMB_ASSERT(n <= capacity_);
  std::uint64_t sum = 0;
  const auto saturated = [](std::uint64_t s) { return static_cast<std::uint32_t>(std::min<std::uint64_t>(s, ~0U)); };
  for (std::uint32_t i = 0; i < n; ++i) {
    const std::uint32_t value = values[i];
    sums[i] = saturated(sum);
    sum += value;
  }
  *total = saturated(sum);
}

}  // namespace plumb::impulse
