// Queries as a whole: nothing, extremes, threads, sleepers, deep trees, bodies of several shapes, and the step after
// them.
#include <cmath>
#include <thread>

#include "tests/rigs/query_fixture.hpp"
#include "tests/rigs/query_rig.hpp"

namespace plumb::impulse::test {
namespace {

TEST_F(Queries, OfNothingAndInNothingFindNothing) {
  make(0, 1);
  EXPECT_EQ(ask().cast_rays(PLUMB_HIT_CLOSEST, {}).hits.size(), 0U);
  EXPECT_EQ(ask().cast_rays(PLUMB_HIT_ALL, {}).hits.size(), 0U);
  EXPECT_EQ(ask().overlap_shapes({}).hits.size(), 0U);
  const PlumbRay ray = {{0, 5, 0}, {0, -10, 0}, kSeesAll};
  EXPECT_EQ(ask().cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0].body, 0U);
  EXPECT_EQ(ask().cast_rays(PLUMB_HIT_ALL, {&ray, 1}).hits.size(), 0U);
}

TEST_F(Queries, NumbersAtTheEndOfTheirRangeFindNothingWrong) {
  make(20, 3);
  std::vector<PlumbRay> rays;
  for (const double size : {1e-320, 1e-300, 1e-30, 1e30, 1e300, 1.7e308})
    for (const double far : {0.0, 1e30, 1e308}) rays.push_back({{far, 50, 0}, {-size, size / 2, size}, kSeesAll});
  rays.push_back({{0, -1e9, 0}, {0, 1e300, 0}, kSeesAll});
  const Hits hits = ask().cast_rays(PLUMB_HIT_CLOSEST, rays);
  for (const PlumbHit& hit : hits.hits)
    EXPECT_TRUE(hit.body == 0 || (hit.fraction >= 0 && hit.fraction <= 1)) << hit.query;
}

TEST_F(Queries, OfSeveralThreadsAtOnceAreThoseOfOne) {
  make(80, 5);
  std::vector<PlumbRay> rays;
  for (int i = 0; i < 400; ++i) rays.push_back(random_ray(5));
  scene_->run(1);
  std::vector<PlumbHit> found[4];
  std::vector<std::thread> threads;
  for (auto& mine : found)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) {
        const Hits hits = ask().cast_rays(i % 2 == 0 ? PLUMB_HIT_ALL : PLUMB_HIT_CLOSEST, rays);
        if (i == 18) mine.assign(hits.hits.begin(), hits.hits.end());
      }
    });
  for (std::thread& thread : threads) thread.join();
  const Hits alone = ask().cast_rays(PLUMB_HIT_ALL, rays);
  for (const auto& mine : found) {
    ASSERT_EQ(mine.size(), alone.hits.size());
    EXPECT_EQ(std::memcmp(mine.data(), alone.hits.data(), mine.size() * sizeof(PlumbHit)), 0);
  }
}

TEST_F(Queries, ChangeNothingOfTheStep) {
  const auto tumble = [&](bool asking) {
    Scene scene(engine(), kNeeds, {0, -9.81, 0}, 1);
    scene.ground();
    const PlumbShape cube = scene.box({0.4, 0.4, 0.4});
    for (int i = 0; i < 20; ++i) scene.add(cube, {0.3 * (i % 3), 1 + 0.9 * i, 0.2 * (i % 2)});
    const PlumbRay ray = {{0, 50, 0}, {0, -100, 0}, kSeesAll};
    for (int i = 0; i < 60; ++i) {
      if (asking) {
        EXPECT_NE(scene.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0].body, 0U);
      }
      scene.run(1);
    }
    return scene.hash();
  };
  EXPECT_EQ(tumble(true), tumble(false));
}

TEST_F(Queries, SeeSleepersAndWhereTheyAreWhenTheyHaveWoken) {
  Scene scene(engine(), kNeeds | PLUMB_NEED_SLEEPING, {0, -9.81, 0}, 1);
  scene.ground();
  const PlumbBody cube = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  const auto seen_at = [&](double x) {
    const PlumbRay ray = {{x, 5, 0}, {0, -10, 0}, kSeesAll};
    return scene.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0].body == cube;
  };
  EXPECT_TRUE(seen_at(0));
  scene.run(200);
  double awake = 1;
  check(scene.world(), scene.world().read(PLUMB_FIELD_AWAKE, {&cube, 1}, rows_over(std::span(&awake, 1))));
  ASSERT_EQ(awake, 0);
  EXPECT_TRUE(seen_at(0));
  scene.write(PLUMB_FIELD_VELOCITY, cube, {6, 0, 0, 0, 0, 0});
  EXPECT_TRUE(seen_at(0));
  scene.run(30);
  EXPECT_FALSE(seen_at(0));
  EXPECT_TRUE(seen_at(2.4));
}

/// Places that halve their way to a corner make a tree of one leaf a level, and the ray meets all of it.
TEST_F(Queries, DeepTreesAreSearchedToTheEnd) {
  QueryRig rig;
  const std::uint32_t ball = rig.add_shape({ShapeType::kSphere, 0, {2, 0, 0}, 2});
  for (int axis = 0; axis < 3; ++axis)
    for (double away = 1; away > 1e-6; away /= 2) {
      Position at = {0, 0, 0};
      at[axis] = away;
      rig.add(ball, at, {0, 0, 0, 1}, true);
    }
  rig.update({0, 0, 0});
  const std::vector<PlumbRay> rays = {{{-9, -9, -9}, {18, 18, 18}, kSeesAll}, {{9, 9, 9}, {-18, -18, -18}, kSeesAll}};
  const Hits all = {PLUMB_OK, rig.rays(PLUMB_HIT_ALL, rays)};
  ASSERT_EQ(all.hits.size(), 2 * rig.ids.size());
  const PlumbHit first = all.hits[0], last = all.hits[rig.ids.size()];
  const std::span<const PlumbHit> closest = rig.rays(PLUMB_HIT_CLOSEST, rays);
  EXPECT_EQ(closest[0].body, first.body);
  EXPECT_EQ(closest[1].body, last.body);
}

TEST_F(Queries, ABodyOfSeveralProxiesIsHitOnce) {
  QueryRig rig;
  const std::uint32_t ball = rig.add_shape({ShapeType::kSphere, 0, {1, 0, 0}, 1});
  for (int b = 0; b < 40; ++b) {
    const std::uint32_t body = rig.add_body({0, 10.0 * b, 0}, {0, 0, 0, 1});
    for (const Real y : {Real(1), Real(-1), Real(3)}) rig.add_proxy(body, ball, {{0, y, 0}, {0, 0, 0, 1}}, b % 2 == 0);
  }
  rig.update({0, 0, 0}, true);
  const std::vector<PlumbRay> rays = {
      {{0, -100, 0}, {0, 1000, 0}, kSeesAll}, {{50, 0, 0}, {0, 1, 0}, kSeesAll}, {{0.5, 95, 0}, {0, 200, 0}, kSeesAll}};
  const auto parts = by_query(rig.rays(PLUMB_HIT_ALL, rays), rays.size());
  ASSERT_EQ(parts[0].size(), 40U);
  for (std::size_t b = 0; b < 40; ++b) {
    EXPECT_EQ(slot_of(parts[0][b].body), b);
    EXPECT_NEAR(parts[0][b].fraction, (100 + 10.0 * static_cast<double>(b) - 2) / 1000, 1e-12);
  }
  EXPECT_TRUE(parts[1].empty());
  EXPECT_EQ(parts[2].size(), 20U);
}

}  // namespace
}  // namespace plumb::impulse::test
