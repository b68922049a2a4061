// The whole step: the same bits however it is run, losses told and mended, and nobody harmed by a neighbour.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "math/real.hpp"
#include "tests/rigs/engine.hpp"
#include "tests/rigs/host_modes.hpp"
#include "tests/rigs/job_host.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kStepNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;

void fill(Scene& scene, int bodies) {
  scene.container(4, 40);
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5}), ball = scene.sphere(0.5);
  for (int i = 0; i < bodies; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    scene.add(i % 3 == 0 ? ball : cube, {1.3 * (i % 5) - 2.6, 1 + 1.5 * (i / 25), 1.3 * (i / 5 % 5) - 2.6},
              random.turn());
  }
}

std::uint64_t pile_hash(std::uint32_t threads, const PlumbHost* host = nullptr) {
  Scene scene(engine(host), kStepNeeds, kDown, threads);
  fill(scene, 300);
  scene.run(90);
  return scene.hash();
}

TEST(Step, HasTheSameBitsHoweverManyThreads) {
  const std::uint64_t alone = pile_hash(1);
  EXPECT_EQ(pile_hash(1), alone) << "from run to run";
  EXPECT_EQ(pile_hash(2), alone) << "two threads";
  EXPECT_EQ(pile_hash(5), alone) << "five threads";
  JobHost jobs(5);
  EXPECT_EQ(pile_hash(5, &jobs.host), alone) << "the host's jobs";
  EXPECT_GT(jobs.runs, 0U);
}

TEST(Step, HasTheSameBitsUnderAnyRoundingOfTheHost) {
  Scene scene(engine(), kStepNeeds, kDown, 1);
  fill(scene, 300);
  const std::uint64_t before = simd::control_word();
  simd::set_control_word(before | modes::kFlush | modes::kDown);
  scene.run(90);
  const std::uint64_t after = simd::control_word();
  simd::set_control_word(before);
  EXPECT_EQ(after & modes::kModeBits, modes::kFlush | modes::kDown) << "the caller's word was not put back";
  EXPECT_EQ(scene.hash(), pile_hash(1));
}

PlumbStepReport step(Scene& scene, double dt = 1.0 / 60) {
  PlumbStepReport report{};
  check(scene.world(), scene.world().step(dt));
  check(scene.world(), scene.world().wait(report));
  return report;
}
bool all_finite(Scene& scene) {
  for (const PlumbPose& pose : scene.poses())
    for (const double x : {pose.position.x, pose.position.y, pose.position.z, pose.orientation.w})
      if (!std::isfinite(x)) return false;
  for (const PlumbBody body : scene.world().bodies())
    for (const double x : scene.velocity(body))
      if (!std::isfinite(x)) return false;
  return true;
}

/// What stops a velocity, if anything: the engine's numbers do not hold it, or what comes of it in the step.
enum class Stopped { kNot, kAtTheWrite, kInTheStep };

/// A body goes wild below another one; afterwards that one and one far away still fall as they should.
void harms_nobody(const std::vector<double>& velocity_row, Stopped stopped) {
  Scene scene(engine(), kStepNeeds, kDown, 1);
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  const PlumbBody wild = scene.add(cube, {0, 0.5, 0});
  const PlumbBody on_top = scene.add(cube, {0, 1.5, 0});
  const PlumbBody far = scene.add(cube, {20, 3, 0});
  step(scene);
  scene.write(PLUMB_FIELD_VELOCITY, wild, velocity_row);
  std::uint32_t nonfinite = 0;
  if (stopped == Stopped::kAtTheWrite) {
    EXPECT_EQ(scene.velocity(wild), std::vector<double>(6, 0)) << "before it has reached a step";
    nonfinite = step(scene).nonfinite;
    EXPECT_EQ(nonfinite, 1U) << "the body itself and nobody else, once";
    EXPECT_NEAR(scene.velocity(on_top)[1], 0, 0.01) << "who lies on it";
  }
  for (int i = 0; i < 60; ++i) {
    nonfinite += step(scene).nonfinite;
    ASSERT_TRUE(all_finite(scene)) << "step " << i;
  }
  EXPECT_EQ(nonfinite > 0, stopped != Stopped::kNot);
  EXPECT_EQ(step(scene).nonfinite, 0U) << "still at it after a second";
  EXPECT_NEAR(scene.poses()[3].position.y, 0.5, 0.01) << "the far one did not fall to the ground";
  scene.write(PLUMB_FIELD_POSE, on_top, {0, 5, 10, 0, 0, 0, 1});
  scene.write(PLUMB_FIELD_VELOCITY, on_top, {0, 0, 0, 0, 0, 0});
  for (int i = 0; i < 6; ++i) step(scene);
  EXPECT_NEAR(scene.velocity(on_top)[1], -0.981, 1e-3) << "the neighbour no longer falls";
  EXPECT_NEAR(scene.velocity(far)[1], 0, 1e-3);
}

std::vector<PlumbPose> poses_in_steps_of_two_lengths(bool somebody_comes) {
  Scene scene(engine(), kStepNeeds, kDown, 1);
  fill(scene, 60);
  scene.run(60);
  PlumbBody comer = 0;
  if (somebody_comes) comer = scene.add(scene.sphere(0.5), {0, 100, 0});
  for (int i = 0; i < 200; ++i) {
    PlumbStepReport report{};
    check(scene.world(), scene.world().step(1.0 / 240));
    check(scene.world(), scene.world().wait(report));
  }
  if (somebody_comes) scene.remove(comer);
  return scene.poses();
}

/// What stands still is bounded once, by the step's length then: not anew where the list of it only grows in room.
TEST(Step, WhoComesFarAwayChangesNoBit) {
  const std::vector<PlumbPose> alone = poses_in_steps_of_two_lengths(false);
  const std::vector<PlumbPose> beside = poses_in_steps_of_two_lengths(true);
  ASSERT_EQ(beside.size(), alone.size());
  EXPECT_EQ(std::memcmp(beside.data(), alone.data(), alone.size() * sizeof(PlumbPose)), 0);
}

TEST(Step, AWildBodyHarmsNobody) {
  harms_nobody({0, -1e10, 0, 0, 0, 0}, Stopped::kNot);
  harms_nobody({1e10, 1e10, 0, 0, 1e10, 0}, Stopped::kNot);
}

/// Its square is beyond the engine's numbers.
TEST(Step, WhatComesOutNotFiniteIsStoppedAndReported) {
  const double wild = sizeof(Real) == 8 ? 1e200 : 1e30;
  harms_nobody({0, -wild, 0, 0, 0, 0}, Stopped::kInTheStep);
  harms_nobody({wild, wild, 0, 0, wild, 0}, Stopped::kInTheStep);
  harms_nobody({0, 0, 0, wild, wild, 0}, Stopped::kInTheStep);
}

TEST(Step, WhatTheEnginesNumbersCannotHoldIsStoppedAndReported) {
  if (sizeof(Real) == 8) GTEST_SKIP() << "a double holds it";
  harms_nobody({0, -1e300, 0, 0, 0, 0}, Stopped::kAtTheWrite);
  harms_nobody({0, 0, 0, 0, 1e300, 0}, Stopped::kAtTheWrite);
}

TEST(Step, SizesBeyondTheEnginesNumbersAreRefused) {
  Scene scene(engine(), kStepNeeds, kDown, 1);
  EXPECT_THROW(scene.sphere(1e300), Error);
  EXPECT_THROW(scene.box({1, 1e-200, 1}), Error);
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = 1e-320;
  EXPECT_THROW(scene.add(scene.sphere(1), {0, 0, 0}), Error);
  EXPECT_TRUE(scene.world().bodies().empty());
}

TEST(Step, LengthsBeyondTheEnginesNumbersAreRefused) {
  Scene scene(engine(), kStepNeeds, kDown, 1);
  const PlumbBody ball = scene.add(scene.sphere(1), {0, 0, 0});
  scene.write(PLUMB_FIELD_VELOCITY, ball, {1, 0, 0, 0, 0, 0});
  for (const double dt : {5e-324, 1e-170, 1e200, 1e300}) EXPECT_THROW(step(scene, dt), Error) << dt;
  for (const double dt : {1e-15, 1e3}) step(scene, dt);
  EXPECT_EQ(scene.velocity(ball)[0], 1);
}

/// More pairs in the first step than there is room for.
TEST(Step, IsRepeatedWithMoreRoomAndLosesNothing) {
  Scene scene(engine(), kStepNeeds, kDown, 1);
  const PlumbShape ball = scene.sphere(0.5);
  constexpr int kSide = 30;
  for (int i = 0; i < kSide * kSide; ++i) scene.add(ball, {1.0 * (i % kSide), 0, 1.0 * (i / kSide)});
  const PlumbStepReport report = step(scene);
  EXPECT_NE(report.remarks & PLUMB_REMARK_STEP_REPEATED, 0U);
  EXPECT_NE(report.remarks & PLUMB_REMARK_CAPACITY_GREW, 0U);
  EXPECT_EQ(report.dropped, 0U);
  EXPECT_GE(report.contacts, 2U * kSide * (kSide - 1)) << "neighbours that touch";
  for (const PlumbBody body : scene.world().bodies())
    ASSERT_NEAR(scene.velocity(body)[1], -9.81 / 60, 1e-5) << "one step of fall, not two";
  EXPECT_EQ(step(scene).remarks & PLUMB_REMARK_STEP_REPEATED, 0U);
}

/// A body with hundreds of neighbours: more contacts than there are colours.
TEST(Step, ABodyWithHundredsOfContactsIsSolved) {
  Scene scene(engine(), kStepNeeds, kDown, 1);
  scene.ground();
  scene.body.density = 1000;
  const PlumbBody plate = scene.add(scene.box({5, 0.5, 5}), {0, 0.5, 0});
  const PlumbShape cube = scene.box({0.1, 0.1, 0.1});
  constexpr int kSide = 18;
  for (int i = 0; i < kSide * kSide; ++i) scene.add(cube, {0.5 * (i % kSide) - 4.25, 1.1, 0.5 * (i / kSide) - 4.25});
  PlumbStepReport report{};
  for (int i = 0; i < 120; ++i) report = step(scene);
  EXPECT_EQ(report.dropped, 0U);
  EXPECT_GE(report.contacts, 4U * kSide * kSide);
  const std::vector<PlumbPose> poses = scene.poses();
  EXPECT_NEAR(poses[1].position.y, 0.5, 2e-3);
  for (std::size_t i = 2; i < poses.size(); ++i) ASSERT_NEAR(poses[i].position.y, 1.1, 4e-3) << i;
  EXPECT_NEAR(scene.velocity(plate)[1], 0, 1e-3);
}

}  // namespace
}  // namespace plumb::impulse::test
