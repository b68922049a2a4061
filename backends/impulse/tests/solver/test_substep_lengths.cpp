// Sub-steps have a largest length in time: in longer steps there are more of them, and what happens is the same.
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

TEST(SubstepLengths, LetAChainSwingAlikeInLongerSteps) {
  const PlumbVec3 at_60 = end_of_chain(1.5, 1.0 / 60);
  for (const double dt : {1.0 / 40, 1.0 / 30, 1.0 / 20}) {
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

TEST(SubstepLengths, LetACubeSinkAlikeInLongerSteps) {
  const double at_60 = sink(1.0 / 60);
  for (const double dt : {1.0 / 30, 1.0 / 20, 1.0 / 10}) EXPECT_NEAR(sink(dt), at_60, 0.02 * at_60) << dt;
}

/// A clock that is late by a little asks for no more of them; a shorter step has as many as the setting says.
TEST(SubstepLengths, AreNoLongerThanASettingSays) {
  EXPECT_NEAR(sink(1001.0 / 60000), sink(1.0 / 60), 0.01 * sink(1.0 / 60));
  EXPECT_LT(sink(1.0 / 50), 1.05 * sink(1.0 / 60));
  EXPECT_LT(sink(1.0 / 120), 0.3 * sink(1.0 / 60));
}

/// A host that misses one frame or two again and again: a tower rests all the same.
TEST(SubstepLengths, LetATowerRestWhereFramesAreMissed) {
  Scene scene(engine(), kNeeds, kDown, 1);
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int i = 0; i < 10; ++i) scene.add(cube, {0, 0.5 + i, 0});
  const PlumbBody top = scene.add(cube, {0, 10.5, 0});
  constexpr std::array kClock = {1.0 / 60, 1.0 / 45, 1.0 / 30, 1.0 / 59, 1.0 / 20, 1.0 / 61};
  for (std::size_t i = 0; i < 1200; ++i) step(scene, kClock[(i * 5 + i / 7) % kClock.size()]);
  const std::vector<double> v = scene.velocity(top);
  EXPECT_LT(std::hypot(v[0], v[1], v[2]), 0.02);
  EXPECT_NEAR(scene.poses().back().position.y, 10.5, 0.02);
}

}  // namespace
}  // namespace plumb::impulse::test
