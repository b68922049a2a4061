// What adapters make of joints whose engine has no such limit, spring, motor or reaction: the same of each of them.
#include <gtest/gtest.h>

#include <numbers>

#include "plumb_scene.hpp"

namespace {

using namespace scenes;

constexpr PlumbNeeds kJointNeeds = kNeeds | PLUMB_NEED_JOINT_REACTIONS | PLUMB_NEED_FORCES;

PlumbJoint join(plumb::IPhysicsWorld& world, const PlumbJointDesc& desc) {
  PlumbJoint joint = 0;
  plumb::check(world, world.joints()->create_joints({&desc, 1}, {&joint, 1}));
  return joint;
}

std::array<double, 6> joint_row(plumb::IPhysicsWorld& world, PlumbJointField field, PlumbJoint joint) {
  std::array<double, 6> row{};
  plumb::check(world, world.joints()->read_joints(field, {&joint, 1}, plumb::rows_over(std::span(&row, 1))));
  return row;
}

/// A body half a metre from its joint with the world, without gravity.
struct Lever {
  explicit Lever(PlumbJointType type, PlumbVec3 gravity = {}) : world(make_world(kJointNeeds)) {
    plumb::check(*world, world->set_gravity(gravity));
    PlumbBodyDesc body = plumb::body_desc();
    body.shape = add_box(*world, {0.25, 0.25, 0.25});
    body.pose.position = {0.5, 0, 0};
    b = add_body(*world, body);
    desc = plumb::joint_desc(type);
    desc.body_b = b;
    desc.frame_b.position = {-0.5, 0, 0};
  }
  std::unique_ptr<plumb::IPhysicsWorld> world;
  PlumbBody b = 0;
  PlumbJointDesc desc{};
};

/// What pulls at a joint is its weight, whichever constraint stands for it, and nothing else where axes are free.
TEST(AdaptedJoints, ReactionsCarryAWeight) {
  constexpr double kWeight = 125 * 10;
  for (const PlumbJointType type : {PLUMB_JOINT_BALL, PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER, PLUMB_JOINT_FIXED,
                                    PLUMB_JOINT_UNIVERSAL, PLUMB_JOINT_GENERIC, PLUMB_JOINT_SWING_TWIST}) {
    Lever lever(type, {-10, 0, 0});
    lever.desc.frame_a.position = lever.desc.frame_b.position = {};
    lever.desc.frame_a.position = {0.5, 0, 0};
    for (std::size_t axis = 0; axis < 6; ++axis) lever.desc.axis_modes[axis] = PLUMB_AXIS_LOCKED;
    if (type == PLUMB_JOINT_SLIDER) lever.desc.limits[0] = {0, 1, 1, 0};
    const PlumbJoint joint = join(*lever.world, lever.desc);
    for (int i = 0; i < 120; ++i) advance(*lever.world);
    const auto reaction = joint_row(*lever.world, PLUMB_JOINT_REACTION, joint);
    EXPECT_NEAR(reaction[0], kWeight, 0.01 * kWeight) << type;
    EXPECT_NEAR(std::hypot(reaction[1], reaction[2]), 0, 1) << type;
    EXPECT_NEAR(std::hypot(reaction[3], reaction[4], reaction[5]), 0, 1) << type;
  }
}

/// Torques of what a joint locks, seen from b: a lever that is held out level, about each of the joint's axes.
TEST(AdaptedJoints, ReactionsHoldALever) {
  constexpr double kMoment = 125 * 10 * 0.5;
  for (const PlumbJointType type :
       {PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER, PLUMB_JOINT_FIXED, PLUMB_JOINT_GENERIC, PLUMB_JOINT_UNIVERSAL}) {
    Lever lever(type, {0, -10, 0});
    for (std::size_t axis = 0; axis < 6; ++axis) lever.desc.axis_modes[axis] = PLUMB_AXIS_LOCKED;
    lever.desc.axis_modes[3] = PLUMB_AXIS_FREE;
    const PlumbJoint joint = join(*lever.world, lever.desc);
    for (int i = 0; i < 60; ++i) advance(*lever.world);
    const auto reaction = joint_row(*lever.world, PLUMB_JOINT_REACTION, joint);
    EXPECT_NEAR(reaction[1], 1250, 15) << type;
    EXPECT_NEAR(reaction[5], kMoment, 0.02 * kMoment) << type;
  }
}

/// A hinge's limits need not hold 0, as engines may ask.
TEST(AdaptedJoints, LimitsMayLieBesideZero) {
  for (const double push : {10.0, -10.0}) {
    Lever lever(PLUMB_JOINT_HINGE);
    lever.desc.limits[3] = {0.5, 1.0, 1, 0};
    const PlumbJoint joint = join(*lever.world, lever.desc);
    for (int i = 0; i < 240; ++i) {
      write_row<3>(*lever.world, PLUMB_FIELD_TORQUE, lever.b, {push, 0, 0});
      advance(*lever.world);
    }
    EXPECT_NEAR(joint_row(*lever.world, PLUMB_JOINT_COORDINATES, joint)[3], push > 0 ? 1.0 : 0.5, 5e-3);
  }
}

/// A spring pulls towards where it rests though a limit is before it, where engines may rest it at the limit.
TEST(AdaptedJoints, SpringsMayRestBeyondLimits) {
  Lever lever(PLUMB_JOINT_HINGE);
  lever.desc.limits[3] = {-0.5, 0.5, 1, 0};
  lever.desc.springs[3] = {2, 200, 100, 1, PLUMB_SPRING_STIFFNESS};
  const PlumbJoint joint = join(*lever.world, lever.desc);
  for (int i = 0; i < 600; ++i) {
    write_row<3>(*lever.world, PLUMB_FIELD_TORQUE, lever.b, {-200 * 1.8, 0, 0});  // as the spring pulls at 0.2
    advance(*lever.world);
  }
  EXPECT_NEAR(joint_row(*lever.world, PLUMB_JOINT_COORDINATES, joint)[3], 0.2, 5e-3);
}

/// A motor and a spring on one axis, which an engine's hinge may not have: the motor pushes the spring as far as its
/// force goes.
TEST(AdaptedJoints, MotorsStandBesideSprings) {
  for (const PlumbJointType type : {PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER}) {
    Lever lever(type);
    const std::size_t axis = type == PLUMB_JOINT_HINGE ? 3 : 0;
    lever.desc.springs[axis] = {0, 100, 50, 1, PLUMB_SPRING_STIFFNESS};
    lever.desc.motors[axis] = {5, 30, 1, 0};
    const PlumbJoint joint = join(*lever.world, lever.desc);
    for (int i = 0; i < 1200; ++i) advance(*lever.world);
    EXPECT_NEAR(joint_row(*lever.world, PLUMB_JOINT_COORDINATES, joint)[axis], 0.3, 3e-3) << type;
  }
}

/// A rope of a given length that is a spring, too, stretches no further.
TEST(AdaptedJoints, DistancesHaveLimitsBesideASpring) {
  Lever lever(PLUMB_JOINT_DISTANCE, {10, 0, 0});
  lever.desc.rest_length = 0;
  lever.desc.springs[0] = {0, 100, 300, 1, PLUMB_SPRING_STIFFNESS};
  lever.desc.limits[0] = {0, 2, 1, 0};
  const PlumbJoint joint = join(*lever.world, lever.desc);
  for (int i = 0; i < 600; ++i) advance(*lever.world);
  EXPECT_NEAR(joint_row(*lever.world, PLUMB_JOINT_COORDINATES, joint)[0], 2, 5e-3);
  EXPECT_NEAR(joint_row(*lever.world, PLUMB_JOINT_REACTION, joint)[0], -1250, 15);
}

/// A motor that is switched on later: a ball has none before it needs one.
TEST(AdaptedJoints, BallsGetMotorsLater) {
  Lever lever(PLUMB_JOINT_BALL);
  lever.desc.frame_a.position = {0.5, 0, 0};
  lever.desc.frame_b.position = {};
  const PlumbJoint joint = join(*lever.world, lever.desc);
  std::array<double, 12> row{};
  row[6] = 1.5;
  row[7] = 1e5;
  plumb::check(*lever.world, lever.world->joints()->write_joints(
                                 PLUMB_JOINT_MOTOR, {&joint, 1},
                                 plumb::const_rows_over(std::span<const std::array<double, 12>>(&row, 1))));
  for (int i = 0; i < 30; ++i) advance(*lever.world);
  EXPECT_NEAR(read_row<6>(*lever.world, PLUMB_FIELD_VELOCITY, lever.b)[3], 1.5, 0.01);
}

TEST(AdaptedJoints, DistancesHaveNoMotors) {
  Lever lever(PLUMB_JOINT_DISTANCE);
  lever.desc.motors[0] = {1, 1, 1, 0};
  PlumbJoint joint = 0;
  EXPECT_EQ(lever.world->joints()->create_joints({&lever.desc, 1}, {&joint, 1}), PLUMB_E_UNSUPPORTED);
}

}  // namespace
