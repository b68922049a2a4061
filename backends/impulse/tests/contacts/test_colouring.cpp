// Colours: nothing that is solved at once shares a body that it pushes, nothing is lost, and colours are kept.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

#include "contacts/colouring.hpp"

namespace plumb::impulse {
namespace {

/// Manifolds between bodies, of which the first `fixed` cannot be pushed.
struct ColouringRig {
  ColouringRig(std::uint32_t bodies, std::uint32_t fixed, std::vector<Pair> ends, std::uint32_t threads = 1)
      : executor(nullptr, threads), pairs(std::move(ends)), velocities(bodies), proxies(bodies), counters(1) {
    for (std::uint32_t i = 0; i < bodies; ++i) {
      proxies[i].body = i;
      velocities[i].inverse_mass = i < fixed ? Real(0) : Real(1);
    }
    const auto count = static_cast<std::uint32_t>(pairs.size());
    kept.resize(count);
    for (std::uint32_t i = 0; i < count; ++i) candidates.push_back(i);
    for (CachedManifold& manifold : kept) manifold.colour = kNone;
    counters[0].manifolds = count;
    colouring.reserve(executor, bodies, count);
  }

  void colour() {
    const auto count = counters[0].manifolds;
    counters[0] = {};
    counters[0].manifolds = count;
    ContactCache cache{};
    cache.pairs = pairs.data();
    cache.candidate = candidates.data();
    cache.kept = kept.data();
    colouring.begin(executor);
    for (std::size_t i = 0; i < kept.size(); ++i) {  // as the matching of contacts does
      if (kept[i].colour == kNone) continue;
      for (const std::uint32_t body : {pairs[i].a, pairs[i].b})
        if (velocities[body].inverse_mass > 0) colouring.masks()[body] |= std::uint64_t{1} << kept[i].colour;
    }
    std::uint32_t used = 0;
    for (const BodyLevel& level : levels) used = std::max(used, level.level + 1);
    counters[0].levels.count = used;
    colouring.colour(executor, cache, velocities.data(), proxies.data(), Mechanisms{},
                     levels.empty() ? BodyLevels() : BodyLevels(levels.data(), counters.data()), counters.data());
  }

  /// No body twice in a colour, every manifold once in the order, colours one after the other, whole groups of slots.
  void check() const {
    std::set<std::pair<std::uint32_t, std::uint32_t>> pushed;  // colour, body
    std::vector<std::uint32_t> seen(kept.size());
    for (std::uint32_t j = 0; j < kept.size(); ++j) {
      const std::uint32_t row = colouring.order()[j], colour = kept[row].colour;
      ASSERT_LT(row, kept.size());
      ++seen[row];
      ASSERT_LE(colour, kOverflow);
      const std::uint32_t key = colour_key(level_of(row), colour);
      ASSERT_EQ(colouring.keys()[j], key);
      ASSERT_GE(j, counters[0].first_in_colour[key]);
      ASSERT_LT(j, counters[0].first_in_colour[key + 1]);
      if (colour == kOverflow) continue;
      for (const std::uint32_t body : {pairs[row].a, pairs[row].b})
        if (velocities[body].inverse_mass > 0) {
          ASSERT_TRUE(pushed.insert({colour, body}).second) << "body " << body << " twice in colour " << colour;
        }
    }
    EXPECT_EQ(std::count(seen.begin(), seen.end(), 1U), static_cast<std::ptrdiff_t>(seen.size()));
    for (std::uint32_t body = 0; body < velocities.size(); ++body)  // whoever waits for a colour must not do so in vain
      for (std::uint32_t colour = 0; colour < kColours; ++colour)
        EXPECT_EQ(colouring.masks()[body] >> colour & 1U, pushed.count({colour, body}));
    for (std::uint32_t key = 0; key < colour_key(counters[0].levels.count, 0); ++key) {
      const std::uint32_t size = counters[0].first_in_colour[key + 1] - counters[0].first_in_colour[key];
      EXPECT_EQ(counters[0].first_slot[key] % kLaneGroup, 0U);
      EXPECT_GE(counters[0].first_slot[key + 1] - counters[0].first_slot[key], size);
    }
    EXPECT_EQ(counters[0].slots, counters[0].first_slot[colour_key(counters[0].levels.count, 0)]);
  }
  /// Of sub-steps, of a manifold.
  [[nodiscard]] std::uint32_t level_of(std::uint32_t row) const {
    const auto [a, b] = pairs[row];
    return levels.empty() ? 0 : levels[velocities[a].inverse_mass > 0 ? a : b].level;
  }
  [[nodiscard]] std::vector<std::uint32_t> colours() const {
    std::vector<std::uint32_t> all;
    for (const CachedManifold& manifold : kept) all.push_back(manifold.colour);
    return all;
  }

  Executor executor;
  Colouring colouring;
  std::vector<Pair> pairs;
  std::vector<Velocity> velocities;
  std::vector<Proxy> proxies;
  std::vector<std::uint32_t> candidates;
  std::vector<CachedManifold> kept;
  std::vector<BodyLevel> levels;  // where bodies have their own
  std::vector<StepCounters> counters;
};

std::vector<Pair> random_pairs(std::uint32_t bodies, std::uint32_t fixed, std::uint32_t count) {
  std::mt19937 random(7);
  std::vector<Pair> pairs;
  while (pairs.size() < count) {
    const auto a = static_cast<std::uint32_t>(random() % bodies), b = static_cast<std::uint32_t>(random() % bodies);
    if (a != b && std::max(a, b) >= fixed) pairs.push_back({std::min(a, b), std::max(a, b)});
  }
  return pairs;
}

TEST(Colouring, NoTwoOfAColourPushTheSameBody) {
  for (const std::uint32_t count : {1U, 10U, 3000U}) {
    ColouringRig rig(1000, 20, random_pairs(1000, 20, count));
    rig.colour();
    rig.check();
    EXPECT_EQ(rig.counters[0].first_in_colour[kOverflow], count) << "so few need no overflow";
  }
}

TEST(Colouring, DoesNotDependOnThreads) {
  ColouringRig one(500, 10, random_pairs(500, 10, 2000)), more(500, 10, random_pairs(500, 10, 2000), 2);
  one.colour();
  more.colour();
  EXPECT_EQ(one.colours(), more.colours());
}

TEST(Colouring, KeepsColoursAndColoursWhatIsNew) {
  ColouringRig rig(1000, 20, random_pairs(1000, 20, 3000));
  rig.colour();
  const std::vector<std::uint32_t> before = rig.colours();
  for (std::size_t i = 0; i < rig.kept.size(); i += 3) rig.kept[i].colour = kNone;
  rig.colour();
  rig.check();
  const std::vector<std::uint32_t> after = rig.colours();
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_TRUE(i % 3 == 0 || after[i] == before[i]) << i;
}

TEST(Colouring, WhatFindsNoColourOverflowsAndIsNotLost) {
  std::vector<Pair> star;
  for (std::uint32_t i = 1; i <= 200; ++i) star.push_back({0, i});
  ColouringRig rig(201, 0, star);
  rig.colour();
  rig.check();
  const std::vector<std::uint32_t> colours = rig.colours();
  EXPECT_EQ(std::count(colours.begin(), colours.end(), kOverflow), 200 - static_cast<std::ptrdiff_t>(kColours));
}

/// A raft that carries thousands: those that can have no colour do not wait for each other, one a round.
TEST(Colouring, AHubOfThousandsTakesAsManyRoundsAsColours) {
  std::vector<Pair> ends;
  for (std::uint32_t i = 1; i <= 3000; ++i) ends.push_back({0, i});
  ColouringRig rig(3001, 0, ends);
  rig.colour();
  rig.check();
  EXPECT_LE(rig.counters[0].rounds, kColours + 1);
}

TEST(Colouring, WhatCannotBePushedIsSharedByAll) {
  std::vector<Pair> on_the_ground;
  for (std::uint32_t i = 1; i <= 200; ++i) on_the_ground.push_back({0, i});
  ColouringRig rig(201, 1, on_the_ground);
  rig.colour();
  rig.check();
  EXPECT_EQ(rig.counters[0].colour_count[0], 1U);
}

/// Contacts of islands that have other sub-steps are apart, each colour of each level by itself.
TEST(Colouring, LevelsOfSubstepsAreApart) {
  constexpr std::uint32_t kBodies = 300, kFixed = 5;
  std::vector<Pair> pairs;
  for (const Pair& pair : random_pairs(kBodies, kFixed, 3000))
    if (pair.a < kFixed || pair.a % 3 == pair.b % 3) pairs.push_back(pair);
  ColouringRig rig(kBodies, kFixed, pairs);
  for (std::uint32_t body = 0; body < kBodies; ++body)
    rig.levels.push_back({body < kFixed ? 0 : 2 * (body % 3), 1, {0, body < kFixed ? Real(0) : Real(1), 0}});
  rig.colour();
  rig.check();
  EXPECT_EQ(rig.counters[0].levels.count, 5U);
  EXPECT_EQ(rig.counters[0].colour_count[1], 0U) << "nobody's";
  EXPECT_GT(rig.counters[0].colour_count[2], 1U);
}

}  // namespace
}  // namespace plumb::impulse
