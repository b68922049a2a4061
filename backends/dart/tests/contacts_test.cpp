// Contacts: DART's own constraint with the pair's material, and settings that reach it.
#include <gtest/gtest.h>

#include "plumb_scene.hpp"

namespace {

using namespace scenes;

/// A cube at 3 m/s along x on a plain floor of another friction.
double way_until_it_rests(double of_floor, double of_cube) {
  const auto world = make_world(kNeeds);
  PlumbBodyDesc floor = plumb::body_desc(PLUMB_STATIC);
  floor.shape = add_box(*world, {50, 0.5, 50});
  floor.pose.position = {0, -0.5, 0};
  floor.material.friction = of_floor;
  add_body(*world, floor);
  PlumbBodyDesc cube = plumb::body_desc();
  cube.shape = add_box(*world, {0.5, 0.5, 0.5});
  cube.pose.position = {0, 0.5, 0};
  cube.linear_velocity = {3, 0, 0};
  cube.material.friction = of_cube;
  const PlumbBody body = add_body(*world, cube);
  for (int i = 0; i < 240; ++i) advance(*world);
  return read_row<7>(*world, PLUMB_FIELD_POSE, body)[0];
}

/// v2 / (2 mu g) with the geometric mean; by the lesser of both, as DART has it, the way were twice as long.
TEST(Dart, FrictionIsThatOfThePair) {
  EXPECT_NEAR(way_until_it_rests(0.2, 0.8), 9 / (2 * 0.4 * 9.81), 0.02);
  EXPECT_NEAR(way_until_it_rests(0.8, 0.2), 9 / (2 * 0.4 * 9.81), 0.02);
}

/// A cube that slides along the diagonal between both directions is held by either, with as much as one alone would
/// have.
TEST(Dart, FrictionGoesAgainstTheSlidingWhereItIsTold) {
  const auto way = [](const char* directions) {
    const auto world = make_world(kNeeds, {word_setting("friction_directions", directions)});
    PlumbBodyDesc floor = plumb::body_desc(PLUMB_STATIC);
    floor.shape = add_box(*world, {50, 0.5, 50});
    floor.pose.position = {0, -0.5, 0};
    floor.material.friction = 0.4;
    add_body(*world, floor);
    PlumbBodyDesc cube = floor;
    cube.motion = PLUMB_DYNAMIC;
    cube.shape = add_box(*world, {0.5, 0.5, 0.5});
    cube.pose.position = {0, 0.5, 0};
    cube.linear_velocity = {3 * std::sqrt(0.5), 0, 3 * std::sqrt(0.5)};
    const PlumbBody body = add_body(*world, cube);
    for (int i = 0; i < 240; ++i) advance(*world);
    const auto pose = read_row<7>(*world, PLUMB_FIELD_POSE, body);
    return std::hypot(pose[0], pose[2]);
  };
  const double of_coulomb = 9 / (2 * 0.4 * 9.81);
  EXPECT_NEAR(way("sliding"), of_coulomb, 0.02);
  EXPECT_NEAR(way("normal"), of_coulomb / std::sqrt(2), 0.02);
}

std::unique_ptr<plumb::IPhysicsWorld> cube_on_floor(double overlap, std::vector<PlumbSetting> settings,
                                                    PlumbBody& cube) {
  auto world = make_world(kNeeds | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES, std::move(settings));
  add_body(*world, frictionless(PLUMB_STATIC, add_box(*world, {50, 0.5, 50}), {0, -0.5, 0}));
  cube = add_body(*world, frictionless(PLUMB_DYNAMIC, add_box(*world, {0.5, 0.5, 0.5}), {0, 0.5 - overlap, 0}));
  return world;
}

/// ODE tells eight points of two cubes of which one is turned by an eighth; of these four carry it.
TEST(Dart, FourPointsCarryACube) {
  const auto world = make_world(kNeeds | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES);
  const PlumbShape shape = add_box(*world, {0.5, 0.5, 0.5});
  add_body(*world, frictionless(PLUMB_STATIC, shape, {0, -0.5, 0}));
  PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, shape, {0, 0.4999, 0});
  desc.pose.orientation = {0, std::sin(std::numbers::pi / 8), 0, std::cos(std::numbers::pi / 8)};
  const PlumbBody cube = add_body(*world, desc);
  EXPECT_EQ(advance(*world).contacts, 4u);
  for (int i = 0; i < 60; ++i) advance(*world);
  double all = 0;
  for (const PlumbContact& contact : world->contacts()) all += contact.normal_impulse;
  EXPECT_NEAR(all, 1000 * 9.81 / 60, 0.2) << "the weight of a ton for a sixtieth of a second";
  EXPECT_NEAR(read_row<7>(*world, PLUMB_FIELD_POSE, cube)[1], 0.5, 1e-4);
}

/// Nothing moves a door along its axis: a wall above it pushes it neither there nor away.
TEST(Dart, WhatCannotMoveIsNotPushed) {
  const auto world = make_world(kNeeds | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES);
  add_body(*world, frictionless(PLUMB_STATIC, add_box(*world, {5, 0.5, 5}), {0, 0.95, 0}));
  PlumbJointDesc hinge = plumb::joint_desc(PLUMB_JOINT_HINGE);
  hinge.body_b = add_body(*world, frictionless(PLUMB_DYNAMIC, add_box(*world, {0.5, 0.5, 0.1}), {0, 0, 0}));
  hinge.frame_a.orientation = hinge.frame_b.orientation = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};  // x to y
  PlumbJoint id = 0;
  plumb::check(*world, world->joints()->create_joints({&hinge, 1}, {&id, 1}));
  for (int i = 0; i < 60; ++i) advance(*world);
  ASSERT_FALSE(world->contacts().empty());
  for (const PlumbContact& contact : world->contacts()) EXPECT_LT(contact.normal_impulse, 1);
  EXPECT_NEAR(read_row<6>(*world, PLUMB_FIELD_VELOCITY, hinge.body_b)[4], 0, 1e-6);
}

/// As the note of the capability has it; a body that moves is seen where it is now.
TEST(Dart, RaysFromWithinSeeTheFarSide) {
  const auto world = make_world(kNeeds | PLUMB_NEED_QUERIES);
  PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_box(*world, {0.5, 0.5, 0.5}), {0, 0, 0});
  desc.linear_velocity = {1, 0, 0};
  desc.gravity_scale = 0;
  const PlumbBody body = add_body(*world, desc);
  for (int i = 0; i < 6; ++i) advance(*world);
  const PlumbRay ray{{0, 0, 0}, {2, 0, 0}, {1, ~0u, 0, 0}};
  const plumb::Hits answer = world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
  ASSERT_EQ(answer.hits.size(), 1u);
  EXPECT_EQ(answer.hits[0].body, body);
  EXPECT_NEAR(answer.hits[0].fraction, 0.6 / 2, 1e-9);
  EXPECT_NEAR(answer.hits[0].position.x, 0.6, 1e-9);
  EXPECT_NEAR(answer.hits[0].normal.x, -1, 1e-9);
}

double height_after_a_second(std::vector<PlumbSetting> settings) {
  PlumbBody cube = 0;
  const auto world = cube_on_floor(0.1, std::move(settings), cube);
  for (int i = 0; i < 60; ++i) advance(*world);
  return read_row<7>(*world, PLUMB_FIELD_POSE, cube)[1];
}

TEST(Dart, SettingsReachTheContacts) {
  EXPECT_NEAR(height_after_a_second({number_setting("contact_error_speed", 0.001)}), 0.401, 1e-4)
      << "at a millimetre a second, as DART itself has it";
  EXPECT_NEAR(height_after_a_second({number_setting("contact_error_speed", 0.05)}), 0.45, 1e-3);
  EXPECT_NEAR(height_after_a_second({number_setting("contact_error_allowance", 0.1)}), 0.4, 1e-4);
  EXPECT_NEAR(height_after_a_second({number_setting("contact_error_reduction", 0)}), 0.4, 1e-4);
}

double rebound(std::vector<PlumbSetting> settings) {
  const auto world = make_world(kNeeds | PLUMB_NEED_RESTITUTION, std::move(settings));
  add_body(*world, frictionless(PLUMB_STATIC, add_box(*world, {50, 0.5, 50}), {0, -0.5, 0}));
  PlumbBodyDesc ball = frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 0.55, 0});
  ball.material.restitution = 0.5;
  const PlumbBody body = add_body(*world, ball);
  double fastest = 0;
  for (int i = 0; i < 30; ++i) {
    advance(*world);
    fastest = std::max(fastest, read_row<6>(*world, PLUMB_FIELD_VELOCITY, body)[1]);
  }
  return fastest;
}

TEST(Dart, SlowReboundsAreNone) {
  EXPECT_GT(rebound({}), 0.3) << "it falls at .99 m/s and has lost up to .16 when it is looked at";
  EXPECT_LT(rebound({number_setting("bounce_speed", 1)}), 0.15);
}

/// Of a method that stops after one round a tower knows.
TEST(Dart, TheSolverIsTheOneThatWasChosen) {
  const auto top = [](std::vector<PlumbSetting> settings) {
    PlumbScene scene(tower(5), kNeeds, std::move(settings));
    for (int i = 0; i < 60; ++i) advance(*scene.world);
    return read_row<7>(*scene.world, PLUMB_FIELD_POSE, scene.bodies.back())[1];
  };
  EXPECT_NEAR(top({}), 4.5, 0.001);
  EXPECT_LT(top({word_setting("solver", "pgs"), number_setting("iterations", 1, PLUMB_SETTING_INT)}), 4.45);
}

}  // namespace
