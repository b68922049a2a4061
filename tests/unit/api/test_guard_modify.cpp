// The guard of changes: what it refuses, what the backend's class hears, and what the guard itself answers afterwards.
#include <gtest/gtest.h>

#include "fake_world.hpp"
#include "plumb/backend/modify.hpp"
#include "plumb/loader.hpp"

namespace plumb::test {
namespace {

class GuardedChanges : public ::testing::Test {
 protected:
  explicit GuardedChanges(PlumbNeeds needs = PLUMB_NEED_ALL & ~PLUMB_NEED_CCD)
      : world(Backend(negotiate(&backend::open<FakeWorld>, "fake")).create_world(world_desc(needs))) {
    PlumbShapeDesc descs[2] = {shape_desc(PLUMB_BOX), shape_desc(PLUMB_SPHERE)};
    descs[0].half_extents = {1, 1, 1};
    descs[1].radius = 1;
    EXPECT_EQ(world->create_shapes(descs, shapes), PLUMB_OK) << world->error_text();
    PlumbBodyDesc body = body_desc();
    body.shape = shapes[0];
    body.density = 1;
    EXPECT_EQ(world->create_bodies({&body, 1}, {&dynamic, 1}), PLUMB_OK) << world->error_text();
    body.motion = PLUMB_STATIC;
    EXPECT_EQ(world->create_bodies({&body, 1}, {&fixed, 1}), PLUMB_OK) << world->error_text();
    PlumbJointDesc hinge = joint_desc(PLUMB_JOINT_HINGE);
    hinge.body_b = dynamic;
    EXPECT_EQ(world->joints()->create_joints({&hinge, 1}, {&joint, 1}), PLUMB_OK) << world->error_text();
  }

  static PlumbBodyChange of(PlumbBody body, std::uint32_t what) {
    PlumbBodyChange change = body_change(body);
    change.what = what;
    return change;
  }
  PlumbResult modify(const PlumbBodyChange& change) { return world->modify()->modify_bodies({&change, 1}); }
  PlumbResult modify(const PlumbJointChange& change) { return world->modify()->modify_joints({&change, 1}); }
  template <class Change>
  void refused(PlumbResult code, const std::string& named, const Change& change) {
    const int before = FakeWorld::last->calls;
    EXPECT_EQ(modify(change), code);
    EXPECT_NE(world->error_text().find(named), std::string::npos)
        << "\"" << world->error_text() << "\" does not name " << named;
    EXPECT_EQ(FakeWorld::last->calls, before) << "the class was called";
  }
  std::array<double, 11> mass(PlumbBody body) {
    std::array<double, 11> row{};
    EXPECT_EQ(world->read(PLUMB_FIELD_MASS, {&body, 1}, rows_over(std::span(&row, 1))), PLUMB_OK);
    return row;
  }

  std::unique_ptr<IPhysicsWorld> world;
  PlumbShape shapes[2] = {};
  PlumbBody dynamic = 0, fixed = 0;
  PlumbJoint joint = 0;
};

TEST_F(GuardedChanges, TheClassHearsWhatAllMembersWillBe) {
  PlumbBodyChange change = of(dynamic, PLUMB_MODIFY_SHAPE);
  change.shape = shapes[1];
  change.motion = PLUMB_STATIC;  // not named, and so not read
  ASSERT_EQ(modify(change), PLUMB_OK) << world->error_text();
  const PlumbBodyChange heard = FakeWorld::last->body_changes.at(0);
  EXPECT_EQ(heard.motion, static_cast<PlumbMotion>(PLUMB_DYNAMIC));
  EXPECT_EQ(heard.shape, shapes[1]);
  EXPECT_EQ(heard.mass_mode, static_cast<PlumbMassMode>(PLUMB_MASS_EXPLICIT));
  EXPECT_DOUBLE_EQ(heard.mass, 8) << "of the box that it was";
  EXPECT_DOUBLE_EQ(heard.inertia.x, 8 * (4.0 + 4.0) / 12);
}

TEST_F(GuardedChanges, MassesFollowTheNewShapeWhereAsked) {
  PlumbBodyChange change = of(dynamic, PLUMB_MODIFY_SHAPE | PLUMB_MODIFY_MASS);
  change.shape = shapes[1];
  change.mass_mode = PLUMB_MASS_FROM_TOTAL;
  change.mass = 5;
  ASSERT_EQ(modify(change), PLUMB_OK) << world->error_text();
  EXPECT_DOUBLE_EQ(mass(dynamic)[0], 5);
  EXPECT_DOUBLE_EQ(mass(dynamic)[4], 5 * 0.4);
}

TEST_F(GuardedChanges, MassesAreKeptWhileABodyIsNotDynamic) {
  const auto before = mass(dynamic);
  PlumbBodyChange change = of(dynamic, PLUMB_MODIFY_MOTION);
  change.motion = PLUMB_KINEMATIC;
  ASSERT_EQ(modify(change), PLUMB_OK) << world->error_text();
  EXPECT_EQ(mass(dynamic)[0], 0);
  change.motion = PLUMB_DYNAMIC;
  ASSERT_EQ(modify(change), PLUMB_OK) << world->error_text();
  EXPECT_EQ(mass(dynamic), before);
}

TEST_F(GuardedChanges, ShapesInUseFollow) {
  PlumbBodyChange change = of(dynamic, PLUMB_MODIFY_SHAPE);
  change.shape = shapes[1];
  ASSERT_EQ(modify(change), PLUMB_OK) << world->error_text();
  EXPECT_EQ(world->destroy_shapes({&shapes[1], 1}), PLUMB_E_IN_USE);
  change.shape = 0;
  ASSERT_EQ(modify(change), PLUMB_OK) << world->error_text();
  EXPECT_EQ(world->destroy_shapes({&shapes[1], 1}), PLUMB_OK);
}

TEST_F(GuardedChanges, FieldsFollowTheMotion) {
  PlumbBodyChange change = of(dynamic, PLUMB_MODIFY_MOTION);
  change.motion = PLUMB_STATIC;
  ASSERT_EQ(modify(change), PLUMB_OK) << world->error_text();
  const double force[3] = {1, 0, 0};
  EXPECT_EQ(world->write(PLUMB_FIELD_FORCE, {&dynamic, 1}, const_rows_over(std::span(&force, 1))),
            PLUMB_E_INVALID_ARGUMENT)
      << "what is static is pushed";
}

TEST_F(GuardedChanges, WhatCannotBeIsRefusedInWords) {
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[0].what is 0", of(dynamic, 0));
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[0].what is 32", of(dynamic, 32));
  refused(PLUMB_E_STALE_HANDLE, "changes[0].body is handle 77", of(77, PLUMB_MODIFY_SHAPE));
  PlumbBodyChange change = of(fixed, PLUMB_MODIFY_MOTION);
  change.motion = PLUMB_DYNAMIC;
  refused(PLUMB_E_INVALID_ARGUMENT, "add PLUMB_MODIFY_MASS", change);
  change = of(fixed, PLUMB_MODIFY_MASS);
  change.mass = 1;
  refused(PLUMB_E_INVALID_ARGUMENT, "the body is static", change);
  change = of(dynamic, PLUMB_MODIFY_FLAGS);
  change.flags = PLUMB_BODY_ASLEEP;
  refused(PLUMB_E_INVALID_ARGUMENT, "PLUMB_FIELD_AWAKE", change);
  change.flags = PLUMB_BODY_CCD;
  refused(PLUMB_E_NOT_DECLARED, "PLUMB_NEED_CCD", change);
  change = of(dynamic, PLUMB_MODIFY_MASS);
  change.mass_mode = PLUMB_MASS_EXPLICIT;
  change.mass = -1;
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[0].mass is -1", change);

  PlumbJointChange joint_changed = joint_change(joint);
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[0].what is 0", joint_changed);
  joint_changed.what = PLUMB_MODIFY_ENABLED;
  joint_changed.enabled = 2;
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[0].enabled is 2", joint_changed);
  joint_changed.what = PLUMB_MODIFY_LIMITS;
  joint_changed.limits[3] = {1, -1, 1, 0};
  refused(PLUMB_E_INVALID_ARGUMENT, "changes[0].limits[3].lower", joint_changed);
  joint_changed.joint = 99;
  refused(PLUMB_E_STALE_HANDLE, "changes[0].joint is handle 99", joint_changed);
}

TEST_F(GuardedChanges, FlagsOfParticlesNeedAMassToTurn) {
  PlumbBodyChange change = of(dynamic, PLUMB_MODIFY_FLAGS);
  change.flags = PLUMB_BODY_NO_ROTATION;
  ASSERT_EQ(modify(change), PLUMB_OK) << world->error_text();
  EXPECT_EQ(FakeWorld::last->body_changes.at(0).inertia.x, 0);
  change.flags = 0;
  refused(PLUMB_E_INVALID_ARGUMENT, "it has no inertia", change);
}

TEST_F(GuardedChanges, OfShapesKeepTheirType) {
  const double heights[6] = {0, 1, 2, 0, 1, 2};
  PlumbShapeDesc field = shape_desc(PLUMB_HEIGHT_FIELD);
  field.heights = heights;
  field.rows = 2;
  field.columns = 3;
  field.spacing = {1, 0, 1};
  PlumbShape ground = 0;
  ASSERT_EQ(world->create_shapes({&field, 1}, {&ground, 1}), PLUMB_OK) << world->error_text();
  const auto become = [&](PlumbShape shape, const PlumbShapeDesc& desc) {
    return world->modify()->modify_shapes({&shape, 1}, {&desc, 1});
  };
  ASSERT_EQ(become(ground, field), PLUMB_OK) << world->error_text();
  EXPECT_EQ(FakeWorld::last->shapes_changed, std::vector{ground});
  const int before = FakeWorld::last->calls;
  const auto refuse = [&](PlumbResult code, const std::string& named, PlumbShape shape, const PlumbShapeDesc& desc) {
    EXPECT_EQ(become(shape, desc), code);
    EXPECT_NE(world->error_text().find(named), std::string::npos)
        << "\"" << world->error_text() << "\" does not name " << named;
  };
  PlumbShapeDesc ball = shape_desc(PLUMB_SPHERE);
  ball.radius = 1;
  refuse(PLUMB_E_INVALID_ARGUMENT, "descs[0].type is sphere, but the shape is a height field", ground, ball);
  refuse(PLUMB_E_UNSUPPORTED, "a sphere does not change", shapes[1], ball);
  refuse(PLUMB_E_STALE_HANDLE, "77", 77, field);
  field.columns = 1;
  refuse(PLUMB_E_INVALID_ARGUMENT, "descs[0].columns is 1", ground, field);
  EXPECT_EQ(FakeWorld::last->calls, before) << "the class was called";
  PlumbBodyDesc body = body_desc(PLUMB_STATIC);
  body.shape = ground;
  PlumbBody standing = 0;
  ASSERT_EQ(world->create_bodies({&body, 1}, {&standing, 1}), PLUMB_OK) << world->error_text();
  field.columns = 3;
  ASSERT_EQ(become(ground, field), PLUMB_OK);
  EXPECT_EQ(world->destroy_shapes({&ground, 1}), PLUMB_E_IN_USE) << "its body has it still";
}

TEST_F(GuardedChanges, JointChangesHoldWhatTheyName) {
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_GENERIC);
  desc.rest_length = 7;
  PlumbJointChange change = joint_change(1);
  change.what = PLUMB_MODIFY_LIMITS | PLUMB_MODIFY_STRENGTH;
  change.axis_modes[2] = PLUMB_AXIS_LIMITED;
  change.limits[2] = {-1, 1, 1, 0};
  change.break_force = 3;
  change.frame_a.position = {9, 9, 9};
  change.rest_length = 5;
  backend::apply(change, desc);
  EXPECT_EQ(desc.axis_modes[2], static_cast<PlumbAxisMode>(PLUMB_AXIS_LIMITED));
  EXPECT_EQ(desc.limits[2].upper, 1);
  EXPECT_EQ(desc.break_force, 3);
  EXPECT_EQ(desc.frame_a.position.x, 0) << "which the change does not name";
  EXPECT_EQ(desc.rest_length, 7) << "which is of distance joints";
}

}  // namespace
}  // namespace plumb::test
