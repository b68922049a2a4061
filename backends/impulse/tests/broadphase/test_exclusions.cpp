// The list of pairs that do not collide: joined ones and exceptions, each for itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "broadphase/exclusions.hpp"

namespace plumb::impulse {
namespace {

/// What the pair filter of a step would not let through, of all pairs of so many bodies that touch everything.
std::set<std::uint64_t> kept_apart(Exclusions& exclusions, std::uint32_t bodies) {
  exclusions.upload();
  std::vector<std::uint64_t> keys(exclusions.count());
  if (!keys.empty()) memory::download(keys.data(), exclusions.device(), keys.size() * sizeof(std::uint64_t));
  EXPECT_TRUE(std::is_sorted(keys.begin(), keys.end()));
  const PairFilter filter{nullptr, keys.data(), static_cast<std::uint32_t>(keys.size())};
  std::set<std::uint64_t> apart;
  for (std::uint32_t a = 0; a < bodies; ++a)
    for (std::uint32_t b = 0; b < bodies; ++b)
      if (a != b && !filter(ProxyFilter{a, 1, 1, 0, 0}, ProxyFilter{b, 1, 1, 0, 0})) apart.insert(body_pair_key(a, b));
  return apart;
}

TEST(Exclusions, AreJoinedPairsAndExceptions) {
  using Keys = std::set<std::uint64_t>;
  const std::uint64_t joined = body_pair_key(5, 0), both = body_pair_key(4, 7), excepted = body_pair_key(1, 2);
  Exclusions exclusions;
  EXPECT_EQ(kept_apart(exclusions, 9), Keys());
  EXPECT_EQ(exclusions.count(), 0U);
  exclusions.set_joined({both, joined, both});
  EXPECT_EQ(kept_apart(exclusions, 9), (Keys{joined, both}));
  EXPECT_EQ(exclusions.count(), 2U);
  exclusions.add_exceptions({both, excepted});
  EXPECT_EQ(kept_apart(exclusions, 9), (Keys{joined, both, excepted}));
  EXPECT_TRUE(exclusions.excepts(2, 1) && exclusions.excepts(7, 4));
  EXPECT_FALSE(exclusions.excepts(0, 5)) << "a joint does";
  exclusions.set_joined({joined});
  EXPECT_EQ(kept_apart(exclusions, 9), (Keys{joined, both, excepted}));
  exclusions.remove_exceptions({both});
  EXPECT_EQ(kept_apart(exclusions, 9), (Keys{joined, excepted}));
  exclusions.remove_exceptions({excepted});
  exclusions.set_joined({});
  EXPECT_EQ(kept_apart(exclusions, 9), Keys());
  EXPECT_EQ(exclusions.count(), 0U) << "what is not there costs nothing";
}

TEST(Exclusions, KeepTheirLengthWhileExceptionsComeAndGo) {
  Exclusions exclusions;
  for (std::uint32_t i = 0; i < 40; ++i) {
    exclusions.add_exceptions({body_pair_key(i, 100)});
    EXPECT_EQ(kept_apart(exclusions, 120).size(), i + 1);
    EXPECT_EQ(exclusions.count(), 64U) << "a recorded step need not be recorded anew";
  }
}

}  // namespace
}  // namespace plumb::impulse
