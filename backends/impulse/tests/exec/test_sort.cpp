// Sorting and prefix sums against std's, for all counts around a chunk, a digit and a block.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "exec/reduce.hpp"
#include "exec/sort.hpp"
#include "tests/rigs/box_fields.hpp"

namespace plumb::impulse {
namespace {

constexpr std::uint32_t kCounts[] = {0, 1, 2, 3, 31, 32, 33, 255, 256, 257, 4095, 4096, 4097, 20000, 100001};
constexpr std::uint32_t kThreads[] = {1, 2, 5};

template <class K>
class Sorting : public testing::Test {};
using Keys = testing::Types<std::uint32_t, std::uint64_t>;
TYPED_TEST_SUITE(Sorting, Keys, );

/// Keys below 2^bits; few different ones where `few`, so that stability shows.
template <class K>
std::vector<K> keys_below(std::uint32_t n, int bits, bool few) {
  FieldDice dice(n + static_cast<std::uint32_t>(bits));
  std::vector<K> keys(n);
  for (K& key : keys) {
    const auto all = static_cast<K>(dice.bits());
    key = static_cast<K>(all >> (8 * static_cast<int>(sizeof(K)) - bits));
    if (few) key &= static_cast<K>(~K{0} << std::max(0, bits - 2));
  }
  return keys;
}

TYPED_TEST(Sorting, IsStableForAllCountsAndThreads) {
  using K = TypeParam;
  for (const std::uint32_t n : kCounts)
    for (const int bits : {1, 8, 9, 30, static_cast<int>(8 * sizeof(K))})
      for (const bool few : {false, true}) {
        const std::vector<K> keys = keys_below<K>(n, bits, few);
        std::vector<std::uint32_t> order(n);
        std::iota(order.begin(), order.end(), 0U);
        Buffer<K> from, to;
        Buffer<std::uint32_t> values, sorted_values, count;
        from.grow(n + 5U);
        from.from_host(keys.data(), n);
        to.grow(n + 5U);
        values.grow(n + 5U);
        values.from_host(order.data(), n);
        sorted_values.grow(n + 5U);
        count.from_host(&n, 1);
        std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
        for (const std::uint32_t threads : kThreads)
          for (const bool counted : {false, true}) {
            Executor executor(nullptr, threads);
            RadixSort<K> sort;
            sort.reserve(n + 5);
            if (counted) {
              sort.run(executor, Count{count.data(), n + 5}, from.data(), values.data(), to.data(),
                       sorted_values.data(), bits);
            } else {
              sort.run(executor, n, from.data(), values.data(), to.data(), sorted_values.data(), bits);
            }
            executor.wait();
            ASSERT_EQ(sorted_values.to_host(n), order)
                << n << " keys of " << bits << " bits, " << threads << " threads";
            const std::vector<K> result = to.to_host(n);
            for (std::uint32_t i = 0; i < n; ++i) ASSERT_EQ(result[i], keys[order[i]]);
          }
      }
}

TEST(Scan, IsTheSumOfAllBefore) {
  for (const std::uint32_t n : kCounts)
    for (const std::uint32_t threads : kThreads) {
      FieldDice dice(n);
      std::vector<std::uint32_t> values(n), sums(n);
      for (std::uint32_t& value : values) value = static_cast<std::uint32_t>(dice.bits() % 100);
      std::exclusive_scan(values.begin(), values.end(), sums.begin(), 0U);
      const std::uint32_t all = std::accumulate(values.begin(), values.end(), 0U);
      Buffer<std::uint32_t> from, to, total(1), count;
      from.grow(n + 5U);
      from.from_host(values.data(), n);
      to.grow(n + 5U);
      count.from_host(&n, 1);
      Executor executor(nullptr, threads);
      Scan scan;
      scan.reserve(n + 5);
      scan.run(executor, n, from.data(), to.data(), total.data());
      executor.wait();
      EXPECT_EQ(to.to_host(n), sums) << n;
      EXPECT_EQ(total.to_host(1)[0], all) << n;
      scan.run(executor, Count{count.data(), n + 5}, from.data(), to.data(), total.data());
      executor.wait();
      EXPECT_EQ(to.to_host(n), sums) << n;
      EXPECT_EQ(total.to_host(1)[0], all) << n;
    }
}

TEST(Scan, StaysAtTheGreatestNumber) {
  const std::vector<std::uint32_t> values = {0xFFFFFFF0U, 10U, 10U, 0xFFFFFFFFU, 1U};
  Buffer<std::uint32_t> from, to(values.size()), total(1);
  from.from_host(values.data(), values.size());
  Executor executor(nullptr, 1);
  Scan scan;
  scan.reserve(5);
  scan.run(executor, 5U, from.data(), to.data(), total.data());
  executor.wait();
  EXPECT_EQ(to.to_host(5), (std::vector<std::uint32_t>{0, 0xFFFFFFF0U, 0xFFFFFFFAU, ~0U, ~0U}));
  EXPECT_EQ(total.to_host(1)[0], ~0U);
}

struct Most {
  std::uint32_t value;
  PLUMB_HD static Most nothing() { return {0}; }
  PLUMB_HD static Most merged(const Most& a, const Most& b) { return {max(a.value, b.value)}; }
};
struct LoadMost {
  const std::uint32_t* values;
  PLUMB_HD Most operator()(std::uint32_t i) const { return {values[i]}; }
};

TEST(Reduce, MergesAll) {
  for (const std::uint32_t n : kCounts)
    for (const std::uint32_t at : {0U, n / 3, n - 1}) {
      std::vector<std::uint32_t> values(n, 1);
      if (n > 0) values[at] = 7;
      Buffer<std::uint32_t> from;
      from.from_host(values.data(), n);
      Buffer<Most> result(1);
      Executor executor(nullptr, 2);
      Reduce<Most> reduce;
      reduce.reserve(n);
      reduce.run(executor, n, LoadMost{from.data()}, result.data());
      executor.wait();
      EXPECT_EQ(result.to_host(1)[0].value, n == 0 ? 0U : 7U) << n;
    }
}

}  // namespace
}  // namespace plumb::impulse
