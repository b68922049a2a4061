// Rolling and spinning friction, against closed forms.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kRollingNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_ROLLING_FRICTION;
constexpr double kGravity = 9.81, kRadius = 0.5, kRolling = 0.05, kBall = 2.0 / 5;
constexpr const char* kSolvers[] = {"tgs_soft", "si", "jacobi", "xpbd"};

PlumbVec3 place(Scene& scene, PlumbBody body) {
  double row[7];
  check(scene.world(), scene.world().read(PLUMB_FIELD_POSE, {&body, 1},
                                          Rows(reinterpret_cast<std::byte*>(row), 1, sizeof row, PLUMB_F64)));
  return {row[0], row[1], row[2]};
}
double length(const PlumbVec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }
double speed(Scene& scene, PlumbBody body) {
  const std::vector<double> v = scene.velocity(body);
  return length({v[0], v[1], v[2]});
}
PlumbQuat turn_about(const PlumbVec3& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {s * axis.x, s * axis.y, s * axis.z, std::cos(angle / 2)};
}
/// The next bodies have these.
void resist(Scene& scene, double rolling, double spinning) {
  scene.body.rolling_friction = rolling;
  scene.body.spinning_friction = spinning;
}
/// A ball on level ground that rolls without slip.
PlumbBody add_rolling_ball(Scene& scene, const PlumbVec3& velocity, double z = 0) {
  scene.body.linear_velocity = velocity;
  scene.body.angular_velocity = {velocity.z / kRadius, 0, -velocity.x / kRadius};
  const PlumbBody ball = scene.add(scene.sphere(kRadius), {0, kRadius, z});
  scene.body.linear_velocity = scene.body.angular_velocity = {0, 0, 0};
  return ball;
}

/// a = rho g / (r (1 + k)), whichever of the two has it, whatever the heading.
TEST(RollingFriction, StopsABallAfterItsWay) {
  const double slowed = kRolling * kGravity / (kRadius * (1 + kBall));
  for (const char* const solver : kSolvers)
    for (const bool ground_has_it : {false, true})
      for (const double heading : {0.0, 0.7}) {
        SCOPED_TRACE(solver);
        SCOPED_TRACE(heading);
        Scene scene(engine(), kRollingNeeds, kDown, 1, {"solver", solver});
        resist(scene, ground_has_it ? kRolling : 0.01, 0);
        scene.ground();
        resist(scene, ground_has_it ? 0.02 : kRolling, 0);
        const double v = 2;
        const PlumbBody ball = add_rolling_ball(scene, {v * std::cos(heading), 0, v * std::sin(heading)});
        scene.run(60);
        EXPECT_NEAR(speed(scene, ball), v - slowed, 0.01);
        scene.run(240);
        const PlumbVec3 way = place(scene, ball);
        EXPECT_NEAR(std::hypot(way.x, way.z), v * v / (2 * slowed), 0.02 * v * v / (2 * slowed));
        EXPECT_NEAR(std::atan2(way.z, way.x), heading, 1e-3);
        EXPECT_LT(speed(scene, ball), 1e-3);
        const double stopped = way.x;
        scene.run(600);
        EXPECT_NEAR(place(scene, ball).x, stopped, 1e-4) << "it creeps";
      }
}

TEST(RollingFriction, HoldsUpToItsSlopeAndNotBeyond) {
  for (const char* const solver : kSolvers)
    for (const double share : {0.95, 1.5}) {
      SCOPED_TRACE(solver);
      SCOPED_TRACE(share);
      Scene scene(engine(), kRollingNeeds, kDown, 1, {"solver", solver});
      const double slope = std::atan(share * kRolling / kRadius);
      const PlumbQuat tilt = turn_about({0, 0, 1}, slope);
      scene.add_static(scene.box({100, 1, 100}), {std::sin(slope), -std::cos(slope), 0}, tilt);
      resist(scene, kRolling, 0);
      const PlumbVec3 start = {-kRadius * std::sin(slope), kRadius * std::cos(slope), 0};
      const PlumbBody ball = scene.add(scene.sphere(kRadius), start);
      scene.run(240);
      const double down = kGravity * (std::sin(slope) - kRolling / kRadius * std::cos(slope)) / (1 + kBall);
      const PlumbVec3 at = place(scene, ball);
      const double way = length({at.x - start.x, at.y - start.y, at.z - start.z});
      if (share < 1)
        EXPECT_LT(way, std::string(solver) == "xpbd" ? 0.03 : 2e-3) << "of 5 m without";
      else
        EXPECT_NEAR(way, down * 16 / 2, 0.02 * down * 8);
    }
}

/// dw / dt = sigma m g / (k m r^2); what rolls is none of its business.
TEST(RollingFriction, StopsABallThatSpins) {
  constexpr double kSpinning = 0.02, kSpin = 4;
  const double slowed = kSpinning * kGravity / (kBall * kRadius * kRadius);
  for (const char* const solver : kSolvers) {
    SCOPED_TRACE(solver);
    Scene scene(engine(), kRollingNeeds, kDown, 1, {"solver", solver});
    scene.ground();
    resist(scene, 0, kSpinning);
    scene.body.angular_velocity = {0, kSpin, 0};
    const PlumbBody ball = scene.add(scene.sphere(kRadius), {0, kRadius, 0});
    const PlumbBody rolls = add_rolling_ball(scene, {1, 0, 0}, 5);
    scene.run(60);
    EXPECT_NEAR(scene.velocity(ball)[4], kSpin - slowed, 0.02);
    scene.run(90);
    EXPECT_NEAR(scene.velocity(ball)[4], 0, 1e-3);
    EXPECT_NEAR(scene.velocity(rolls)[0], 1, 1e-3);
  }
}

/// Without friction a ball that turns stops turning, and goes on.
TEST(RollingFriction, NeedsNoFriction) {
  Scene scene(engine(), kRollingNeeds, kDown, 1);
  scene.body.material.friction = 0;
  scene.ground();
  resist(scene, kRolling, 0);
  const PlumbBody ball = add_rolling_ball(scene, {1, 0, 0});
  scene.run(120);
  EXPECT_NEAR(scene.velocity(ball)[0], 1, 1e-4);
  EXPECT_NEAR(scene.velocity(ball)[5], 0, 1e-4);
}

/// A box that slides does not turn: nothing resists.
TEST(RollingFriction, LeavesABoxThatSlidesAlone) {
  const auto way = [](double rolling) {
    Scene scene(engine(), kRollingNeeds, kDown, 1);
    scene.ground();
    resist(scene, rolling, rolling);
    scene.body.linear_velocity = {3, 0, 0};
    const PlumbBody box = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
    scene.run(120);
    return place(scene, box).x;
  };
  EXPECT_NEAR(way(0.05), way(0), 2e-3);
}

/// A heap of balls comes to rest and sleeps, where without it balls roll on.
TEST(RollingFriction, LetsAHeapOfBallsComeToRest) {
  for (const double rolling : {0.0, 0.02}) {
    Scene scene(engine(), kRollingNeeds | PLUMB_NEED_SLEEPING, kDown, 1);
    scene.ground();
    resist(scene, rolling, rolling);
    std::vector<PlumbBody> balls;
    const PlumbShape ball = scene.sphere(0.25);
    for (int i = 0; i < 60; ++i)
      balls.push_back(scene.add(ball, {0.3 * (i % 3) + 0.01 * (i % 7), 0.3 + 0.3 * (i / 9), 0.3 * (i / 3 % 3)}));
    scene.run(1800);
    int awake = 0;
    for (const PlumbBody body : balls) awake += speed(scene, body) > 1e-3 ? 1 : 0;
    if (rolling == 0)
      EXPECT_GT(awake, 30);
    else
      EXPECT_EQ(awake, 0);
  }
}

/// A cube of balls stands where each step begins with the moments that the last one ended with; else it slumps.
TEST(RollingFriction, HoldsAHeapByTheMomentsOfTheLastStep) {
  constexpr int kAcross = 6;
  Scene scene(engine(), kRollingNeeds, kDown, 1);
  scene.ground();
  resist(scene, 0.1, 0.02);
  std::vector<PlumbBody> balls;
  const PlumbShape ball = scene.sphere(0.25);
  for (int j = 0; j < kAcross; ++j)
    for (int i = 0; i < kAcross; ++i)
      for (int k = 0; k < kAcross; ++k)
        balls.push_back(scene.add(ball, {0.501 * i + 0.03 * (j % 3), 0.26 + 0.51 * j, 0.501 * k + 0.02 * (j % 2)}));
  scene.run(1200);
  double height = 0;
  for (const PlumbBody body : balls) height += place(scene, body).y / static_cast<double>(balls.size());
  EXPECT_GT(height, 1.4);
  EXPECT_LT(speed(scene, balls.back()), 1e-3);
}

/// What a host writes counts from the next step on, and is read back.
TEST(RollingFriction, IsWrittenAndRead) {
  Scene scene(engine(), kRollingNeeds, kDown, 1);
  scene.ground();
  const PlumbBody ball = add_rolling_ball(scene, {2, 0, 0});
  scene.run(60);
  EXPECT_NEAR(speed(scene, ball), 2, 1e-3);
  scene.write(PLUMB_FIELD_ROLLING_FRICTION, ball, {kRolling, 0.01});
  double row[2];
  check(scene.world(), scene.world().read(PLUMB_FIELD_ROLLING_FRICTION, {&ball, 1},
                                          Rows(reinterpret_cast<std::byte*>(row), 1, sizeof row, PLUMB_F64)));
  EXPECT_EQ(row[0], kRolling);
  EXPECT_EQ(row[1], 0.01);
  scene.run(60);
  EXPECT_NEAR(speed(scene, ball), 2 - kRolling * kGravity / (kRadius * (1 + kBall)), 0.01);
}

TEST(RollingFriction, BeyondTheEnginesNumbersIsRefused) {
  Scene scene(engine(), kRollingNeeds, kDown, 1);
  resist(scene, 1e300, 0);
  const PlumbShape ball = scene.sphere(kRadius);
  try {
    scene.add(ball, {0, 1, 0});
    FAIL() << "it was taken";
  } catch (const std::exception& error) {
    EXPECT_NE(std::string(error.what()).find("rolling_friction"), std::string::npos) << error.what();
  }
  scene.run(1);
}

/// As large as may be: nothing rolls, and nothing is made of that.
TEST(RollingFriction, MayBeVast) {
  Scene scene(engine(), kRollingNeeds, kDown, 1);
  const double slope = 0.5;
  const PlumbQuat tilt = turn_about({0, 0, 1}, slope);
  scene.body.material.friction = 1;
  scene.add_static(scene.box({100, 1, 100}), {std::sin(slope), -std::cos(slope), 0}, tilt);
  resist(scene, 1e6, 1e6);
  const PlumbBody ball = scene.add(scene.sphere(kRadius), {-kRadius * std::sin(slope), kRadius * std::cos(slope), 0});
  scene.run(600);
  EXPECT_LT(speed(scene, ball), 1e-3);
}

}  // namespace
}  // namespace plumb::impulse::test
