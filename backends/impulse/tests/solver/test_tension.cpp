// Light links under tension: sub-steps are short enough that they swing as fast as they would.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr double kLength = 0.2, kLinkMass = 0.1;  // m, kg

/// How fast the joint between two rods, on which a load hangs, swings aside when it is plucked, rad/s; seen once in
/// each of the setting's sub-steps.
double pluck(double load) {
  constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_JOINTS;
  constexpr double kSubstep = 1.0 / 480, kSpeed = 0.2;  // s, m/s
  Scene scene(engine(), kNeeds, kDown, 1);
  EXPECT_EQ(scene.world().settings()->set_setting("substeps", {PLUMB_SETTING_INT, 0, 1, nullptr}), PLUMB_OK);
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  const auto hang = [&](const PlumbShape& shape, double mass, double y, PlumbBody on, const PlumbVec3& hook,
                        double reach) {
    scene.body.mass = mass;
    const PlumbBody body = scene.add(shape, {0, y, 0});
    scene.ball_joint(on, hook, body, {0, reach, 0});
    return body;
  };
  const PlumbShape rod = scene.box({0.005, kLength / 2, 0.005});
  const PlumbBody upper = hang(rod, kLinkMass, -kLength / 2, 0, {0, 0, 0}, kLength / 2);
  const PlumbBody lower = hang(rod, kLinkMass, -1.5 * kLength, upper, {0, -kLength / 2, 0}, kLength / 2);
  hang(scene.sphere(0.3), load, -2 * kLength - 0.4, lower, {0, -kLength / 2, 0}, 0.4);
  for (int i = 0; i < 480; ++i) {
    check(scene.world(), scene.world().step(kSubstep));
    PlumbStepReport report{};
    check(scene.world(), scene.world().wait(report));
  }
  // Each turns about its outer end.
  scene.write(PLUMB_FIELD_VELOCITY, upper, {kSpeed / 2, 0, 0, 0, 0, kSpeed / kLength});
  scene.write(PLUMB_FIELD_VELOCITY, lower, {kSpeed / 2, 0, 0, 0, 0, -kSpeed / kLength});
  constexpr int kSeen = 240;
  int turns = 0;
  double before = 1;
  for (int i = 0; i < kSeen; ++i) {
    check(scene.world(), scene.world().step(kSubstep));
    PlumbStepReport report{};
    check(scene.world(), scene.world().wait(report));
    const double speed = scene.velocity(upper)[0];
    if (speed * before < 0) ++turns;
    before = speed;
  }
  return turns * std::numbers::pi / (kSeen * kSubstep);
}

/// T / l on either side turns a joint back that moves with a third of each rod: 3 T / (m l) is its frequency squared.
TEST(SubstepsByTension, LetLightLinksSwingAsFastAsTheyDo) {
  for (const double load : {50.0, 300.0, 600.0}) {
    const double tension = (load + kLinkMass) * 9.81;
    const double truth = std::sqrt(3 * tension / (kLinkMass * kLength));
    EXPECT_NEAR(pluck(load), truth, 0.05 * truth) << load << " kg";
  }
}

}  // namespace
}  // namespace plumb::impulse::test
