// Casts of shapes that turn: up to a hit nothing is overlapped and just behind it something is, told by penetrations;
// near misses are misses; the same wherever the world is, and whatever else is asked.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "exec/executor.hpp"
#include "math/real.hpp"
#include "tests/rigs/engine.hpp"
#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kTurningNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_QUERIES;
constexpr PlumbFilter kAllSeen = {1, ~0U, 0, 0};
constexpr double kPiD = 3.14159265358979323846;

PlumbVec3 sum(const PlumbVec3& a, double k, const PlumbVec3& b) {
  return {a.x + k * b.x, a.y + k * b.y, a.z + k * b.z};
}
double size(const PlumbVec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }
PlumbQuat product(const PlumbQuat& a, const PlumbQuat& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}
/// The pose at a fraction of the way.
PlumbPose pose_at(const PlumbTurningCast& cast, double fraction) {
  const double angle = size(cast.rotation), s = angle > 0 ? std::sin(fraction * angle / 2) / angle : 0;
  const PlumbVec3& r = cast.rotation;
  return {sum(cast.pose.position, fraction, cast.translation),
          product({s * r.x, s * r.y, s * r.z, std::cos(fraction * angle / 2)}, cast.pose.orientation)};
}

class TurningCasts : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string unmet = Executor::unmet_requirement(); !unmet.empty()) GTEST_SKIP() << unmet;
    begin();
  }
  void begin() {
    scene_ = std::make_unique<Scene>(engine(), kTurningNeeds, PlumbVec3{0, 0, 0}, 1);
    PlumbShapeDesc round = shape_desc(PLUMB_CYLINDER);
    round.radius = 0.3;
    round.half_height = 0.5;
    std::vector<PlumbVec3> points;
    for (int i = 0; i < 14; ++i)
      points.push_back({random_.between(-.5, .5), random_.between(-.5, .5), random_.between(-.5, .5)});
    shapes_ = {scene_->sphere(0.4), scene_->box({0.75, 0.125, 0.25}), scene_->capsule(0.1, 0.8), scene_->hull(points),
               scene_->make(round)};
  }
  /// Shapes of all kinds, a hill and a field about a place.
  void crowd(const PlumbVec3& about) {
    for (std::size_t i = 0; i < 60; ++i) {
      const PlumbVec3 at = place(about);
      scene_->add(shapes_[i % 5], at, random_.turn());
    }
    const auto hill = [](double x, double z) { return 0.05 * x * z + 0.1 * x * x; };
    scene_->add_static(scene_->make(grid(10, 0.5, hill).desc()), sum(about, 1, {0, -3, 0}));
    std::vector<double> heights;
    for (int row = 0; row < 12; ++row)
      for (int column = 0; column < 12; ++column) heights.push_back(hill(0.3 * (column - 6), 0.3 * (row - 6)));
    scene_->add_static(scene_->make(field_desc(heights, 12, 12, 0.5)), sum(about, 1, {0, 4, 0}), {1, 0, 0, 0});
  }
  PlumbVec3 place(const PlumbVec3& about) {
    const double x = random_.between(-4, 4), y = random_.between(-3, 3), z = random_.between(-4, 4);
    return sum(about, 1, {x, y, z});
  }
  PlumbTurningCast any_cast(std::size_t i, const PlumbVec3& about) {
    const PlumbVec3 from = place(about), to = place(about);
    const double x = random_.between(-3, 3), y = random_.between(-3, 3), z = random_.between(-3, 3);
    const PlumbQuat turn = random_.turn();
    return {shapes_[i % 5], {from, turn}, i % 4 == 0 ? PlumbVec3{0, 0, 0} : sum(to, -1, from), {x, y, z}, kAllSeen};
  }
  std::vector<PlumbHit> ask(PlumbHitMode mode, std::span<const PlumbTurningCast> casts) {
    const Hits found = scene_->world().queries()->turning_casts(mode, casts);
    check(scene_->world(), found.result);
    return {found.hits.begin(), found.hits.end()};
  }
  PlumbHit closest(const PlumbTurningCast& cast) { return ask(PLUMB_HIT_CLOSEST, {&cast, 1}).at(0); }
  /// Who is overlapped by more than a micrometre.
  std::vector<PlumbBody> overlapped(PlumbShape shape, const PlumbPose& pose) {
    const PlumbOverlap overlap = {shape, pose, kAllSeen};
    std::vector<PlumbBody> bodies;
    for (const PlumbPenetration& row : scene_->world().queries()->penetrations({&overlap, 1}).rows)
      if (row.depth > 1e-6) bodies.push_back(row.body);
    return bodies;
  }

  Random random_{5};
  std::unique_ptr<Scene> scene_;
  std::vector<PlumbShape> shapes_;
};

/// At 40 places before each closest hit nothing is overlapped, or all along where there is none; a hair behind it the
/// body that it is of, unless that is left at once.
TEST_F(TurningCasts, AreFreeUpToTheirHits) {
  crowd({0, 0, 0});
  std::vector<PlumbTurningCast> casts;
  for (std::size_t i = 0; i < 400; ++i) casts.push_back(any_cast(i, {0, 0, 0}));
  const std::vector<PlumbHit> hits = ask(PLUMB_HIT_CLOSEST, casts);
  ASSERT_EQ(hits.size(), casts.size());
  int met = 0, passed = 0, entered = 0;
  for (std::size_t i = 0; i < casts.size(); ++i) {
    if (hits[i].body != 0 && hits[i].fraction == 0) continue;
    const double way = size(casts[i].translation) + size(casts[i].rotation), hair = 1e-5 / way;
    const double end = hits[i].body == 0 ? 1 : hits[i].fraction - hair;
    for (int k = 0; k < 40; ++k) {
      const double at = end * k / 40.0 * (1 - 1e-9) + (k == 39 ? end / 40 : 0);
      EXPECT_TRUE(overlapped(casts[i].shape, pose_at(casts[i], std::max(0.0, at))).empty())
          << "cast " << i << " of shape " << i % 5 << " at " << at << " of " << end;
    }
    ++(hits[i].body == 0 ? passed : met);
    if (hits[i].body == 0) continue;
    const std::vector<PlumbBody> there = overlapped(casts[i].shape, pose_at(casts[i], hits[i].fraction + 100 * hair));
    if (std::find(there.begin(), there.end(), hits[i].body) != there.end()) ++entered;
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(passed, 20);
  EXPECT_GE(entered, met - met / 50) << "but for those that graze";
}

TEST_F(TurningCasts, TellAllHitsOfWhichTheClosestIsTheFirst) {
  crowd({0, 0, 0});
  std::vector<PlumbTurningCast> casts;
  for (std::size_t i = 0; i < 300; ++i) casts.push_back(any_cast(i, {0, 0, 0}));
  const std::vector<PlumbHit> nearest = ask(PLUMB_HIT_CLOSEST, casts), all = ask(PLUMB_HIT_ALL, casts);
  std::size_t next = 0;
  for (std::size_t i = 0; i < casts.size(); ++i) {
    if (nearest[i].body == 0) {
      EXPECT_TRUE(next == all.size() || all[next].query != i);
      continue;
    }
    ASSERT_LT(next, all.size());
    EXPECT_EQ(all[next].query, i);
    EXPECT_EQ(all[next].body, nearest[i].body);
    EXPECT_EQ(all[next].fraction, nearest[i].fraction);
    for (; next < all.size() && all[next].query == i; ++next) EXPECT_GE(all[next].fraction, nearest[i].fraction);
    EXPECT_EQ(closest(casts[i]).fraction, nearest[i].fraction) << "alone";
  }
  EXPECT_EQ(next, all.size());
}

/// A blade of 10 m swings by a ball: past its side by a micrometre, or into it by one.
TEST_F(TurningCasts, MissByAMicrometre) {
  const double reach = std::sqrt(5.0 * 5.0 + 0.05 * 0.05);  // of the blade's corners, in its plane
  for (const double gap : {1e-6, -1e-6}) {
    begin();
    const PlumbShape blade = scene_->box({5, 0.05, 0.05});
    const PlumbBody body = scene_->add_static(scene_->sphere(0.5), {0, reach + 0.5 + gap, 0});
    const PlumbHit hit = closest({blade, {{0, 0, 0}, {0, 0, 0, 1}}, {0, 0, 0}, {0, 0, kPiD}, kAllSeen});
    EXPECT_EQ(hit.body, gap > 0 ? 0 : body) << gap;
    if (gap > 0) continue;
    // Its leading corner comes to the ball first, a little before it stands upright.
    EXPECT_NEAR(hit.fraction * kPiD, kPiD / 2 - std::atan2(0.05, 5), 0.01);
  }
}

/// Flat on a floor and sliding over it while it spins: a gap stays a gap, however small, all the way.
TEST_F(TurningCasts, SpinOverAFloorWithoutTouchingIt) {
  scene_->ground();
  const PlumbShape disc = shapes_[4], board = shapes_[1];
  for (const double gap : {1e-2, 1e-4, 1e-6})
    for (const PlumbShape shape : {disc, board}) {
      const double half = shape == disc ? 0.5 : 0.125;  // which floats hold
      const PlumbTurningCast slide = {shape, {{-9, half + gap, 0}, {0, 0, 0, 1}}, {18, 0, 3}, {0, 6, 0}, kAllSeen};
      EXPECT_EQ(closest(slide).body, 0U) << gap;
      PlumbTurningCast down = slide;
      down.translation.y = -2 * gap;
      EXPECT_NEAR(closest(down).fraction, 0.5, 1e-4) << gap;
    }
}

TEST_F(TurningCasts, AreTheSameFarAway) {
  constexpr PlumbVec3 kFar = {3e4, -2e4, 1e4};
  crowd({0, 0, 0});
  std::vector<PlumbTurningCast> casts;
  for (std::size_t i = 0; i < 200; ++i) casts.push_back(any_cast(i, {0, 0, 0}));
  const std::vector<PlumbHit> near = ask(PLUMB_HIT_CLOSEST, casts);
  random_ = Random(5);
  begin();
  crowd(kFar);
  for (PlumbTurningCast& cast : casts) cast.pose.position = sum(cast.pose.position, 1, kFar);
  for (std::size_t i = 0; i < casts.size(); ++i) casts[i].shape = shapes_[i % 5];
  const std::vector<PlumbHit> far = ask(PLUMB_HIT_CLOSEST, casts);
  int same = 0;
  for (std::size_t i = 0; i < casts.size(); ++i)
    if (near[i].body == far[i].body && (near[i].body == 0 || std::abs(near[i].fraction - far[i].fraction) < 1e-6))
      ++same;
  EXPECT_GE(same, 198) << "but for those that graze";
}

}  // namespace
}  // namespace plumb::impulse::test
