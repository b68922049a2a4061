// Counting bits where kernels run, against the standard library on the host.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <vector>

#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "math/bits.hpp"
#include "tests/rigs/box_fields.hpp"

namespace plumb::impulse {
namespace {

struct Counted {
  int leading, leading_of_low, trailing, set;
};

struct CountBits {
  const std::uint64_t* words;
  Counted* counted;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const auto low = static_cast<std::uint32_t>(words[i]) | 1U;
    counted[i] = {leading_zeros(words[i]), leading_zeros(low), trailing_zeros(words[i]), bit_count(words[i])};
  }
};

TEST(Bits, AreCountedByKernelsAsByTheStandardLibrary) {
  Executor executor(nullptr, 1);
  FieldDice dice(5);
  std::vector<std::uint64_t> words;
  for (int highest = 0; highest < 64; ++highest)
    for (int lowest = 0; lowest <= highest; ++lowest) {
      const std::uint64_t ends = std::uint64_t{1} << highest | std::uint64_t{1} << lowest;
      words.push_back(ends | (dice.bits() >> (63 - highest) & ~std::uint64_t{0} << lowest));
    }
  const auto n = static_cast<std::uint32_t>(words.size());
  Buffer<std::uint64_t> from;
  from.from_host(words.data(), n);
  Buffer<Counted> to(n);
  executor.run(n, CountBits{from.data(), to.data()});
  executor.wait();
  const std::vector<Counted> counted = to.to_host(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    EXPECT_EQ(counted[i].leading, std::countl_zero(words[i])) << words[i];
    EXPECT_EQ(counted[i].leading_of_low, std::countl_zero(static_cast<std::uint32_t>(words[i]) | 1U)) << words[i];
    EXPECT_EQ(counted[i].trailing, std::countr_zero(words[i])) << words[i];
    EXPECT_EQ(counted[i].set, std::popcount(words[i])) << words[i];
  }
}

}  // namespace
}  // namespace plumb::impulse
