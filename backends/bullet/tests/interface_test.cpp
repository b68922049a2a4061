// What the interface asks of any backend and Bullet does not do by itself: the adapter's own doing.
#include <gtest/gtest.h>

#include <cmath>

#include "plumb_scene.hpp"

namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                              PLUMB_NEED_RESTITUTION | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES |
                              PLUMB_NEED_EVENTS | PLUMB_NEED_KINEMATIC | PLUMB_NEED_FORCES | PLUMB_NEED_DAMPING |
                              PLUMB_NEED_AXIS_LOCKS;

PlumbBody add_floor(plumb::IPhysicsWorld& world) {
  PlumbBodyDesc floor = plumb::body_desc(PLUMB_STATIC);
  floor.shape = scenes::add_box(world, {50, 5, 50});
  floor.pose.position = {0, -5, 0};
  return scenes::add_body(world, floor);
}

PlumbBody add_cube(plumb::IPhysicsWorld& world, PlumbVec3 at) {
  PlumbBodyDesc cube = plumb::body_desc();
  cube.shape = scenes::add_box(world, {0.5, 0.5, 0.5});
  cube.pose.position = at;
  return scenes::add_body(world, cube);
}

/// The impulses on the ground carry the weight, however many sub-steps make a step.
TEST(Contacts, ImpulsesCarryTheWeight) {
  for (const double substeps : {1.0, 4.0}) {
    auto world = scenes::make_world(kNeeds, {scenes::number_setting("substeps", substeps, PLUMB_SETTING_INT)});
    const PlumbBody floor = add_floor(*world);
    add_cube(*world, {0, 0.5, 0});
    for (int i = 0; i < 60; ++i) scenes::advance(*world);
    double up = 0;
    for (const PlumbContact& contact : world->contacts()) {
      EXPECT_NEAR(std::abs(contact.normal.y), 1, 1e-3);
      up += contact.normal_impulse * contact.normal.y * (contact.body_a == floor ? 1 : -1);
    }
    EXPECT_NEAR(up, 1000 * 9.81 / 60, 2) << substeps << " sub-steps";
  }
}

TEST(Contacts, KeepTheirFeatureFromStepToStep) {
  auto world = scenes::make_world(kNeeds);
  add_floor(*world);
  add_cube(*world, {0, 0.5, 0});
  for (int i = 0; i < 60; ++i) scenes::advance(*world);
  const auto features = [&] {
    std::vector<std::uint64_t> all;
    for (const PlumbContact& contact : world->contacts()) all.push_back(contact.feature);
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto before = features();
  scenes::advance(*world);
  EXPECT_EQ(before.size(), 4u);
  EXPECT_EQ(before, features());
}

/// Bullet keeps what it foresaw for a swept body until the next step, beside the pairs from which a body is taken.
TEST(Contacts, ForeseenOnesGoWithTheirBodies) {
  auto world = scenes::make_world(kNeeds | PLUMB_NEED_CCD | PLUMB_NEED_SLEEPING);
  plumb::check(*world, world->set_gravity({0, 0, 0}));
  const PlumbBody wall =
      scenes::add_body(*world, scenes::frictionless(PLUMB_STATIC, scenes::add_box(*world, {0.05, 2, 2}), {0, 0, 0}));
  PlumbBodyDesc desc = scenes::frictionless(PLUMB_DYNAMIC, scenes::add_sphere(*world, 0.1), {-2, 0, 0});
  desc.linear_velocity = {300, 0, 0};
  desc.flags = PLUMB_BODY_CCD;
  const PlumbBody bullet = scenes::add_body(*world, desc);
  scenes::advance(*world);
  plumb::check(*world, world->destroy_bodies({&wall, 1}));
  EXPECT_EQ(world->contacts().size(), 0u);
  plumb::check(*world, world->destroy_bodies({&bullet, 1}));
  scenes::advance(*world);
}

TEST(Damping, IsExactForAnyCoefficient) {
  for (const double c : {0.1, 0.5, 3.0, 25.0}) {
    auto world = scenes::make_world(kNeeds);
    plumb::check(*world, world->set_gravity({0, 0, 0}));
    PlumbBodyDesc desc = scenes::frictionless(PLUMB_DYNAMIC, scenes::add_sphere(*world, 0.5), {0, 0, 0});
    desc.linear_velocity = {10, 0, 0};
    desc.angular_velocity = {0, 4, 0};
    desc.linear_damping = c;
    desc.angular_damping = c / 2;
    const PlumbBody body = scenes::add_body(*world, desc);
    for (int i = 0; i < 60; ++i) scenes::advance(*world);
    const auto velocity = scenes::read_row<6>(*world, PLUMB_FIELD_VELOCITY, body);
    EXPECT_NEAR(velocity[0] / (10 * std::exp(-c)), 1, 1e-4) << c;
    EXPECT_NEAR(velocity[4] / (4 * std::exp(-c / 2)), 1, 1e-4) << c;
  }
}

TEST(Kinematic, ReachesItsTargetInTheNextStepWithAnyNumberOfSubSteps) {
  for (const double substeps : {1.0, 3.0}) {
    auto world = scenes::make_world(kNeeds, {scenes::number_setting("substeps", substeps, PLUMB_SETTING_INT)});
    PlumbBodyDesc desc = plumb::body_desc(PLUMB_KINEMATIC);
    desc.shape = scenes::add_box(*world, {1, 0.1, 1});
    const PlumbBody body = scenes::add_body(*world, desc);
    const double half = 0.05;
    scenes::write_row(*world, PLUMB_FIELD_KINEMATIC_TARGET, body,
                      std::array<double, 7>{0.1, 0.2, 0, 0, std::sin(half), 0, std::cos(half)});
    scenes::advance(*world, 0.1);
    const auto pose = scenes::read_row<7>(*world, PLUMB_FIELD_POSE, body);
    const auto velocity = scenes::read_row<6>(*world, PLUMB_FIELD_VELOCITY, body);
    EXPECT_NEAR(pose[0], 0.1, 1e-6);
    EXPECT_NEAR(pose[4], std::sin(half), 1e-6);
    EXPECT_NEAR(velocity[0], 1, 1e-3);
    EXPECT_NEAR(velocity[1], 2, 1e-3);
    EXPECT_NEAR(velocity[4], 1, 1e-3);
    scenes::advance(*world, 0.1);
    EXPECT_NEAR(scenes::read_row<7>(*world, PLUMB_FIELD_POSE, body)[0], 0.1, 1e-6);
  }
}

TEST(Kinematic, CarriesWhatStandsOnIt) {
  auto world = scenes::make_world(kNeeds);
  PlumbBodyDesc desc = plumb::body_desc(PLUMB_KINEMATIC);
  desc.shape = scenes::add_box(*world, {2, 0.1, 2});
  desc.linear_velocity = {0.5, 0, 0};
  const PlumbBody platform = scenes::add_body(*world, desc);
  const PlumbBody cube = add_cube(*world, {0, 0.6, 0});
  for (int i = 0; i < 120; ++i) scenes::advance(*world);
  EXPECT_NEAR(scenes::read_row<7>(*world, PLUMB_FIELD_POSE, platform)[0], 1, 1e-4);
  EXPECT_NEAR(scenes::read_row<6>(*world, PLUMB_FIELD_VELOCITY, cube)[0], 0.5, 0.01);
}

/// A centre of mass far from the origin and principal axes that are turned: a free body's centre moves in a line, and
/// the pose that comes out is that of the body's frame.
TEST(MassFrame, MayLieAnywhere) {
  auto world = scenes::make_world(kNeeds);
  plumb::check(*world, world->set_gravity({0, 0, 0}));
  PlumbBodyDesc desc = scenes::frictionless(PLUMB_DYNAMIC, scenes::add_box(*world, {0.5, 0.2, 0.1}), {1, 2, 3});
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = 2;
  desc.centre_of_mass = {0.3, 0.1, 0};
  desc.inertia = {1, 2, 2.5};
  desc.inertia_orientation = {0, 0, std::sin(0.3), std::cos(0.3)};
  desc.angular_velocity = {0, 0, 2};
  const PlumbBody body = scenes::add_body(*world, desc);
  const auto start = scenes::read_row<7>(*world, PLUMB_FIELD_POSE, body);
  EXPECT_NEAR(start[0], 1, 1e-6);
  EXPECT_NEAR(start[6], 1, 1e-6);
  for (int i = 0; i < 30; ++i) scenes::advance(*world);
  const auto pose = scenes::read_row<7>(*world, PLUMB_FIELD_POSE, body);
  const double angle = 2 * std::atan2(pose[5], pose[6]);
  EXPECT_NEAR(angle, 1, 1e-3);
  EXPECT_NEAR(pose[0] + 0.3 * std::cos(angle) - 0.1 * std::sin(angle), 1.3, 1e-3);
  EXPECT_NEAR(pose[1] + 0.3 * std::sin(angle) + 0.1 * std::cos(angle), 2.1, 1e-3);
}

TEST(AxisLocks, HoldAgainstTheGyroscopicTerm) {
  auto world = scenes::make_world(kNeeds | PLUMB_NEED_GYROSCOPIC);
  plumb::check(*world, world->set_gravity({0, 0, 0}));
  PlumbBodyDesc desc = scenes::frictionless(PLUMB_DYNAMIC, scenes::add_box(*world, {0.5, 0.25, 0.1}), {0, 0, 0});
  desc.pose.orientation = {std::sin(0.3), 0, 0, std::cos(0.3)};  // so that y is no principal axis
  desc.angular_velocity = {0, 5, 0};
  desc.locks = PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Z;
  const PlumbBody body = scenes::add_body(*world, desc);
  for (int i = 0; i < 120; ++i) scenes::advance(*world);
  const auto velocity = scenes::read_row<6>(*world, PLUMB_FIELD_VELOCITY, body);
  EXPECT_EQ(velocity[3], 0);
  EXPECT_EQ(velocity[5], 0);
  EXPECT_GT(std::abs(velocity[4]), 0.1);
}

TEST(Settings, AreInForceAtOnce) {
  auto world = scenes::make_world(kNeeds);
  add_floor(*world);
  add_cube(*world, {0, 0.5, 0});
  for (const char* solver : {"nncg", "mlcp_dantzig", "mlcp_lemke", "si"}) {
    plumb::check(*world, world->settings()->set_setting("solver", {PLUMB_SETTING_CHOICE, 0, 0, solver}));
    for (int i = 0; i < 20; ++i) EXPECT_EQ(scenes::advance(*world).nonfinite, 0u) << solver;
    PlumbSettingValue value{};
    plumb::check(*world, world->settings()->get_setting("solver", value));
    EXPECT_STREQ(value.choice, solver);
  }
}

TEST(Limits, NumbersThatBulletCannotHoldAreRefused) {
  auto world = scenes::make_world(kNeeds);
  PlumbShapeDesc desc = plumb::shape_desc(PLUMB_SPHERE);
  PlumbShape shape = 0;
  for (const double radius : {1e-200, 1e200}) {
    desc.radius = radius;
    EXPECT_EQ(world->create_shapes({&desc, 1}, {&shape, 1}), PLUMB_E_INVALID_ARGUMENT) << radius;
    EXPECT_NE(world->error_text(), "");
  }
}

/// A cast that goes on for longer than its steps last, a hair above a floor, tells nothing of who is far away.
TEST(TurningCasts, AlongAFloorDoNotMeetWhoIsFarAbove) {
  auto world = scenes::make_world(PLUMB_NEED_COLLISION | PLUMB_NEED_QUERIES);
  const PlumbShape slab = scenes::add_box(*world, {10, 0.5, 10}), cube = scenes::add_box(*world, {0.5, 0.5, 0.5});
  scenes::add_body(*world, scenes::frictionless(PLUMB_STATIC, slab, {0, -0.5, 0}));
  const PlumbBody far = scenes::add_body(*world, scenes::frictionless(PLUMB_STATIC, cube, {0, 4, 0}));
  const PlumbTurningCast slide = {cube, {{-4, 0.5 + 1.2e-4, 0}, {0, 0, 0, 1}}, {8, 0, 0}, {0, 0.5, 0}, {1, ~0U, 0, 0}};
  const plumb::Hits found = world->queries()->turning_casts(PLUMB_HIT_ALL, {&slide, 1});
  plumb::check(*world, found.result);
  for (const PlumbHit& hit : found.hits) EXPECT_NE(hit.body, far);
}

}  // namespace
