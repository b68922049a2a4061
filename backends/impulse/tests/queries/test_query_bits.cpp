// Queries give the same bits on every machine and device: a hash over all that they answer, recorded on a CPU.
#include <gtest/gtest.h>

#include "exec/executor.hpp"
#include "math/real.hpp"
#include "tests/rigs/engine.hpp"
#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kBitNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_QUERIES;
constexpr PlumbFilter kSeesAll = {1, ~0u, 0, 0};
constexpr bool kDouble = sizeof(Real) == sizeof(double);

/// FNV-1a
struct Hash {
  std::uint64_t value = 0xCBF29CE484222325U;
  template <class Row>
  void add(std::span<const Row> rows) {
    const auto* bytes = reinterpret_cast<const unsigned char*>(rows.data());
    for (std::size_t i = 0; i < rows.size_bytes(); ++i) value = (value ^ bytes[i]) * 0x100000001B3U;
  }
};

/// Shapes of all kinds in a heap, as thrown, and questions of all kinds.
class QueryBits : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string unmet = Executor::unmet_requirement(); !unmet.empty()) GTEST_SKIP() << unmet;
    scene_ = std::make_unique<Scene>(engine(), kBitNeeds, PlumbVec3{0, -9.81, 0}, 1);
    scene_->container(4, 30);
    std::vector<PlumbVec3> points;
    for (int i = 0; i < 14; ++i)
      points.push_back({random_.between(-.5, .5), random_.between(-.5, .5), random_.between(-.5, .5)});
    shapes_ = {scene_->sphere(0.4), scene_->box({0.5, 0.3, 0.4}), scene_->capsule(0.3, 0.4), scene_->hull(points)};
    for (std::size_t i = 0; i < 120; ++i) {
      const PlumbVec3 at = {random_.between(-3, 3), random_.between(0, 8), random_.between(-3, 3)};
      scene_->add(shapes_[i % 4], at, random_.turn());
    }
  }
  PlumbVec3 place() { return {random_.between(-4, 4), random_.between(-1, 8), random_.between(-4, 4)}; }
  PlumbVec3 way() { return {random_.between(-6, 6), random_.between(-9, 3), random_.between(-6, 6)}; }
  IQueries& ask() { return *scene_->world().queries(); }

  Random random_{77};
  std::unique_ptr<Scene> scene_;
  std::vector<PlumbShape> shapes_;
};

TEST_F(QueryBits, OfRaysAreThoseRecorded) {
  std::vector<PlumbRay> rays;
  for (int i = 0; i < 4000; ++i) rays.push_back({place(), way(), kSeesAll});
  Hash hash;
  hash.add(ask().cast_rays(PLUMB_HIT_CLOSEST, rays).hits);
  hash.add(ask().cast_rays(PLUMB_HIT_ALL, rays).hits);
  EXPECT_EQ(hash.value, kDouble ? 0x41a052757009854bU : 0xb06d6d27fa2014c1U);
}

TEST_F(QueryBits, OfCastsAndOverlapsAreThoseRecorded) {
  std::vector<PlumbCast> casts;
  std::vector<PlumbOverlap> overlaps;
  for (std::size_t i = 0; i < 2000; ++i) {
    casts.push_back({shapes_[i % 4], {place(), random_.turn()}, way(), kSeesAll});
    overlaps.push_back({shapes_[i % 4], {place(), random_.turn()}, kSeesAll});
  }
  Hash hash;
  hash.add(ask().cast_shapes(PLUMB_HIT_CLOSEST, casts).hits);
  hash.add(ask().cast_shapes(PLUMB_HIT_ALL, casts).hits);
  hash.add(ask().overlap_shapes(overlaps).hits);
  EXPECT_EQ(hash.value, kDouble ? 0x3ad03151dd5a4405U : 0x317e25dd274c9fecU);
}

TEST_F(QueryBits, OfTurningCastsAreThoseRecorded) {
  std::vector<PlumbTurningCast> casts;
  for (std::size_t i = 0; i < 1000; ++i) {
    const PlumbVec3 from = place(), along = way();
    const PlumbQuat turn = random_.turn();
    const double x = random_.between(-3, 3), y = random_.between(-3, 3), z = random_.between(-3, 3);
    casts.push_back({shapes_[i % 4], {from, turn}, along, {x, y, z}, kSeesAll});
  }
  Hash hash;
  hash.add(ask().turning_casts(PLUMB_HIT_CLOSEST, casts).hits);
  hash.add(ask().turning_casts(PLUMB_HIT_ALL, casts).hits);
  EXPECT_EQ(hash.value, kDouble ? 0x2c7e80f6d16c5b5eU : 0xc5f216229ba43740U);
}

TEST_F(QueryBits, OfDepthsAreThoseRecorded) {
  std::vector<PlumbOverlap> overlaps;
  for (std::size_t i = 0; i < 2000; ++i) overlaps.push_back({shapes_[i % 4], {place(), random_.turn()}, kSeesAll});
  Hash hash;
  hash.add(ask().penetrations(overlaps).rows);
  EXPECT_EQ(hash.value, kDouble ? 0x644645958d7a267cU : 0xffdd6fbea0f8969U);
}

TEST_F(QueryBits, OfTheClosestAreThoseRecorded) {
  std::vector<PlumbProbe> probes;
  for (std::size_t i = 0; i < 2000; ++i)
    probes.push_back({shapes_[i % 4], {place(), random_.turn()}, random_.between(0.1, 3), kSeesAll});
  IClosest& closest = *scene_->world().closest();
  Hash hash;
  hash.add(closest.closest_bodies(PLUMB_HIT_CLOSEST, probes).rows);
  hash.add(closest.closest_bodies(PLUMB_HIT_ALL, probes).rows);
  EXPECT_EQ(hash.value, kDouble ? 0x94878af4d08808e3U : 0x46c81f55cbce539eU);
}

TEST_F(QueryBits, OfPosedPairsAreThoseRecorded) {
  std::vector<PlumbPosedPair> pairs;
  for (std::size_t i = 0; i < 4000; ++i) {
    const PlumbVec3 a = place();
    const PlumbVec3 b = {a.x + random_.between(-1, 1), a.y + random_.between(-1, 1), a.z + random_.between(-1, 1)};
    pairs.push_back({shapes_[i % 4], shapes_[i / 4 % 4], {a, random_.turn()}, {b, random_.turn()}});
  }
  std::vector<PlumbPairResult> results(pairs.size());
  std::span<const PlumbPairPoint> points;
  check(scene_->world(), scene_->world().collide()->collide_pairs(pairs, results, points));
  Hash hash;
  hash.add(std::span<const PlumbPairResult>(results));
  hash.add(points);
  EXPECT_EQ(hash.value, kDouble ? 0xd21e19bec0884449U : 0xbe9b33a82984c484U);
}

/// A cylinder, a plane, a mesh and a height field among the others, and all questions at once. The surfaces' heights
/// are sums of products, which are the same everywhere.
TEST_F(QueryBits, OfAllShapesAreThoseRecorded) {
  PlumbShapeDesc round = shape_desc(PLUMB_CYLINDER);
  round.radius = 0.4;
  round.half_height = 0.3;
  shapes_.push_back(scene_->make(round));
  for (int i = 0; i < 20; ++i) {
    const PlumbQuat turn = random_.turn();  // first: arguments have no order
    scene_->add(shapes_[4], place(), turn);
  }
  const auto hill = [](double x, double z) { return 0.05 * x * z + 0.1 * x * x - 0.02 * z * z * z; };
  std::vector<double> heights;
  for (int row = 0; row < 20; ++row)
    for (int column = 0; column < 15; ++column) heights.push_back(hill(0.3 * (column - 7), 0.2 * (row - 10)));
  const PlumbShape mesh = scene_->make(grid(14, 0.4, hill).desc()),
                   field = scene_->make(field_desc(heights, 20, 15, 0.35)),
                   plane = scene_->make(shape_desc(PLUMB_PLANE));
  scene_->add_static(mesh, {0.5, 3, 0}, random_.turn());
  scene_->add_static(field, {-1, 4, 1}, random_.turn());
  scene_->add_static(plane, {0, 0.5, 0}, random_.turn());
  std::vector<PlumbRay> rays;
  std::vector<PlumbCast> casts;
  std::vector<PlumbOverlap> overlaps;
  std::vector<PlumbPosedPair> pairs;
  for (std::size_t i = 0; i < 1000; ++i) {
    rays.push_back({place(), way(), kSeesAll});
    casts.push_back({shapes_[i % 5], {place(), random_.turn()}, way(), kSeesAll});
    overlaps.push_back({shapes_[i % 5], {place(), random_.turn()}, kSeesAll});
    const PlumbVec3 a = {random_.between(-2, 2), random_.between(-2, 2), random_.between(-2, 2)};
    const PlumbShape ground = i % 4 == 0 ? mesh : i % 4 == 1 ? field : i % 4 == 2 ? plane : shapes_[4];
    pairs.push_back({shapes_[i % 5], ground, {a, random_.turn()}, {{0, 0, 0}, random_.turn()}});
    if (i % 3 == 0) std::swap(pairs.back().shape_a, pairs.back().shape_b);
  }
  Hash hash;
  hash.add(ask().cast_rays(PLUMB_HIT_CLOSEST, rays).hits);
  hash.add(ask().cast_rays(PLUMB_HIT_ALL, rays).hits);
  hash.add(ask().cast_shapes(PLUMB_HIT_CLOSEST, casts).hits);
  hash.add(ask().cast_shapes(PLUMB_HIT_ALL, casts).hits);
  hash.add(ask().overlap_shapes(overlaps).hits);
  std::vector<PlumbPairResult> results(pairs.size());
  std::span<const PlumbPairPoint> points;
  check(scene_->world(), scene_->world().collide()->collide_pairs(pairs, results, points));
  hash.add(std::span<const PlumbPairResult>(results));
  hash.add(points);
  EXPECT_EQ(hash.value, kDouble ? 0xaa8caa74002b86f1U : 0x3941c5a58bc36b86U);
}

}  // namespace
}  // namespace plumb::impulse::test
