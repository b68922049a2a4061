#include "backend_under_test.hpp"
#include "plumb/helpers/floating_origin.hpp"

namespace plumb::helpers::test {
namespace {

TEST(FloatingOrigin, KeepsRelativePosesToTheBitAndTheTrack) {
  TestWorld far, near;
  const double out = 4096;
  const auto build = [](TestWorld& t, double x) {
    t.box(PLUMB_STATIC, {5, 0.5, 5}, {x, -0.5, 0});
    return std::pair(t.box(PLUMB_DYNAMIC, {0.5, 0.5, 0.5}, {x, 0.5, 0}), t.sphere(0.25, {x + 0.25, 2.5, 0.125}, 1));
  };
  const auto [far_box, far_ball] = build(far, out);
  const auto [near_box, near_ball] = build(near, 0);
  FloatingOrigin origin(*far.world);
  const PlumbVec3 by = origin.update({out, 0, 0});
  EXPECT_EQ(by.x, -out);
  EXPECT_EQ(origin.origin().x, out);
  EXPECT_EQ(far.pose(far_ball).position.x, 0.25);
  EXPECT_EQ(origin.update({0, 0, 0}).x, 0);
  for (int i = 0; i < 60; ++i) {
    far.step(1.0 / 60);
    near.step(1.0 / 60);
    EXPECT_NEAR(far.pose(far_ball).position.x, near.pose(near_ball).position.x, 1e-4) << i;
    EXPECT_NEAR(far.pose(far_ball).position.y, near.pose(near_ball).position.y, 1e-4) << i;
  }
}

TEST(FloatingOrigin, PutsAllBackWhereAJointHoldsToTheWorld) {
  TestWorld t;
  const PlumbBody bob = t.sphere(0.5, {2048, 0, 0}, 1);
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_BALL);
  desc.body_b = bob;
  desc.frame_a.position = {2048, 1, 0};
  desc.frame_b.position = {0, 1, 0};
  PlumbJoint joint = 0;
  check(*t.world, t.world->joints()->create_joints({&desc, 1}, {&joint, 1}));
  FloatingOrigin origin(*t.world);
  EXPECT_THROW(origin.update({2048, 0, 0}, std::span(&joint, 1)), Error);
  EXPECT_EQ(t.pose(bob).position.x, 2048);
  EXPECT_EQ(origin.origin().x, 0);
}

TEST(FloatingOrigin, RefusesACellThatRounds) {
  TestWorld t;
  EXPECT_THROW(FloatingOrigin(*t.world, {100, 1000}), Error);
}

}  // namespace
}  // namespace plumb::helpers::test
