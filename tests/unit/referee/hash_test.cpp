// The state hash: what it tells apart and what it does not, and one value that must never change.
#include "referee/hash.hpp"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "plumb/types.h"

namespace plumb::referee {
namespace {

struct Velocity {
  PlumbVec3 linear, angular;
};

std::uint64_t hash_of(const std::vector<double>& numbers) {
  backend::StateHash hash;
  for (const double x : numbers) hash.add(x);
  return hash.value();
}

TEST(StateHash, TellsSignsAndOrderApartAndTakesEveryNanAsOne) {
  EXPECT_NE(hash_of({0.0}), hash_of({-0.0}));
  EXPECT_NE(hash_of({1, 2}), hash_of({2, 1}));
  EXPECT_NE(hash_of({}), hash_of({0.0}));
  EXPECT_NE(hash_of({0.0}), hash_of({0.0, 0.0}));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(hash_of({nan}), hash_of({-nan}));
  EXPECT_EQ(hash_of({nan}), hash_of({std::bit_cast<double>(std::uint64_t{0x7ff0000000000001})}));
  EXPECT_NE(hash_of({nan}), hash_of({std::numeric_limits<double>::infinity()}));
}

TEST(StateHash, OneBitMovesHalfTheHash) {
  std::set<std::uint64_t> seen;
  double flipped = 0;
  for (int word = 0; word < 4; ++word)
    for (int bit = 0; bit < 52; ++bit) {
      std::vector<double> numbers = {1, 2, 3, 4};
      auto& x = numbers[static_cast<std::size_t>(word)];
      x = std::bit_cast<double>(std::bit_cast<std::uint64_t>(x) ^ (std::uint64_t{1} << bit));
      const std::uint64_t changed = hash_of(numbers) ^ hash_of({1, 2, 3, 4});
      EXPECT_TRUE(seen.insert(changed).second);
      flipped += std::popcount(changed);
      EXPECT_GT(std::popcount(changed), 12);
    }
  EXPECT_NEAR(flipped / (4 * 52), 32, 1);
}

TEST(StateHash, RowsGoPoseThenVelocityBodyByBody) {
  const std::vector<PlumbPose> poses = {{{1, 2, 3}, {0, 0, 0, 1}}, {{4, 5, 6}, {1, 0, 0, 0}}};
  const std::vector<Velocity> velocities = {{{7, 8, 9}, {1, 1, 1}}, {{2, 2, 2}, {3, 3, 3}}};
  const std::uint64_t value = state_hash<PlumbPose, Velocity>(poses, velocities);
  EXPECT_EQ(value, hash_of({1, 2, 3, 0, 0, 0, 1, 7, 8, 9, 1, 1, 1, 4, 5, 6, 1, 0, 0, 0, 2, 2, 2, 3, 3, 3}));
  EXPECT_EQ(value, 0x33e25dfb004f4279u);  // recorded hashes of scenes rest on this function
}

}  // namespace
}  // namespace plumb::referee
