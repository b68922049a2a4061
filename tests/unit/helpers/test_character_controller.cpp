#include <cmath>

#include "backend_under_test.hpp"
#include "plumb/helpers/character_controller.hpp"

namespace plumb::helpers::test {
namespace {

constexpr double middle = 0.9;  // of the capsule above its foot
const double pi = std::acos(-1.0);

PlumbQuat about_z(double angle) { return {0, 0, std::sin(angle / 2), std::cos(angle / 2)}; }

class Character : public testing::Test {
 protected:
  void SetUp() override {
    if (backend_under_test().capability(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_CAPSULE) == PLUMB_NONE)
      GTEST_SKIP() << "the backend does not cast capsules";
  }
};

/// A ramp whose surface goes through the origin and rises along x.
void add_ramp(TestWorld& t, double angle) {
  const PlumbVec3 normal{-std::sin(angle), std::cos(angle), 0};
  t.box(PLUMB_STATIC, {20, 1, 5}, {-normal.x, -normal.y, 0}, 1, about_z(angle));
}

void walk(TestWorld& t, CharacterController& it, PlumbVec3 speed, double seconds, double dt = 1.0 / 60) {
  for (int i = 0; i < static_cast<int>(std::lround(seconds / dt)); ++i) {
    t.step(dt);
    it.move(speed, dt);
  }
}

TEST_F(Character, ClimbsThirtyDegreesAndSlidesOffSixty) {
  TestWorld gentle;
  add_ramp(gentle, pi / 6);
  CharacterController climber(*gentle.world, {0, middle + 0.2, 0});
  walk(gentle, climber, {0, 0, 0}, 1);
  EXPECT_EQ(climber.ground(), CharacterGround::on_ground);
  const PlumbVec3 start = climber.position();
  walk(gentle, climber, {0, 0, 0}, 1);
  EXPECT_NEAR(climber.position().x, start.x, 1e-3);  // does not creep
  walk(gentle, climber, {2, 0, 0}, 1);
  EXPECT_NEAR(climber.position().x - start.x, 2, 0.05);
  EXPECT_NEAR(climber.position().y - start.y, 2 * std::tan(pi / 6), 0.05);
  TestWorld harsh;
  add_ramp(harsh, pi / 3);
  CharacterController slider(*harsh.world, {0, middle + 0.5, 0});
  walk(harsh, slider, {0, 0, 0}, 0.4);
  const PlumbVec3 from = slider.position(), speed = slider.velocity();
  EXPECT_EQ(slider.ground(), CharacterGround::steep);
  walk(harsh, slider, {2, 0, 0}, 0.5);
  const double slid = speed.x * 0.5 - 9.81 * std::sin(pi / 3) * std::cos(pi / 3) * 0.125;  // without friction
  EXPECT_NEAR(slider.position().x - from.x, slid, 0.05);
}

TEST_F(Character, TakesStepsOfItsHeightAndNoHigher) {
  for (const double height : {0.1, 0.3, 0.6}) {
    TestWorld t;
    t.box(PLUMB_STATIC, {20, 1, 5}, {0, -1, 0});
    t.box(PLUMB_STATIC, {5, height / 2, 5}, {6, height / 2, 0});
    CharacterController it(*t.world, {-0.5, middle, 0});
    walk(t, it, {2, 0, 0}, 2);
    if (height < 0.4) {
      EXPECT_NEAR(it.position().x, 3.5, 0.1) << height;
      EXPECT_NEAR(it.position().y, height + middle, 0.05) << height;
      walk(t, it, {-2, 0, 0}, 2);
      EXPECT_NEAR(it.position().y, middle, 0.05) << height;
      EXPECT_EQ(it.ground(), CharacterGround::on_ground);
    } else {
      EXPECT_NEAR(it.position().x, 0.7, 0.05);
      EXPECT_NEAR(it.position().y, middle, 0.05);
    }
  }
}

TEST_F(Character, SlidesAlongAWallAndStandsStillInACorner) {
  TestWorld t;
  t.box(PLUMB_STATIC, {20, 1, 20}, {0, -1, 0});
  t.box(PLUMB_STATIC, {0.5, 2, 20}, {2, 2, 0});
  t.box(PLUMB_STATIC, {20, 2, 0.5}, {0, 2, 8});
  CharacterController it(*t.world, {1, middle, 0});
  walk(t, it, {3, 0, 3}, 1);
  EXPECT_NEAR(it.position().z, 3, 0.05);
  EXPECT_NEAR(it.position().x, 1.2, 0.05);
  walk(t, it, {3, 0, 3}, 3);
  const PlumbVec3 corner = it.position();
  for (int i = 0; i < 30; ++i) {
    walk(t, it, {3, 0, 3}, 1.0 / 60);
    EXPECT_NEAR(it.position().x, corner.x, 1e-4);
    EXPECT_NEAR(it.position().z, corner.z, 1e-4);
  }
}

TEST_F(Character, IsCarriedByAPlatformThatMovesAndTurns) {
  TestWorld t;
  const PlumbBody platform = t.box(PLUMB_KINEMATIC, {3, 0.5, 3}, {0, -0.5, 0});
  CharacterController it(*t.world, {1, middle, 0});
  const double dt = 1.0 / 60;
  for (int i = 1; i <= 60; ++i) {
    const double angle = i * dt;
    const PlumbPose target{{2 * i * dt, -0.5 + 0.5 * i * dt, 0}, {0, std::sin(angle / 2), 0, std::cos(angle / 2)}};
    check(*t.world, t.world->write(PLUMB_FIELD_KINEMATIC_TARGET, {&platform, 1},
                                   const_rows_over(std::span<const PlumbPose>(&target, 1))));
    t.step(dt);
    it.move({0, 0, 0}, dt);
  }
  EXPECT_NEAR(it.position().x, 2 + std::cos(1.0), 0.03);
  EXPECT_NEAR(it.position().z, -std::sin(1.0), 0.03);
  EXPECT_NEAR(it.position().y, 0.5 + middle, 0.05);
  EXPECT_EQ(it.ground_body(), platform);
}

TEST_F(Character, PushesACrateWithALimitedForce) {
  for (const double mass : {10.0, 500.0}) {
    TestWorld t;
    t.box(PLUMB_STATIC, {20, 1, 20}, {0, -1, 0});
    const PlumbBody crate = t.box(PLUMB_DYNAMIC, {0.5, 0.5, 0.5}, {1.5, 0.5, 0}, mass);
    CharacterController it(*t.world, {0, middle, 0});
    walk(t, it, {2, 0, 0}, 2);
    if (mass < 100)
      EXPECT_GT(t.pose(crate).position.x, 2.5);
    else
      EXPECT_NEAR(t.pose(crate).position.x, 1.5, 0.05);  // 500 N against a friction of 2450 N
  }
}

TEST_F(Character, FallsAtGAlikeAtEveryStep) {
  double ends[2];
  int at = 0;
  for (const double dt : {1.0 / 30, 1.0 / 240}) {
    TestWorld t;
    CharacterController it(*t.world, {0, 100, 0});
    walk(t, it, {1, 0, 0}, 1, dt);
    EXPECT_NEAR(it.position().y, 100 - 9.81 / 2, 1e-6);
    EXPECT_NEAR(it.velocity().y, -9.81, 1e-6);
    EXPECT_EQ(it.ground(), CharacterGround::in_air);
    ends[at++] = it.position().x;
  }
  EXPECT_NEAR(ends[0], ends[1], 0.03);  // it takes 1/20 s to come to speed
}

TEST_F(Character, WalksTheSameTrackAtEveryStep) {
  PlumbVec3 ends[2];
  int at = 0;
  for (const double dt : {1.0 / 30, 1.0 / 240}) {
    TestWorld t;
    t.box(PLUMB_STATIC, {20, 1, 20}, {0, -1, 0});
    t.box(PLUMB_STATIC, {3, 0.1, 3}, {4, 0.1, 0});
    t.box(PLUMB_STATIC, {0.5, 2, 20}, {6, 2, 0});
    CharacterController it(*t.world, {0, middle, 0});
    walk(t, it, {2, 0, 1}, 3, dt);
    ends[at++] = it.position();
  }
  EXPECT_NEAR(ends[0].x, ends[1].x, 0.03);
  EXPECT_NEAR(ends[0].y, ends[1].y, 0.01);
  EXPECT_NEAR(ends[0].z, ends[1].z, 0.03);
}

TEST_F(Character, PassesThroughNothingAtAHundredMetresASecond) {
  for (const double dt : {1.0 / 30, 1.0 / 240}) {
    TestWorld t;
    t.box(PLUMB_STATIC, {50, 1, 50}, {0, -1, 0});
    t.box(PLUMB_STATIC, {0.01, 2, 20}, {10, 2, 0});
    CharacterController it(*t.world, {0, middle, 0});
    it.set_velocity({100, 0, 0});
    walk(t, it, {100, 0, 0}, 1, dt);
    EXPECT_NEAR(it.position().x, 10 - 0.01 - 0.3, 0.05) << dt;
    it.teleport({0, 30, 0});
    it.set_velocity({0, -100, 0});
    walk(t, it, {0, 0, 0}, 1, dt);
    EXPECT_NEAR(it.position().y, middle, 0.05) << dt;
  }
}

TEST_F(Character, JumpsToTheHeightOfItsSpeedAndStopsUnderACeiling) {
  TestWorld t;
  t.box(PLUMB_STATIC, {20, 1, 20}, {0, -1, 0});
  CharacterController it(*t.world, {0, middle, 0});
  double highest = 0;
  it.move({0, 0, 0}, 1.0 / 60, 4);
  for (int i = 0; i < 90; ++i) {
    it.move({0, 0, 0}, 1.0 / 60);
    highest = std::max(highest, it.position().y);
  }
  EXPECT_NEAR(highest - middle, 16 / (2 * 9.81), 0.04);
  EXPECT_EQ(it.ground(), CharacterGround::on_ground);
  t.box(PLUMB_STATIC, {2, 0.1, 2}, {0, 2.1, 0});
  t.step(1e-4);
  it.move({0, 0, 0}, 1.0 / 60, 8);
  for (int i = 0; i < 30; ++i) {
    it.move({0, 0, 0}, 1.0 / 60);
    EXPECT_LT(it.position().y, 2 - middle + 1e-3);
  }
}

TEST(CharacterWithoutCasts, IsRefusedWithASentence) {
  TestWorld t({0, -9.81, 0}, PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION);
  EXPECT_THROW(CharacterController(*t.world, {0, 1, 0}), Error);
  if (backend_under_test().capability(PLUMB_CAP_QUERY, PLUMB_QUERY_CAST, PLUMB_CAPSULE) != PLUMB_NONE) return;
  TestWorld queries;
  EXPECT_THROW(CharacterController(*queries.world, {0, 1, 0}), Error);
}

}  // namespace
}  // namespace plumb::helpers::test
