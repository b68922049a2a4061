// Sub-steps are a length in time: in steps of whatever length a host asks, what happens is the same.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_JOINTS | PLUMB_NEED_GYROSCOPIC;
const PlumbVec3 kDown{0, -9.81, 0};

void step(Scene& scene, double dt) {
  check(scene.world(), scene.world().step(dt));
  PlumbStepReport report{};
  check(scene.world(), scene.world().wait(report));
}
void advance(Scene& scene, double seconds, double dt) {
  for (long i = 0, count = std::lround(seconds / dt); i < count; ++i) step(scene, dt);
}

/// A chain of five that swings from level, its end after so long.
PlumbVec3 end_of_chain(double seconds, double dt) {
  Scene scene(engine(), kNeeds, kDown, 1);
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = 1;
  const PlumbShape link = scene.box({0.15, 0.05, 0.05});
  PlumbBody last = scene.add(link, {0.2, 0, 0});
  scene.rod({-0.2, 0, 0}, last, 0.4);
  for (int i = 1; i < 5; ++i) {
    const PlumbBody next = scene.add(link, {0.2 + 0.4 * i, 0, 0});
    scene.ball_joint(last, {0.2, 0, 0}, next, {-0.2, 0, 0});
    last = next;
  }
  advance(scene, seconds, dt);
  return scene.poses().back().position;
}

TEST(SubstepLengths, LetAChainSwingAlikeInStepsOfAnyLength) {
  const PlumbVec3 at_60 = end_of_chain(1.5, 1.0 / 60);
  for (const double dt : {1.0 / 30, 1.0 / 120, 1.0 / 240, 1.0 / 480}) {
    const PlumbVec3 end = end_of_chain(1.5, dt);
    EXPECT_NEAR(end.x, at_60.x, 2e-4) << dt;
    EXPECT_NEAR(end.y, at_60.y, 2e-4) << dt;
  }
}

/// Of a cube of 1 m on the ground, m. A contact is a spring that is as stiff as sub-steps are short.
double sink(double dt) {
  Scene scene(engine(), kNeeds, kDown, 1);
  scene.ground();
  scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  advance(scene, 4, dt);
  return 0.5 - scene.poses().back().position.y;
}

TEST(SubstepLengths, LetACubeSinkAlikeInStepsOfAnyLength) {
  const double at_60 = sink(1.0 / 60);
  for (const double dt : {1.0 / 30, 1.0 / 120, 1.0 / 240, 1.0 / 480}) EXPECT_NEAR(sink(dt), at_60, 0.02 * at_60) << dt;
}

/// A clock that is late by a little asks for no more of them; one sub-step is the least, however short the step.
TEST(SubstepLengths, AreAsLongAsASettingSaysOrALittleLonger) {
  EXPECT_NEAR(sink(1001.0 / 60000), sink(1.0 / 60), 0.01 * sink(1.0 / 60));
  EXPECT_LT(sink(1.0 / 1000), 0.3 * sink(1.0 / 60));
  const double at_144 = sink(1.0 / 144);
  EXPECT_LT(at_144, sink(1.0 / 60));
  EXPECT_GT(at_144, 0.6 * sink(1.0 / 60));
}

/// A host whose clock is never the same: a tower rests all the same.
TEST(SubstepLengths, LetATowerRestUnderAClockThatJumps) {
  Scene scene(engine(), kNeeds, kDown, 1);
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int i = 0; i < 10; ++i) scene.add(cube, {0, 0.5 + i, 0});
  const PlumbBody top = scene.add(cube, {0, 10.5, 0});
  constexpr std::array kClock = {1.0 / 60, 1.0 / 45, 1.0 / 144, 1.0 / 30, 1.0 / 59, 1.0 / 240, 1.0 / 61};
  for (int i = 0; i < 1400; ++i) step(scene, kClock[(i * 5 + i / 7) % kClock.size()]);
  const std::vector<double> v = scene.velocity(top);
  EXPECT_LT(std::hypot(v[0], v[1], v[2]), 0.02);
  EXPECT_NEAR(scene.poses().back().position.y, 10.5, 0.02);
}

}  // namespace
}  // namespace plumb::impulse::test
