// What is known of MuJoCo and of how it is wrapped, and must stay known.
#include <gtest/gtest.h>

#include "plumb_scene.hpp"

namespace {

using namespace scenes;

PlumbNeeds with(PlumbNeeds more) { return kNeeds | more; }

/// Bodies that come make MuJoCo's model anew; those that were there go on as if nothing had been.
TEST(Mujoco, BodiesGoOnWhereOthersCome) {
  PlumbScene left(chain(4)), joined(chain(4));
  for (int i = 0; i < 60; ++i) {
    if (i == 30) add_body(*joined.world, frictionless(PLUMB_DYNAMIC, add_sphere(*joined.world, 0.5), {100, 0, 0}));
    advance(*left.world);
    advance(*joined.world);
  }
  for (std::size_t i = 0; i < left.bodies.size(); ++i) {
    const auto a = read_row<7>(*left.world, PLUMB_FIELD_POSE, left.bodies[i]),
               b = read_row<7>(*joined.world, PLUMB_FIELD_POSE, joined.bodies[i]);
    for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(a[k], b[k], 1e-6) << "body " << i << ", number " << k;
  }
}

/// Joints of a tree have no error, whatever hangs on them.
TEST(Mujoco, JointsOfATreeDoNotGape) {
  PlumbScene scene(chain(10));
  for (int i = 0; i < 120; ++i) advance(*scene.world);
  for (const PlumbJoint joint : scene.joints) {
    std::array<double, 6> at{};
    plumb::check(*scene.world, scene.world->joints()->read_joints(PLUMB_JOINT_COORDINATES, {&joint, 1},
                                                                  plumb::rows_over(std::span(&at, 1))));
    EXPECT_LT(std::abs(at[0]) + std::abs(at[1]) + std::abs(at[2]), 1e-9);
  }
}

PlumbResult join(plumb::IPhysicsWorld& world, PlumbJointType type, PlumbBody a, PlumbBody b, double at) {
  PlumbJointDesc desc = plumb::joint_desc(type);
  desc.body_a = a;
  desc.body_b = b;
  desc.frame_a.position = {a == 0 ? at : 0.5, 0, 0};
  desc.frame_b.position = {a == 0 && at > 0 ? 0.5 : -0.5, 0, 0};
  PlumbJoint id = 0;
  return world.joints()->create_joints({&desc, 1}, {&id, 1});
}

/// A bridge of two beams between two walls: its last joint closes a loop.
TEST(Mujoco, LoopsAreClosedByBallsAndNotBySliders) {
  const auto world = make_world(with(PLUMB_NEED_JOINTS));
  PlumbBodyDesc beam = frictionless(PLUMB_DYNAMIC, add_box(*world, {0.5, 0.1, 0.1}), {0.5, 0, 0});
  const PlumbBody one = add_body(*world, beam);
  beam.pose.position.x = 1.5;
  const PlumbBody two = add_body(*world, beam);
  ASSERT_EQ(join(*world, PLUMB_JOINT_SLIDER, 0, one, 0), PLUMB_OK);
  ASSERT_EQ(join(*world, PLUMB_JOINT_UNIVERSAL, one, two, 0), PLUMB_OK);
  EXPECT_EQ(join(*world, PLUMB_JOINT_SLIDER, 0, two, 2), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(world->error_text().find("loop"), std::string::npos) << world->error_text();
  ASSERT_EQ(join(*world, PLUMB_JOINT_BALL, 0, two, 2), PLUMB_OK);
  for (int i = 0; i < 120; ++i) advance(*world);
  const auto pose = read_row<7>(*world, PLUMB_FIELD_POSE, two);
  EXPECT_NEAR(pose[0], 1.5, 0.02);
  EXPECT_NEAR(pose[1], 0, 0.02) << "held at both ends";
}

/// Contacts come by the hundred where a world began with room for few.
TEST(Mujoco, RoomGrows) {
  const auto world = make_world(kNeeds, {number_setting("substeps", 1, PLUMB_SETTING_INT)});
  add_body(*world, frictionless(PLUMB_STATIC, add_box(*world, {20, 0.5, 20}), {0, -0.5, 0}));
  const PlumbShape box = add_box(*world, {0.5, 0.5, 0.5});
  for (int i = 0; i < 14; ++i) add_body(*world, frictionless(PLUMB_DYNAMIC, box, {0.05 * i, 0.5, 0.03 * i}));
  const PlumbStepReport report = advance(*world);
  EXPECT_NE(report.remarks & PLUMB_REMARK_CAPACITY_GREW, 0u);
  EXPECT_EQ(report.nonfinite, 0u);
  EXPECT_GT(report.contacts, 150u);
}

/// MuJoCo's gyroscopic torque alone would take a blade that tumbles at 300 rad/s beyond all numbers within a second.
TEST(Mujoco, WhatTumblesFastDoesNotGain) {
  const auto world = make_world(with(PLUMB_NEED_GYROSCOPIC));
  PlumbBodyDesc blade = frictionless(PLUMB_DYNAMIC, add_box(*world, {0.3, 0.2, 0.4}), {0, 0, 0});
  blade.angular_velocity = {200, 200, 100};
  const PlumbBody body = add_body(*world, blade);
  for (int i = 0; i < 600; ++i) ASSERT_EQ(advance(*world).nonfinite, 0u) << "step " << i;
  const auto row = read_row<6>(*world, PLUMB_FIELD_VELOCITY, body);
  EXPECT_LT(std::hypot(row[3], row[4], row[5]), 400);
}

}  // namespace
