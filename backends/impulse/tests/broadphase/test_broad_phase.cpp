// The broad phase against all pairs, tested one by one, and against a sweep of the test's own where they are too many.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <numeric>
#include <thread>

#include "broadphase/long_search.hpp"
#include "plumb/physics_world.hpp"
#include "tests/rigs/box_fields.hpp"
#include "tests/rigs/broad_phase_rig.hpp"

namespace plumb::impulse {
namespace {

/// Movers are the first `movers` boxes; no two statics make a pair.
std::vector<Pair> all_pairs(const std::vector<Box>& boxes, std::uint32_t movers) {
  std::vector<Pair> pairs;
  for (std::uint32_t a = 0; a < movers; ++a)
    for (std::uint32_t b = a + 1; b < boxes.size(); ++b)
      if (overlap(boxes[a], boxes[b])) pairs.push_back({a, b});
  return pairs;
}

std::uint32_t size(const std::vector<Pair>& pairs) { return static_cast<std::uint32_t>(pairs.size()); }

class BroadPhaseFields : public testing::TestWithParam<Field> {};
std::string field_name(const testing::TestParamInfo<Field>& info) { return name_of(info.param); }
INSTANTIATE_TEST_SUITE_P(All, BroadPhaseFields, testing::ValuesIn(kFields), field_name);

struct Choice {
  BroadPhase::Method method;
  MortonBits bits;
  bool deals_out = false;
};
constexpr Choice kWays[] = {{BroadPhase::Method::kLbvh, MortonBits::k30},
                            {BroadPhase::Method::kLbvh, MortonBits::k63},
                            {BroadPhase::Method::kLbvh, MortonBits::k63, true},
                            {BroadPhase::Method::kSweep, MortonBits::k63},
                            {BroadPhase::Method::kGrid, MortonBits::k63}};
void choose_way(BroadPhaseRig& rig, const Choice& way) {
  rig.broad_phase.method = way.method;
  rig.broad_phase.morton_bits = way.bits;
  rig.broad_phase.deals_out_long_searches = way.deals_out;
}

TEST_P(BroadPhaseFields, FindsWhatAllPairsFind) {
  for (const std::uint32_t n : {0U, 1U, 2U, 3U, 7U, 64U, 65U, 1000U, 4096U}) {
    const std::vector<Box> boxes = make_boxes(GetParam(), n, n);
    for (const std::uint32_t movers : {n, n - n / 5, n / 5, 0U}) {
      const std::vector<Pair> truth = all_pairs(boxes, movers);
      for (const Choice& way : kWays) {
        BroadPhaseRig rig;
        choose_way(rig, way);
        rig.set(boxes, movers);
        EXPECT_EQ(sorted(rig.find(size(truth))), truth)
            << n << " boxes, " << movers << " movers, method " << static_cast<int>(way.method);
        EXPECT_EQ(rig.found, size(truth));
      }
    }
  }
}

TEST_P(BroadPhaseFields, IsTheSameOrderForAnyNumberOfThreads) {
  const std::vector<Box> boxes = make_boxes(GetParam(), 12000, 3);
  for (const Choice& way : kWays) {
    std::vector<Pair> first;
    for (const std::uint32_t threads : {1U, 2U, 5U}) {
      BroadPhaseRig rig(threads);
      choose_way(rig, way);
      rig.set(boxes, 10000);
      const std::vector<Pair> pairs = rig.find(800000);
      ASSERT_EQ(rig.found, size(pairs));
      EXPECT_GT(size(pairs), 100U);
      if (threads == 1) first = pairs;
      EXPECT_EQ(pairs, first) << threads << " threads";
    }
  }
}

TEST_P(BroadPhaseFields, IsTheSameOrderByEveryMethod) {
  for (const std::uint32_t movers : {6000U, 4000U, 100U}) {
    const std::vector<Box> boxes = make_boxes(GetParam(), 6000, 8, 20);
    std::vector<Pair> tree;
    std::vector<PairRange> ranges;
    for (const Choice& way : kWays) {
      if (way.bits != MortonBits::k63) continue;
      BroadPhaseRig rig(2);
      choose_way(rig, way);
      rig.set(boxes, movers);
      const std::vector<Pair> pairs = rig.find(6000 * 400);
      ASSERT_EQ(rig.found, size(pairs));
      const std::vector<PairRange> own = rig.ranges.to_host(movers);
      if (tree.empty()) {
        tree = pairs;
        ranges = own;
      }
      EXPECT_EQ(pairs, tree) << movers << " movers, method " << static_cast<int>(way.method);
      const auto same = [](const PairRange& a, const PairRange& b) { return a.first == b.first && a.count == b.count; };
      EXPECT_TRUE(std::equal(own.begin(), own.end(), ranges.begin(), same)) << static_cast<int>(way.method);
    }
  }
}

/// A few hundred among thousands touch more than a search may look at before it is dealt out.
TEST(BroadPhase, DealsOutWhatWouldTakeLong) {
  for (const std::uint32_t giants : {1U, 40U, 3 * LongSearches::kMost}) {
    std::vector<Box> boxes = make_boxes(Field::kUniform, 12000, 6);
    const Real half = Real(.4) * boxes[0].high.x + 20;
    for (std::uint32_t i = 0; i < giants; ++i) boxes[i * 3] = box_at({0, 0, 0}, {half, half / 3, Real(.3)});
    for (const std::uint32_t movers : {12000U, giants * 3}) {
      BroadPhaseRig alone(3), dealt(3);
      choose_way(dealt, {BroadPhase::Method::kLbvh, MortonBits::k63, true});
      for (BroadPhaseRig* rig : {&alone, &dealt}) rig->set(boxes, movers);
      const std::vector<Pair> truth = alone.find(16U << 20);
      ASSERT_LE(alone.found, 16U << 20);
      EXPECT_EQ(dealt.find(16U << 20), truth) << giants << " giants, " << movers << " movers";
    }
  }
}

/// Every range holds pairs of its proxy, and all pairs lie in one range.
void expect_whole_ranges(BroadPhaseRig& rig, const std::vector<Pair>& pairs) {
  const std::vector<PairRange> ranges = rig.ranges.to_host(rig.mover_count);
  std::vector<int> owners(pairs.size());
  for (std::uint32_t proxy = 0; proxy < rig.mover_count; ++proxy) {
    const PairRange range = ranges[proxy];
    ASSERT_LE(range.first + range.count, size(pairs));
    for (std::uint32_t k = range.first; k < range.first + range.count; ++k) {
      EXPECT_TRUE(pairs[k].a == proxy || pairs[k].b == proxy);
      ++owners[k];
    }
  }
  EXPECT_EQ(owners, std::vector<int>(pairs.size(), 1));
}

TEST(BroadPhase, GivesEveryPairToTheMoverThatFoundIt) {
  for (const Choice& way : kWays) {
    BroadPhaseRig rig;
    choose_way(rig, way);
    rig.set(make_boxes(Field::kMixed, 3000, 1), 2500);
    expect_whole_ranges(rig, rig.find(200000));
  }
}

TEST(BroadPhase, SaysTheTrueNumberWhereTheRoomIsTooSmall) {
  const std::vector<Box> boxes = make_boxes(Field::kUniform, 2000, 5);
  for (const Choice& way : kWays) {
    BroadPhaseRig roomy, tight;
    choose_way(roomy, way);
    choose_way(tight, way);
    roomy.set(boxes, 1500);
    tight.set(boxes, 1500);
    const std::vector<Pair> all = roomy.find(100000);
    ASSERT_EQ(roomy.found, size(all));
    const std::uint32_t room = size(all) / 2;
    const Pair guard{123, 456};
    tight.pairs.grow(room + 1);
    const std::vector<Pair> guarded(room + 1, guard);
    tight.pairs.from_host(guarded.data(), guarded.size());
    const std::vector<Pair> some = tight.find(room);
    EXPECT_EQ(tight.found, size(all));
    if (way.method == BroadPhase::Method::kLbvh) {
      EXPECT_EQ(some, std::vector<Pair>(all.begin(), all.begin() + room));
    }
    std::vector<Pair> known = sorted(all), written = sorted(some);  // each a true one, and none twice
    EXPECT_TRUE(std::includes(known.begin(), known.end(), written.begin(), written.end()));
    EXPECT_EQ(std::adjacent_find(written.begin(), written.end()), written.end());
    EXPECT_EQ(tight.pairs.to_host(room + 1).back(), guard);
    expect_whole_ranges(tight, some);
  }
}

TEST(BroadPhase, AsksTheFilter) {
  const std::vector<Box> boxes(8, Box{{0, 0, 0}, {1, 1, 1}});
  for (const Choice& way : kWays) {
    BroadPhaseRig rig;
    choose_way(rig, way);
    rig.set(boxes, 6);
    rig.filters[1].body = 0;                           // two shapes of one body
    rig.filters[2].mask = 0;                           // touches nothing
    rig.filters[3].group = rig.filters[4].group = -2;  // never each other
    rig.filters[3].flags = rig.filters[6].flags = kProxyImmovable;
    rig.excluded = {body_pair_key(5, 0), body_pair_key(7, 4)};
    std::vector<Pair> expected = {{0, 3}, {0, 4}, {1, 3}, {1, 4}, {3, 5}, {4, 5}, {0, 6},
                                  {1, 6}, {4, 6}, {5, 6}, {0, 7}, {1, 7}, {3, 7}, {5, 7}};
    EXPECT_EQ(sorted(rig.find(28)), sorted(expected));
  }
}

TEST(BroadPhase, GroupsDecideBeforeMasks) {
  ProxyFilter a{0, 1, 0, 3, 0}, b{1, 2, 0, 3, 0};
  const PairFilter filter{nullptr, nullptr, 0};
  EXPECT_TRUE(filter(a, b));
  a.group = b.group = -3;
  a.mask = b.mask = ~0U;
  EXPECT_FALSE(filter(a, b));
  a.group = 0;
  EXPECT_TRUE(filter(a, b));
  a.mask = 1;
  EXPECT_FALSE(filter(a, b));
}

TEST(BroadPhase, WhatIsNotABoxTouchesNothingAndSpoilsNothing) {
  const Real nan = std::numeric_limits<Real>::quiet_NaN(), infinity = std::numeric_limits<Real>::infinity();
  const std::vector<Box> sound = make_boxes(Field::kUniform, 1000, 9);
  std::vector<Box> boxes = sound;
  boxes[10].low.x = nan;
  boxes[20].high = {nan, nan, nan};
  boxes[30] = {{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}};
  boxes[40] = {boxes[40].high, boxes[40].low};
  boxes[900].high.y = nan;
  std::vector<Pair> truth = all_pairs(sound, 800);
  std::erase_if(truth, [](const Pair& pair) {
    const auto spoilt = [](std::uint32_t i) { return i == 10 || i == 20 || i == 30 || i == 40 || i == 900; };
    return spoilt(pair.a) || spoilt(pair.b);
  });
  for (const Choice& way : kWays) {
    BroadPhaseRig rig;
    choose_way(rig, way);
    rig.set(boxes, 800);
    EXPECT_EQ(sorted(rig.find(size(truth))), truth) << static_cast<int>(way.method);
  }
}

/// A list of statics may be made up with a row of nobody; whoever gets that row later may move, and is found.
TEST(BroadPhase, WhoGetsARowOfNobodyIsFoundLikeAnyOther) {
  const std::vector<Box> all = make_boxes(Field::kUniform, 1000, 9);
  std::vector<Box> boxes = all;
  constexpr std::uint32_t kNobody = 500, kMovers = 800;
  boxes[kNobody] = empty_box();
  const std::vector<Pair> truth = all_pairs(all, kMovers);
  std::vector<Pair> tree;
  for (const Choice& way : kWays) {
    if (way.bits != MortonBits::k63) continue;
    BroadPhaseRig rig;
    choose_way(rig, way);
    rig.set(boxes, kMovers);
    std::vector<std::uint32_t> statics = {kNobody};
    for (std::uint32_t i = kMovers; i < 1000; ++i) statics.push_back(i);
    rig.static_count = static_cast<std::uint32_t>(statics.size());
    rig.statics.from_host(statics.data(), statics.size());
    rig.find(size(truth));
    rig.boxes.from_host(all.data(), all.size());
    rig.enqueue();
    rig.executor.wait();
    const std::vector<Pair> pairs = rig.pairs.to_host(rig.count.to_host(1)[0]);
    EXPECT_EQ(sorted(pairs), truth) << static_cast<int>(way.method);
    if (tree.empty()) tree = pairs;
    EXPECT_EQ(pairs, tree) << static_cast<int>(way.method);
  }
}

TEST(BroadPhase, RefusesMoreThanItHasRoomFor) {
  BroadPhaseRig rig;
  rig.set(make_boxes(Field::kUniform, 10, 1), 10);
  rig.broad_phase.reserve(rig.executor, 9, 0, 10);
  EXPECT_THROW(rig.enqueue(), Error);
}

/// Pairs by a sweep along x over std::sort, in double: no part of what it checks.
std::vector<Pair> swept_pairs(const std::vector<Box>& boxes) {
  std::vector<std::uint32_t> order(boxes.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(), [&](auto a, auto b) { return boxes[a].low.x < boxes[b].low.x; });
  std::vector<Box> ordered;
  for (const std::uint32_t i : order) ordered.push_back(boxes[i]);
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && ordered[j].low.x <= ordered[i].high.x; ++j)
      if (overlap(ordered[i], ordered[j])) pairs.push_back({min(order[i], order[j]), max(order[i], order[j])});
  return sorted(std::move(pairs));
}

TEST_P(BroadPhaseFields, FindsWhatASweepFindsAmongMany) {
  const std::vector<Box> boxes = make_boxes(GetParam(), 1U << 17, 2, 6);
  const std::vector<Pair> truth = swept_pairs(boxes);
  BroadPhaseRig rig;
  rig.set(boxes, 1U << 17);
  EXPECT_EQ(sorted(rig.find(size(truth))), truth);
  EXPECT_EQ(rig.found, size(truth));
}

TEST(BroadPhase, MethodsAgreeOnAMillion) {
  if (std::getenv("PLUMB_LONG_TESTS") == nullptr) GTEST_SKIP() << "set PLUMB_LONG_TESTS to run it";
  for (const Field field : {Field::kUniform, Field::kPlanar, Field::kGiant}) {
    BroadPhaseRig rig(std::thread::hardware_concurrency());
    rig.set(make_boxes(field, 1U << 20, 4, 10), 1U << 20);
    std::vector<Pair> first;
    for (const Choice& way : kWays) {
      choose_way(rig, way);
      const std::vector<Pair> pairs = sorted(rig.find(16U << 20));
      ASSERT_EQ(rig.found, size(pairs));
      if (first.empty()) first = pairs;
      EXPECT_EQ(pairs, first) << name_of(field) << ", method " << static_cast<int>(way.method);
    }
  }
}

}  // namespace
}  // namespace plumb::impulse
