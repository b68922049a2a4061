// Queries give the same bits on every machine and device: a hash over all that they answer, recorded on a CPU.
#include <gtest/gtest.h>

#include "engine.hpp"
#include "exec/executor.hpp"
#include "math/real.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_QUERIES;
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
    scene_ = std::make_unique<Scene>(engine(), kNeeds, PlumbVec3{0, -9.81, 0}, 1);
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
  EXPECT_EQ(hash.value, kDouble ? 0xaa91cb9a47b3b144U : 0xb9a90a6190e34de5U);
}

}  // namespace
}  // namespace plumb::impulse::test
