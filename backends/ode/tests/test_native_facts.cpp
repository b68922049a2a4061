// Facts about ODE that were measured with programs of its own and must come out through plumb.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

PlumbQuat product(const PlumbQuat& a, const PlumbQuat& b) {
  return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
          a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
}

/// How far a unit cube slides in 2 s down 27 degrees at mu = .5, the slope facing `heading` degrees from x. Exact:
/// .1665.
double slide(double heading) {
  const TestWorld world(usual_needs);
  const double tilt = 27 * std::numbers::pi / 180, turn = heading * std::numbers::pi / 180;
  const PlumbQuat orientation =
      product({0, std::sin(turn / 2), 0, std::cos(turn / 2)}, {0, 0, std::sin(tilt / 2), std::cos(tilt / 2)});
  const PlumbVec3 up{-std::sin(tilt) * std::cos(turn), std::cos(tilt), std::sin(tilt) * std::sin(turn)};
  PlumbBodyDesc slope = body_desc(PLUMB_STATIC);
  slope.shape = world.box(50, 1, 50);
  slope.pose = {{-up.x, -up.y, -up.z}, orientation};
  world.body(slope);
  PlumbBodyDesc box = body_desc();
  box.shape = world.box(.5, .5, .5);
  box.pose = {{up.x / 2, up.y / 2, up.z / 2}, orientation};
  const PlumbBody body = world.body(box);
  world.step(120);
  const PlumbVec3 at = world.position(body), from = box.pose.position;
  return std::hypot(at.x - from.x, at.y - from.y, at.z - from.z);
}

// Friction is a pyramid along the directions that ODE derives from the normal: for a slope that faces 30 degrees from
// the axes its edge is reached only at a steeper angle.
TEST(NativeFacts, ABoxOnASlopeThatFacesAskewDoesNotSlide) {
  EXPECT_GT(slide(0), .15);
  EXPECT_LT(slide(30), .02);
}

// The direct stepper solves a mass ratio of 100 exactly: it leaves no more penetration than the position error that it
// is told to mend step by step.
TEST(NativeFacts, TheDirectStepperIsExactOnMassRatios) {
  const auto sink = [](const char* stepper) {
    const TestWorld world(usual_needs, {setting("stepper", stepper)});
    world.fixed(world.box(10, 1, 10), {0, -1, 0});
    PlumbBodyDesc light = body_desc(), heavy = body_desc();
    light.shape = heavy.shape = world.box(.5, .5, .5);
    light.pose.position.y = .5;
    heavy.pose.position.y = 1.5;
    heavy.density = 100000;
    world.body(light);
    const PlumbBody top = world.body(heavy);
    world.step(600);
    return 1.5 - world.position(top).y;
  };
  EXPECT_NEAR(sink("step"), 0, 1e-4);
  EXPECT_GT(sink("quickstep"), 1e-3);
}

TEST(NativeFacts, QuickstepRepeatsForASeedAndDiffersForAnother) {
  const auto end = [](double seed) {
    const TestWorld world(usual_needs, {setting("random_seed", seed, PLUMB_SETTING_INT)});
    world.fixed(world.box(10, 1, 10), {0, -1, 0});
    PlumbBody top = 0;
    for (int i = 0; i < 5; ++i) top = world.dynamic(world.box(.5, .5, .5), {.05 * i, .5 + i, 0});
    world.step(60);
    return world.row(top, PLUMB_FIELD_POSE);
  };
  EXPECT_EQ(end(1), end(1));
  EXPECT_NE(end(1), end(2));
}

TEST(NativeFacts, SlidingDirectionsMakeFrictionIsotropic) {
  for (const double heading : {0.0, .4, .8}) {
    const TestWorld world(usual_needs, {setting("friction_directions", "sliding"), setting("stepper", "step")});
    world.fixed(world.box(100, 1, 100), {0, -1, 0});
    PlumbBodyDesc box = body_desc();
    box.shape = world.box(.5, .5, .5);
    box.pose.position.y = .5;
    box.linear_velocity = {5 * std::cos(heading), 0, 5 * std::sin(heading)};
    const PlumbBody body = world.body(box);
    world.step(90);
    const PlumbVec3 at = world.position(body);
    EXPECT_NEAR(std::hypot(at.x, at.z), 25 / (2 * .5 * 9.81), .15) << heading;
  }
}

// The other spaces and ODE's threads do the same physics.
TEST(NativeFacts, EverySpaceAndThePoolCarryATower) {
  const auto run = [](std::vector<PlumbSetting> settings) {
    const TestWorld world(usual_needs, std::move(settings));
    world.fixed(world.box(10, 1, 10), {0, -1, 0});
    PlumbBody top = 0;
    for (int i = 0; i < 3; ++i) top = world.dynamic(world.box(.5, .5, .5), {0, .5 + i, 0});
    world.step(120);
    EXPECT_NEAR(world.position(top).y, 2.5, .02);
  };
  for (const char* space : {"hash", "sap", "quadtree", "simple"}) run({setting("space", space)});
  run({setting("threads", 2, PLUMB_SETTING_INT)});
}

}  // namespace
}  // namespace plumb::ode_test
