// Limits and motors that hold: contacts count on them where they have held before, and the step is taken back where
// they let go nonetheless.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "tests/rigs/drawers.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_JOINTS |
                              PLUMB_NEED_KINEMATIC | PLUMB_NEED_SNAPSHOT;
constexpr PlumbVec3 kDown = {0, -9.81, 0};

/// Whether the step was taken back.
bool step(Scene& scene, double dt = 1.0 / 60) {
  PlumbStepReport report{};
  check(scene.world(), scene.world().step(dt));
  check(scene.world(), scene.world().wait(report));
  EXPECT_EQ(report.nonfinite, 0U);
  EXPECT_EQ(report.remarks & PLUMB_REMARK_ENERGY_BOUNDED, 0U);
  return (report.remarks & PLUMB_REMARK_STEP_REPEATED) != 0;
}

/// A platform of 10 kg on an upright slider, and on it a box of that mass.
struct Lift {
  Lift(double load, double height, double speed, double max_force) : scene(engine(), kNeeds, kDown, 1) {
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = 10;
    platform = scene.add(scene.box({1, 0.1, 1}), {0, -0.1, 0});
    scene.body.mass = load;
    box = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5 + height, 0});
    PlumbJointDesc desc = slider(kUp, platform);
    desc.frame_a.position = {0, -0.1, 0};
    desc.motors[0] = {speed, max_force, 1, 0};
    make(scene, desc);
  }
  double speed(PlumbBody body) { return scene.velocity(body)[1]; }

  Scene scene;
  PlumbBody platform, box;
};

TEST(PredictedRows, AMotorKeepsItsSpeedUnderAThousandTimesItsPlatform) {
  for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240})
    for (const double speed : {0.0, 0.5}) {
      Lift lift(10000, 0, speed, 4e5);
      for (int i = 0; i < 2 / dt; ++i) {
        step(lift.scene, dt);
        if (i * dt > (speed == 0 ? 0.05 : 1)) {
          EXPECT_NEAR(lift.speed(lift.platform), speed, 2e-3) << "dt " << dt << ", step " << i;
        }
      }
      EXPECT_NEAR(lift.speed(lift.box), speed, 1e-3) << dt;
    }
}

/// What a motor cannot hold it lets down, no faster than that falls.
TEST(PredictedRows, AMotorThatIsOvercomeGivesNoEnergy) {
  Lift lift(1000, 1, 0, 300);
  int repeated = 0;
  for (int i = 0; i < 120; ++i) {
    repeated += step(lift.scene) ? 1 : 0;
    const double falls = 9.81 / 60 * (i + 1) + 0.01;
    EXPECT_GT(lift.speed(lift.platform), -falls) << i;
    EXPECT_LT(lift.speed(lift.platform), 0.05) << i;
  }
  EXPECT_LT(lift.speed(lift.platform), -10);
  EXPECT_GT(repeated, 0);
  EXPECT_LT(repeated, 10);
}

/// A drawer rests at the end of its way, and is struck from there.
TEST(PredictedRows, ALimitThatIsLeftGivesNoEnergy) {
  Scene scene(engine(), kNeeds, {-2, 0, 0}, 1);
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = 1;
  const PlumbBody drawer = scene.add(scene.box({0.2, 0.2, 0.2}), {0, 0, 0});
  PlumbJointDesc desc = slider({0, 0, 0, 1}, drawer);
  desc.limits[0] = {0, 10, 1, 0};
  make(scene, desc);
  scene.body.mass = 100;
  const PlumbBody ram = scene.add(scene.box({0.2, 0.2, 0.2}), {-3.4, 0, 0});
  scene.write(PLUMB_FIELD_VELOCITY, ram, {4, 0, 0, 0, 0, 0});
  int repeated = 0;
  double most = 0;
  for (int i = 0; i < 150; ++i) {
    repeated += step(scene) ? 1 : 0;
    most = std::max(most, scene.velocity(drawer)[0]);
  }
  EXPECT_GT(most, 1);
  EXPECT_LT(most, 4);  // as fast as the ram set out
  EXPECT_GT(repeated, 0);
  EXPECT_LT(repeated, 10);
}

/// What a snapshot goes on with is what the world itself would have: for how long rows have held is part of it.
TEST(PredictedRows, ASnapshotKnowsWhatHasHeld) {
  Scene one(engine(), kNeeds, kDown, 1), two(engine(), kNeeds, kDown, 1);
  drawers(one);
  drawers(two);
  one.run(60);
  std::span<const std::byte> data;
  check(one.world(), one.world().snapshot()->save(data));
  check(two.world(), two.world().snapshot()->restore(data));
  one.run(2);
  two.run(2);
  EXPECT_EQ(one.hash(), two.hash());
}

TEST(PredictedRows, ThreadsDoNotMatter) {
  Scene one(engine(), kNeeds, kDown, 1), three(engine(), kNeeds, kDown, 3);
  drawers(one);
  drawers(three);
  one.run(240);
  three.run(240);
  EXPECT_EQ(one.hash(), three.hash());
}

}  // namespace
}  // namespace plumb::impulse::test
