// Limits and motors that hold: contacts count on them where they have held before, and the step is taken back where
// they let go nonetheless.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "tests/rigs/drawers.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kRowNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_JOINTS |
                                 PLUMB_NEED_KINEMATIC | PLUMB_NEED_SNAPSHOT;

/// Whether the step was taken back.
bool step(Scene& scene, double dt = 1.0 / 60) {
  PlumbStepReport report{};
  check(scene.world(), scene.world().step(dt));
  check(scene.world(), scene.world().wait(report));
  EXPECT_EQ(report.nonfinite, 0U);
  EXPECT_EQ(report.remarks & PLUMB_REMARK_ENERGY_BOUNDED, 0U);
  return (report.remarks & PLUMB_REMARK_STEP_REPEATED) != 0;
}

/// A platform of 10 kg on an upright slider, and on it a box, both x to the side.
struct Lift {
  Lift(Scene& in, double x, double load, double height, double speed, double max_force) : scene(in) {
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = 10;
    platform = scene.add(scene.box({1, 0.1, 1}), {x, -0.1, 0});
    scene.body.mass = load;
    box = scene.add(scene.box({0.5, 0.5, 0.5}), {x, 0.5 + height, 0});
    PlumbJointDesc desc = slider(kUp, platform);
    desc.frame_a.position = {x, -0.1, 0};
    desc.motors[0] = {speed, max_force, 1, 0};
    slide = scene.join(desc);
  }
  double speed(PlumbBody body) { return scene.velocity(body)[1]; }
  /// Of the step at the contacts of the box, N s.
  std::vector<double> impulses() {
    std::vector<double> found;
    for (const PlumbContact& contact : scene.world().contacts())
      if (contact.body_a == box || contact.body_b == box) found.push_back(contact.normal_impulse);
    return found;
  }
  std::array<double, 6> reaction() {
    std::array<double, 6> six{};
    check(scene.world(),
          scene.world().joints()->read_joints(PLUMB_JOINT_REACTION, {&slide, 1}, rows_over(std::span(&six, 1))));
    return six;
  }

  Scene& scene;
  PlumbBody platform, box;
  PlumbJoint slide;
};

TEST(PredictedRows, AMotorKeepsItsSpeedUnderAThousandTimesItsPlatform) {
  for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240})
    for (const double speed : {0.0, 0.5}) {
      Scene scene(engine(), kRowNeeds, kDown, 1);
      Lift lift(scene, 0, 10000, 0, speed, 4e5);
      for (int i = 0; i < 2 / dt; ++i) {
        step(scene, dt);
        if (i * dt > (speed == 0 ? 0.05 : 1)) {
          EXPECT_NEAR(lift.speed(lift.platform), speed, 2e-3) << "dt " << dt << ", step " << i;
        }
      }
      EXPECT_NEAR(lift.speed(lift.box), speed, 1e-3) << dt;
    }
}

/// What a motor cannot hold it lets down, no faster than that falls.
TEST(PredictedRows, AMotorThatIsOvercomeGivesNoEnergy) {
  Scene scene(engine(), kRowNeeds, kDown, 1);
  Lift lift(scene, 0, 1000, 1, 0, 300);
  int repeated = 0;
  for (int i = 0; i < 120; ++i) {
    repeated += step(scene) ? 1 : 0;
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
  Scene scene(engine(), kRowNeeds, {-2, 0, 0}, 1);
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

/// A drawer of 5 kg that runs against its stop; what lies in it slides on until friction holds it.
TEST(PredictedRows, ADrawerStaysAtItsStopWhenItsLoadComesToRest) {
  constexpr double kSpeed = 0.8, kFriction = 0.5, kStop = 0.4;
  for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240})
    for (const double load : {0.5, 50.0, 500.0, 5000.0}) {
      Scene scene(engine(), kRowNeeds, kDown, 1);
      scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
      scene.body.material.friction = kFriction;
      scene.body.mass = 5;
      const PlumbBody drawer = scene.add(scene.box({0.5, 0.02, 0.3}), {kStop - 0.01, 0, 0});
      PlumbJointDesc desc = slider({0, 0, 0, 1}, drawer);
      desc.limits[0] = {0, kStop, 1, 0};
      make(scene, desc);
      scene.body.mass = load;
      const PlumbBody box = scene.add(scene.box({0.08, 0.05, 0.08}), {kStop - 0.01, 0.07, 0});
      for (const PlumbBody body : {drawer, box}) scene.write(PLUMB_FIELD_VELOCITY, body, {kSpeed, 0, 0, 0, 0, 0});
      for (int i = 0; i < 1 / dt; ++i) step(scene, dt);
      EXPECT_NEAR(scene.poses()[1].position.x, kStop + kSpeed * kSpeed / (2 * kFriction * 9.81), 2e-3)
          << load << ", " << dt;
      for (int i = 0; i < 4 / dt; ++i) step(scene, dt);
      EXPECT_NEAR(scene.poses()[0].position.x, kStop, 1e-3) << load << ", " << dt;
      EXPECT_NEAR(scene.velocity(drawer)[0], 0, 1e-4) << load << ", " << dt;
      EXPECT_NEAR(scene.velocity(box)[0], 0, 1e-4) << load << ", " << dt;
    }
}

/// A block that rests at the lower end of its way up, x to the side, and a ram that comes from so far below.
void block_and_ram(Scene& scene, double x, double below) {
  const PlumbShape cube = scene.box({0.2, 0.2, 0.2});
  scene.body.mass = 1;
  PlumbJointDesc desc = slider(kUp, scene.add(cube, {x, 0, 0}));
  desc.frame_a.position = {x, 0, 0};
  desc.limits[0] = {0, 10, 1, 0};
  make(scene, desc);
  scene.body.mass = 100;
  scene.write(PLUMB_FIELD_VELOCITY, scene.add(cube, {x, -0.4 - below, 0}), {0, 12, 0, 0, 0, 0});
}

/// What holds is counted on in a step that others' rows make the world go over again.
TEST(PredictedRows, AnIslandDoesNotDependOnWhereOthersLetGo) {
  constexpr PlumbNeeds kTold =
      kRowNeeds | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES | PLUMB_NEED_JOINT_REACTIONS;
  Scene alone(engine(), kTold, kDown, 1), among(engine(), kTold, kDown, 1);
  Lift one(alone, 20, 10000, 0, 0.5, 4e7), two(among, 20, 10000, 0, 0.5, 4e7);
  for (int i = 0; i < 30; ++i) block_and_ram(among, -i, 1 + 0.17 * i);
  int repeated = 0;  // for others
  for (int i = 0; i < 120; ++i) {
    const bool own = step(alone), any = step(among);
    if (any && !own) ++repeated;
    ASSERT_EQ(alone.velocity(one.platform), among.velocity(two.platform)) << i;
    ASSERT_EQ(alone.velocity(one.box), among.velocity(two.box)) << i;
    ASSERT_EQ(one.impulses(), two.impulses()) << i;
    ASSERT_EQ(one.reaction(), two.reaction()) << i;
  }
  EXPECT_GT(repeated, 20);
}

/// What a snapshot goes on with is what the world itself would have: for how long rows have held is part of it.
TEST(PredictedRows, ASnapshotKnowsWhatHasHeld) {
  Scene one(engine(), kRowNeeds, kDown, 1), two(engine(), kRowNeeds, kDown, 1);
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
  Scene one(engine(), kRowNeeds, kDown, 1), three(engine(), kRowNeeds, kDown, 3);
  drawers(one);
  drawers(three);
  one.run(240);
  three.run(240);
  EXPECT_EQ(one.hash(), three.hash());
}

}  // namespace
}  // namespace plumb::impulse::test
