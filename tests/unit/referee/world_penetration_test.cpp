// All overlaps of a world: the sweep against all pairs, statistics, and the time for eight thousand boxes.
#include "referee/world_penetration.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "shapes.hpp"

namespace plumb::referee::testing {
namespace {

TEST(WorldPenetration, SweepFindsWhatAllPairsFind) {
  Random random(41);
  for (int round = 0; round < 10; ++round) {
    std::vector<ShapePtr> shapes = {plane()};
    std::vector<PosedShape> posed = {{shapes[0].get(), at(0, -3, 0), false}};
    for (int i = 1; i < 150; ++i) {
      shapes.push_back(random.convex());
      posed.push_back({shapes.back().get(), random.pose(4), i % 5 != 0});
    }
    const MayTouch rule = [](std::uint32_t a, std::uint32_t b) { return (a + b) % 7 != 0; };
    const WorldPenetration world = world_penetration(posed, rule);
    std::size_t at = 0;
    double squares = 0, worst = 0;
    for (std::uint32_t a = 0; a < posed.size(); ++a)
      for (std::uint32_t b = a + 1; b < posed.size(); ++b) {
        if ((!posed[a].moves && !posed[b].moves) || !rule(a, b)) continue;
        const double depth = penetration(*shapes[a], posed[a].pose, *shapes[b], posed[b].pose).depth;
        if (depth <= 0) continue;
        ASSERT_LT(at, world.overlaps.size());
        ASSERT_EQ(world.overlaps[at].a, a);
        ASSERT_EQ(world.overlaps[at].b, b);
        ASSERT_NEAR(world.overlaps[at++].penetration.depth, depth, 1e-12);
        squares += depth * depth;
        worst = std::max(worst, depth);
      }
    EXPECT_EQ(at, world.overlaps.size());
    EXPECT_GT(at, 20u);
    EXPECT_NEAR(world.sum_of_squares, squares, 1e-9);
    EXPECT_NEAR(world.max, worst, 1e-12);
  }
}

TEST(WorldPenetration, PercentilesAreNearestRank) {
  const ShapePtr ball = sphere(0.5);
  std::vector<PosedShape> posed;
  for (int i = 0; i < 100; ++i) {  // a hundred pairs, far apart, overlapping by 1 to 100 mm
    posed.push_back({ball.get(), at(10 * i, 0, 0)});
    posed.push_back({ball.get(), at(10 * i, 1 - 0.001 * (i + 1), 0)});
  }
  const WorldPenetration world = world_penetration(posed);
  ASSERT_EQ(world.overlaps.size(), 100u);
  EXPECT_NEAR(world.p50, 0.050, 1e-12);
  EXPECT_NEAR(world.p95, 0.095, 1e-12);
  EXPECT_NEAR(world.p99, 0.099, 1e-12);
  EXPECT_NEAR(world.max, 0.100, 1e-12);
  EXPECT_NEAR(world.sum_of_squares, 1e-6 * 338350, 1e-12);
  EXPECT_EQ(world_penetration({}).max, 0);
}

TEST(WorldPenetration, LeavesOutWhatIsNotFiniteOrHasNoShape) {
  const ShapePtr ball = sphere(0.5);
  std::vector<PosedShape> posed(3, {ball.get(), at(0, 0, 0)});
  posed[1].pose.position.x() = std::nan("");
  posed[2].shape = nullptr;
  EXPECT_TRUE(world_penetration(posed).overlaps.empty());
}

TEST(WorldPenetration, EightThousandBoxesInASecond) {
  Random random(42);
  const ShapePtr cube = box(0.5, 0.5, 0.5);
  std::vector<PosedShape> posed;
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j)
      for (int k = 0; k < 20; ++k)
        posed.push_back({cube.get(), turned(random.in(-20, 20), random.direction(), {0.99 * i, 0.99 * j, 0.99 * k})});
  const auto start = std::chrono::steady_clock::now();
  const WorldPenetration world = world_penetration(posed);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  RecordProperty("seconds", std::to_string(seconds));
  EXPECT_GT(world.overlaps.size(), 20000u);
#ifdef NDEBUG
  EXPECT_LT(seconds, 1);
#endif
}

}  // namespace
}  // namespace plumb::referee::testing
