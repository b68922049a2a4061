// Continuous collision: when two moving shapes meet, and that nothing passes through what it is flagged against.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "continuous/impacts.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kContinuousNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                        PLUMB_NEED_CCD | PLUMB_NEED_RESTITUTION | PLUMB_NEED_KINEMATIC;

Shape box_of(Real x, Real y, Real z) {
  Shape shape{};
  shape.type = ShapeType::kBox;
  shape.size = {x, y, z};
  shape.reach = length(shape.size);
  return shape;
}
Shape ball_of(Real radius) {
  Shape shape{};
  shape.type = ShapeType::kSphere;
  shape.size = {radius, 0, 0};
  shape.reach = radius;
  return shape;
}
MovingShape moving(const Shape& shape, const Vec& linear, const Vec& angular, const Quat& q = {0, 0, 0, 1}) {
  return {&shape, {{0, 0, 0}, {0, 0, 0, 1}}, {q, linear, angular}};
}

/// A ball against a wall: the time is the gap over the speed.
TEST(Continuous, TimeOfImpactOfABallIsItsGapOverItsSpeed) {
  const Shape wall = box_of(Real(0.05), 5, 5), ball = ball_of(Real(0.1));
  for (const double speed : {5.0, 100.0, 1000.0}) {
    const double gap = speed * 0.011;
    Impact impact;
    const Vec apart = {static_cast<Real>(-gap - 0.15), Real(0.3), 0};
    ASSERT_EQ(Course::kImpact,
              find_impact(moving(wall, {0, 0, 0}, {0, 0, 0}), moving(ball, {static_cast<Real>(speed), 0, 0}, {0, 0, 0}),
                          apart, Real(1.0 / 60), Real(1e-4), {}, impact));
    EXPECT_NEAR(impact.time, 0.011, 1.1e-4 / speed + 1e-6);
    EXPECT_EQ(Course::kMiss, find_impact(moving(wall, {0, 0, 0}, {0, 0, 0}),
                                         moving(ball, {static_cast<Real>(-speed), 0, 0}, {0, 0, 0}), apart,
                                         Real(1.0 / 60), Real(1e-4), {}, impact))
        << "away from it";
    EXPECT_EQ(Course::kMiss,
              find_impact(moving(wall, {0, 0, 0}, {0, 0, 0}), moving(ball, {static_cast<Real>(speed), 0, 0}, {0, 0, 0}),
                          apart, Real(0.0109), Real(1e-4), {}, impact))
        << "not within the time";
  }
}

/// Boxes that fly and turn, against a walk in small steps: no contact before the impact, and contact soon after.
TEST(Continuous, TimeOfImpactOfTurningBoxes) {
  const Shape a = box_of(Real(0.5), Real(0.1), Real(0.3)), b = box_of(Real(0.05), 1, Real(0.05));
  int hits = 0;
  for (std::uint64_t seed = 0; seed < 1500; ++seed) {
    Random random(seed);
    const auto any = [&](double most) {
      return Vec{static_cast<Real>(random.between(-most, most)), static_cast<Real>(random.between(-most, most)),
                 static_cast<Real>(random.between(-most, most))};
    };
    const PlumbQuat p = random.turn(), q = random.turn();
    const auto quat = [](const PlumbQuat& r) {
      return Quat{static_cast<Real>(r.x), static_cast<Real>(r.y), static_cast<Real>(r.z), static_cast<Real>(r.w)};
    };
    const MovingShape first = moving(a, any(20), any(30), quat(p)), second = moving(b, any(20), any(60), quat(q));
    const Vec apart = any(Real(1.5));
    const auto gap_at = [&](Real t) {
      const ShapePose pose_a = first.pose(t), pose_b = second.pose(t);
      PlacedPair<double> pair;
      pair.a = a;
      pair.b = b;
      const Quat4<double> qa = to_numbers<double>(pose_a.orientation), qb = to_numbers<double>(pose_b.orientation);
      pair.turn = to_matrix(conjugate(qa) * qb);
      pair.shift = rotate(conjugate(qa), to_numbers<double>(apart + t * (second.way.linear - first.way.linear)));
      pair.hulls = {};
      const ShapeGap<double> gap = shape_gap(pair);
      return gap.cores_overlap ? 0 : gap.distance;
    };
    constexpr double kClose = 2e-3, kEnd = 1.0 / 60;
    if (gap_at(0) <= kClose) continue;
    double touches = -1;
    for (int i = 1; i <= 2000 && touches < 0; ++i)
      if (gap_at(static_cast<Real>(kEnd * i / 2000)) <= 0) touches = kEnd * i / 2000;
    Impact impact;
    const bool found = find_impact(first, second, apart, Real(kEnd), Real(kClose), {}, impact) == Course::kImpact;
    if (touches >= 0) {
      ++hits;
      ASSERT_TRUE(found) << "seed " << seed;
      EXPECT_LE(impact.time, touches + kEnd / 1000) << "seed " << seed;
    }
    if (found) {
      EXPECT_LE(gap_at(impact.time), kClose * 1.05) << "seed " << seed;
      for (int i = 0; i < 100; ++i) EXPECT_GT(gap_at(impact.time * static_cast<Real>(i) / 100), 0) << "seed " << seed;
    }
  }
  EXPECT_GT(hits, 30);
}

/// Where the bullet is when it has flown 8 m, with a wall of 0.1 m at 5 m.
double end_of_bullet(double speed, std::uint32_t flags, double offset) {
  Scene scene(engine(), kContinuousNeeds, {0, 0, 0}, 1);
  scene.add_static(scene.box({0.05, 5, 5}), {5, 0, 0});
  scene.body.flags = flags;
  scene.body.linear_velocity = {speed, 0, 0};
  scene.add(scene.sphere(0.1), {offset, 0, 0});
  scene.run(static_cast<int>(8 / speed * 60) + 4);
  return scene.poses()[1].position.x;
}
TEST(Continuous, NoBulletPasses) {
  for (const double speed : {20.0, 100.0, 300.0, 1000.0, 5000.0})
    for (const double offset : {0.0, 0.013, 1.7}) {
      EXPECT_LT(end_of_bullet(speed, PLUMB_BODY_CCD, offset), 4.86) << speed << " m/s from " << offset;
      EXPECT_GT(end_of_bullet(speed, PLUMB_BODY_CCD, offset), 4.8) << "and it comes up to the wall";
    }
  EXPECT_GT(end_of_bullet(1000, 0, 0), 6) << "it would have, without the flag";
}

/// What a bullet hits takes its momentum; a perfect bounce gives its speed to a ball of the same mass.
TEST(Continuous, ABulletGivesItsMomentum) {
  for (const double e : {0.0, 1.0}) {
    Scene scene(engine(), kContinuousNeeds, {0, 0, 0}, 1);
    scene.body.material.restitution = e;
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = 2;
    const PlumbShape ball = scene.sphere(0.1);
    const PlumbBody target = scene.add(ball, {5, 0, 0});
    scene.body.flags = PLUMB_BODY_CCD;
    scene.body.linear_velocity = {600, 0, 0};
    const PlumbBody bullet = scene.add(ball, {0, 0, 0});
    scene.run(3);
    EXPECT_NEAR(scene.velocity(target)[0], e == 0 ? 300 : 600, 0.1);
    EXPECT_NEAR(scene.velocity(bullet)[0], e == 0 ? 300 : 0, 0.1);
  }
}

/// Two-metre rod, 48 degrees a step, beside a wall that only its turning end reaches.
TEST(Continuous, ATurningRodSeesTheWall) {
  Scene scene(engine(), kContinuousNeeds, {0, 0, 0}, 1);
  scene.add_static(scene.box({0.02, 5, 5}), {0.8, 0, 0});
  scene.body.flags = PLUMB_BODY_CCD;
  scene.body.angular_velocity = {0, 0, 50};
  scene.add(scene.box({0.025, 1, 0.025}), {0, 0, 0});
  double deepest = 0;
  for (int step = 0; step < 120; ++step) {
    scene.run(1);
    const PlumbPose pose = scene.poses()[1];
    const double s = 2 * (pose.orientation.x * pose.orientation.y - pose.orientation.w * pose.orientation.z);
    // The ends along x: +-s of the rod's y axis, and half its width.
    const double end = pose.position.x + std::abs(s) + 0.025 * std::sqrt(std::max(0.0, 1 - s * s));
    deepest = std::max(deepest, end - 0.78);
  }
  EXPECT_LT(deepest, 0.01);
}

TEST(Continuous, ABulletAndAPaddleMeet) {
  Scene scene(engine(), kContinuousNeeds, {0, 0, 0}, 1);
  const PlumbBody paddle = scene.add_kinematic(scene.box({0.05, 1, 1}), {5, 0, 0});
  scene.write(PLUMB_FIELD_VELOCITY, paddle, {-30, 0, 0, 0, 0, 0});
  scene.body.flags = PLUMB_BODY_CCD;
  scene.body.linear_velocity = {200, 0, 0};
  const PlumbBody bullet = scene.add(scene.sphere(0.1), {0, 0, 0});
  scene.run(4);
  EXPECT_LT(scene.poses()[1].position.x, scene.poses()[0].position.x);
  EXPECT_NEAR(scene.velocity(bullet)[0], -30, 0.5);
}

/// Bodies without the flag go as where nobody asks for continuous collision, bit for bit.
TEST(Continuous, CostsOthersNothing) {
  std::uint64_t hashes[2];
  for (const bool asked : {false, true}) {
    Scene scene(engine(), asked ? kContinuousNeeds : kContinuousNeeds & ~PLUMB_NEED_CCD, {0, -9.81, 0}, 1);
    scene.container(3, 20);
    const PlumbShape cube = scene.box({0.4, 0.4, 0.4});
    for (int i = 0; i < 60; ++i)
      scene.add(cube, {1.1 * (i % 4) - 1.6 + 0.01 * i, 1 + 1.2 * (i / 16), 1.1 * (i / 4 % 4) - 1.6});
    scene.run(80);
    hashes[asked ? 1 : 0] = scene.hash();
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace plumb::impulse::test
