#include <cmath>

#include "backend_under_test.hpp"
#include "plumb/helpers/fixed_step.hpp"

namespace plumb::helpers::test {
namespace {

TEST(FixedStep, CountsStepsAndTellsWhereTheFrameLies) {
  TestWorld t({0, 0, 0});
  const PlumbBody ball = t.sphere(0.5, {0, 0, 0}, 1);
  t.set_velocity(ball, {{6, 0, 0}, {0, 1, 0}});
  FixedStep clock(*t.world, std::span(&ball, 1), {0.1, 4});
  FixedFrame frame = clock.advance(0.05);
  EXPECT_EQ(frame.steps, 0);
  EXPECT_NEAR(frame.alpha, 0.5, 1e-12);
  frame = clock.advance(0.2);
  EXPECT_EQ(frame.steps, 2);
  EXPECT_NEAR(frame.alpha, 0.5, 1e-9);
  EXPECT_NEAR(clock.poses()[0].position.x, 6 * 0.15, 1e-5);  // a step behind 0.25 s
  EXPECT_NEAR(2 * std::asin(clock.poses()[0].orientation.y), 0.15, 5e-4);
  EXPECT_NEAR(clock.velocities()[0], 6, 1e-5);
}

TEST(FixedStep, TurnsAtAConstantRateBetweenSteps) {
  const double right = std::acos(-1.0) / 2, half = right / 2;
  const PlumbPose turned{{4, 0, 0}, {0, -std::sin(half), 0, -std::cos(half)}};  // the same turn, of the other sign
  const PlumbPose between = interpolate(identity_pose(), turned, 0.25);
  EXPECT_NEAR(2 * std::asin(between.orientation.y), right / 4, 1e-12);
  EXPECT_NEAR(between.position.x, 1, 1e-12);
}

TEST(FixedStep, FramesOfAStepAreOneStepEach) {
  TestWorld t;
  FixedStep clock(*t.world, {}, {1.0 / 60, 4});
  int steps = 0;
  for (int i = 0; i < 600; ++i) steps += clock.advance(1.0 / 60).steps;
  EXPECT_EQ(steps, 600);
}

TEST(FixedStep, DropsWhatASlowFrameCannotCatchUpWith) {
  TestWorld t;
  FixedStep clock(*t.world, {}, {0.1, 3});
  int called = 0;
  const FixedFrame frame = clock.advance(1.05, [&](double) { ++called; });
  EXPECT_EQ(frame.steps, 3);
  EXPECT_EQ(called, 3);
  EXPECT_NEAR(frame.dropped, 0.7, 1e-9);
  EXPECT_NEAR(frame.alpha, 0.5, 1e-9);
  EXPECT_EQ(clock.advance(0.02).steps, 0);
}

TEST(FixedStep, RefusesATimeThatIsNone) {
  TestWorld t;
  EXPECT_THROW(FixedStep(*t.world, {}, {0, 4}), Error);
  FixedStep clock(*t.world, {});
  EXPECT_THROW(clock.advance(-1), Error);
}

}  // namespace
}  // namespace plumb::helpers::test
