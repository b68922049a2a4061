// Joints: where their axes point, limits, motors, springs, what they say and when they break.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

constexpr PlumbNeeds needs = PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS | PLUMB_NEED_JOINT_REACTIONS | PLUMB_NEED_EVENTS |
                             PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_FRICTION;
const PlumbVec3 still{0, 0, 0};

/// Exact for joints: the direct solver.
TestWorld direct_world(PlumbVec3 gravity = still) {
  TestWorld world(needs, {setting("stepper", "step")});
  check(*world, world->set_gravity(gravity));
  return world;
}

PlumbBody rod(const TestWorld& world, PlumbVec3 at) { return world.dynamic(world.box(.5, .1, .1), at); }

PlumbJointDesc between(PlumbJointType type, PlumbBody a, PlumbBody b, PlumbVec3 in_a, PlumbVec3 in_b) {
  PlumbJointDesc desc = joint_desc(type);
  desc.body_a = a;
  desc.body_b = b;
  desc.frame_a.position = in_a;
  desc.frame_b.position = in_b;
  return desc;
}

/// The joint's coordinate on an axis after `steps`.
double coordinate(const TestWorld& world, PlumbJoint joint, std::size_t axis, int steps) {
  world.step(steps);
  return world.row(joint, PLUMB_JOINT_COORDINATES, 6)[axis];
}

/// Which of the two bodies is free: the other is static, or the world (only as a).
enum class Free { b_of_world, b_of_static, a_of_static, both };

struct Case {
  PlumbJointType type;
  std::size_t axis;
  Free free;
};

class Drives : public testing::TestWithParam<Case> {};

// One sign convention: a motor of positive velocity makes the coordinate grow, whichever body is free.
TEST_P(Drives, MotorThenLimitMoveTheCoordinateAsTold) {
  const auto [type, axis, free] = GetParam();
  const TestWorld world = direct_world();
  PlumbBody a = 0, b = 0;
  const auto fixed = [&] { return world.fixed(world.box(.1, .1, .1)); };
  const auto loose = [&] { return world.dynamic(world.box(.5, .5, .5), {0, 0, 0}); };
  if (free == Free::b_of_static) a = fixed();
  if (free == Free::a_of_static || free == Free::both) a = loose();
  b = free == Free::a_of_static ? fixed() : loose();
  PlumbJointDesc desc = between(type, a, b, {0, 0, 0}, {0, 0, 0});
  desc.motors[axis] = {.5, 1e6, 1, 0};
  desc.limits[axis] = {-.2, .3, 1, 0};
  const PlumbJoint joint = world.joint(desc);
  EXPECT_NEAR(coordinate(world, joint, axis, 12), .1, .01);
  EXPECT_NEAR(coordinate(world, joint, axis, 120), .3, .02);
  const double back[12] = {-.5, 1e6, -.5, 1e6, -.5, 1e6, -.5, 1e6, -.5, 1e6, -.5, 1e6};
  double row[12] = {};
  row[2 * axis] = back[2 * axis];
  row[2 * axis + 1] = back[2 * axis + 1];
  check(*world,
        world->joints()->write_joints(PLUMB_JOINT_MOTOR, {&joint, 1},
                                      ConstRows(reinterpret_cast<const std::byte*>(row), 1, sizeof row, PLUMB_F64)));
  EXPECT_NEAR(coordinate(world, joint, axis, 180), -.2, .02);
}

// A damper and a spring by stiffness, alone in ODE's row of the axis and as a force beside limits: about the rest and
// towards it, whichever body is free.
TEST_P(Drives, SpringsByStiffnessPullToTheirRest) {
  const auto [type, axis, free] = GetParam();
  for (const bool limited : {false, true})
    for (const double stiffness : {0.0, 400.0}) {
      const TestWorld world = direct_world();
      const auto fixed = [&] { return world.fixed(world.box(.1, .1, .1)); };
      const auto loose = [&] { return world.dynamic(world.box(.5, .5, .5), {0, 0, 0}); };
      const PlumbBody a = free == Free::b_of_world ? 0 : free == Free::b_of_static ? fixed() : loose();
      const PlumbBody b = free == Free::a_of_static ? fixed() : loose();
      const PlumbBody mover = free == Free::a_of_static ? a : b;
      const auto mass = world.row(mover, PLUMB_FIELD_MASS);
      const double inertia = (axis < 3 ? mass[0] : mass[4]) * (free == Free::both ? .5 : 1);
      PlumbJointDesc desc = between(type, a, b, {0, 0, 0}, {0, 0, 0});
      if (limited) desc.limits[axis] = {-1, 1, 1, 0};
      desc.springs[axis] = {.2, stiffness / 100 * inertia, 2 * inertia, 1, PLUMB_SPRING_STIFFNESS};
      const PlumbJoint joint = world.joint(desc);
      for (int i = 0; i < 240; ++i) world.step(1, 1. / 240);
      const double now = world.row(joint, PLUMB_JOINT_COORDINATES, 6)[axis];
      // x'' + 2 x' + 4 (x - .2) = 0 from rest: after a second.
      const double w = std::sqrt(3.);
      const double truth = stiffness == 0 ? 0 : .2 * (1 - std::exp(-1.) * (std::cos(w) + std::sin(w) / w));
      EXPECT_NEAR(now, truth, .004) << "stiffness " << stiffness << (limited ? " beside limits" : "");
    }
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  constexpr const char* names[] = {"b_of_world", "b_of_static", "a_of_static", "both"};
  return "type" + std::to_string(info.param.type) + "_axis" + std::to_string(info.param.axis) + "_" +
         names[static_cast<int>(info.param.free)];
}

INSTANTIATE_TEST_SUITE_P(
    Axes, Drives,
    testing::Values(Case{PLUMB_JOINT_HINGE, 3, Free::b_of_world}, Case{PLUMB_JOINT_HINGE, 3, Free::b_of_static},
                    Case{PLUMB_JOINT_HINGE, 3, Free::a_of_static}, Case{PLUMB_JOINT_HINGE, 3, Free::both},
                    Case{PLUMB_JOINT_SLIDER, 0, Free::b_of_world}, Case{PLUMB_JOINT_SLIDER, 0, Free::b_of_static},
                    Case{PLUMB_JOINT_SLIDER, 0, Free::a_of_static}, Case{PLUMB_JOINT_SLIDER, 0, Free::both},
                    Case{PLUMB_JOINT_UNIVERSAL, 3, Free::b_of_world}, Case{PLUMB_JOINT_UNIVERSAL, 4, Free::b_of_world},
                    Case{PLUMB_JOINT_UNIVERSAL, 3, Free::a_of_static},
                    Case{PLUMB_JOINT_UNIVERSAL, 4, Free::a_of_static}, Case{PLUMB_JOINT_UNIVERSAL, 3, Free::both},
                    Case{PLUMB_JOINT_UNIVERSAL, 4, Free::both}),
    case_name);

// A joint's frames are what its descriptor says, not where the bodies happen to be.
TEST(Joints, PullFramesTogetherThatAreApart) {
  for (const PlumbJointType type : {PLUMB_JOINT_BALL, PLUMB_JOINT_HINGE, PLUMB_JOINT_FIXED, PLUMB_JOINT_UNIVERSAL}) {
    const TestWorld world = direct_world();
    PlumbBodyDesc desc = body_desc();
    desc.shape = world.box(.5, .1, .1);
    desc.pose = {{.51, .02, 0}, {0, 0, std::sin(.05), std::cos(.05)}};
    const PlumbBody b = world.body(desc);
    const PlumbJoint joint = world.joint(between(type, 0, b, {0, 0, 0}, {-.5, 0, 0}));
    world.step(120);
    const auto c = world.row(joint, PLUMB_JOINT_COORDINATES, 6);
    for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(c[axis], 0, 1e-6) << "type " << type << " axis " << axis;
    const double swing = std::hypot(c[4], c[5]);
    if (type == PLUMB_JOINT_HINGE || type == PLUMB_JOINT_FIXED) {
      EXPECT_NEAR(swing, 0, 1e-6);
    }
    if (type == PLUMB_JOINT_UNIVERSAL) {
      EXPECT_NEAR(c[5], 0, 1e-6);
    }
  }
}

TEST(Joints, HangingWeightIsTheReaction) {
  for (const PlumbJointType type : {PLUMB_JOINT_BALL, PLUMB_JOINT_HINGE, PLUMB_JOINT_FIXED, PLUMB_JOINT_DISTANCE}) {
    const TestWorld world = direct_world({0, -10, 0});
    const PlumbBody b = rod(world, {0, -1, 0});
    PlumbJointDesc desc = between(type, 0, b, {0, 0, 0}, {0, 1, 0});
    if (type == PLUMB_JOINT_DISTANCE) {
      desc.frame_b.position = {0, 0, 0};
      desc.rest_length = 1;
    }
    const PlumbJoint joint = world.joint(desc);
    world.step(60);
    const double weight = 10 * world.row(b, PLUMB_FIELD_MASS)[0];
    const auto r = world.row(joint, PLUMB_JOINT_REACTION, 6);
    EXPECT_NEAR(r[1], weight, 1e-6 * weight) << "type " << type;
    for (const std::size_t i : {0u, 2u, 3u, 4u, 5u}) EXPECT_NEAR(r[i], 0, 1e-6 * weight) << "type " << type;
  }
}

// A cantilever: the torque at the joint's frame, not at the centre of mass. Also of a static b on a dynamic a.
TEST(Joints, ReactionTorqueIsAboutFrameB) {
  const TestWorld world = direct_world({0, -10, 0});
  const PlumbBody arm = rod(world, {.5, 0, 0});
  const PlumbJoint joint = world.joint(between(PLUMB_JOINT_FIXED, 0, arm, {0, 0, 0}, {-.5, 0, 0}));
  const PlumbBody wall = world.fixed(0, {0, 5, 0}), other = rod(world, {.5, 5, 0});
  const PlumbJoint swapped = world.joint(between(PLUMB_JOINT_FIXED, other, wall, {-.5, 0, 0}, {0, 0, 0}));
  world.step(60);
  const double weight = 10 * world.row(arm, PLUMB_FIELD_MASS)[0];
  const auto on_arm = world.row(joint, PLUMB_JOINT_REACTION, 6), on_wall = world.row(swapped, PLUMB_JOINT_REACTION, 6);
  EXPECT_NEAR(on_arm[1], weight, 1e-4 * weight);
  EXPECT_NEAR(on_arm[5], weight * .5, 1e-3 * weight);
  EXPECT_NEAR(on_wall[1], -weight, 1e-4 * weight);
  EXPECT_NEAR(on_wall[5], -weight * .5, 1e-3 * weight);
}

TEST(Joints, RopeIsSlackInsideItsLimitsAndHoldsAtThem) {
  const TestWorld world = direct_world({0, -10, 0});
  const PlumbBody b = rod(world, {0, -.5, 0});
  PlumbJointDesc desc = between(PLUMB_JOINT_DISTANCE, 0, b, {0, 0, 0}, {0, 0, 0});
  desc.limits[0] = {.2, 2, 1, 0};
  const PlumbJoint joint = world.joint(desc);
  world.step(12);
  EXPECT_NEAR(world.velocity(b).y, -2, 1e-9);  // falls freely
  world.step(300);
  EXPECT_NEAR(world.position(b).y, -2, .01);
  const double weight = 10 * world.row(b, PLUMB_FIELD_MASS)[0];
  EXPECT_NEAR(world.row(joint, PLUMB_JOINT_REACTION, 6)[1], weight, 1e-3 * weight);
  check(*world, world->set_gravity({0, 10, 0}));
  world.step(300);
  EXPECT_NEAR(world.position(b).y, -.2, .01);
}

// 1 Hz, damping .1: displacement after a second within what the implicit row of ODE damps (h k beside c).
TEST(Joints, SpringSwingsAtItsFrequency) {
  const TestWorld world = direct_world();
  const PlumbBody b = world.dynamic(world.sphere(.1), {1.5, 0, 0});
  PlumbJointDesc desc = between(PLUMB_JOINT_DISTANCE, 0, b, {0, 0, 0}, {0, 0, 0});
  desc.rest_length = 1;
  desc.springs[0] = {0, 1, .1, 1, 0};
  world.joint(desc);
  double first_crossing = 0, time = 0;
  for (int i = 0; i < 2000 && first_crossing == 0; ++i) {
    world.step(1, 1e-3);
    time += 1e-3;
    if (world.position(b).x < 1) first_crossing = time;
  }
  // x falls through rest at (pi/2 + asin zeta) / (w sqrt(1 - zeta^2)).
  const double w = 2 * std::numbers::pi * std::sqrt(1 - .01);
  EXPECT_NEAR(first_crossing, (std::numbers::pi / 2 + std::asin(.1)) / w, .003);
  world.step(static_cast<int>(std::lround((1 - time) * 1000)), 1e-3);
  EXPECT_NEAR(world.position(b).x - 1, .26576756, .01);
}

TEST(Joints, HingeSpringHoldsItsRestAngle) {
  const TestWorld world = direct_world();
  const PlumbBody b = world.dynamic(world.box(.5, .5, .5), {0, 0, 0});
  PlumbJointDesc desc = between(PLUMB_JOINT_HINGE, 0, b, {0, 0, 0}, {0, 0, 0});
  desc.springs[3] = {.4, 2, 1, 1, 0};
  const PlumbJoint joint = world.joint(desc);
  EXPECT_NEAR(coordinate(world, joint, 3, 300), .4, 1e-3);
}

TEST(Joints, BreakWhenOverloadedAndSaySo) {
  const TestWorld world = direct_world({0, -10, 0});
  const PlumbBody b = rod(world, {0, -1, 0});
  const double weight = 10 * world.row(b, PLUMB_FIELD_MASS)[0];
  PlumbJointDesc desc = between(PLUMB_JOINT_BALL, 0, b, {0, 0, 0}, {0, 1, 0});
  desc.break_force = 1.5 * weight;
  const PlumbJoint joint = world.joint(desc);
  EXPECT_EQ(world.step(30).joints, 1u);
  check(*world, world->set_gravity({0, -20, 0}));
  EXPECT_EQ(world.step().joints, 0u);
  ASSERT_EQ(world->events().size(), 1u);
  EXPECT_EQ(world->events()[0].type, PLUMB_EVENT_JOINT_BROKEN);
  EXPECT_EQ(world->events()[0].joint, joint);
  const double before = world.velocity(b).y;
  world.step();
  EXPECT_NEAR(world.velocity(b).y - before, -20 / 60.0, 1e-9);
}

TEST(Joints, ConnectedBodiesTouchOnlyWhenAsked) {
  for (const std::uint32_t touch : {0u, 1u}) {
    TestWorld world(usual_needs | PLUMB_NEED_CONTACTS);
    check(*world, world->set_gravity(still));
    const PlumbShape box = world.box(.5, .5, .5);
    const PlumbBody a = world.dynamic(box, {0, 0, 0}), b = world.dynamic(box, {.9, 0, 0});
    PlumbJointDesc desc = between(PLUMB_JOINT_BALL, a, b, {.45, 0, 0}, {-.45, 0, 0});
    desc.collide_connected = touch;
    const PlumbJoint joint = world.joint(desc);
    world.step();
    EXPECT_EQ(world->contacts().empty(), touch == 0);
    check(*world, world->joints()->destroy_joints({&joint, 1}));
    world.step();
    EXPECT_FALSE(world->contacts().empty());
  }
}

TEST(Joints, WhatOdeHasNotIsRefusedInWords) {
  const TestWorld world = direct_world();
  const PlumbBody b = rod(world, {0, 0, 0});
  PlumbJointDesc desc = between(PLUMB_JOINT_HINGE, 0, b, {0, 0, 0}, {0, 0, 0});
  desc.limits[4] = {-1, 1, 1, 0};
  PlumbJoint id = 0;
  EXPECT_EQ(world->joints()->create_joints({&desc, 1}, {&id, 1}), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(world->error_text().find("axis 4"), std::string::npos);
  EXPECT_EQ(world.step().joints, 0u);
}

}  // namespace
}  // namespace plumb::ode_test
