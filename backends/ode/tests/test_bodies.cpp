// Bodies: frames and centres of mass, forces, damping, locks, kinematic ones, particles, sleep.
#include <gtest/gtest.h>

#include <cmath>

#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

constexpr PlumbNeeds needs = usual_needs | PLUMB_NEED_FORCES | PLUMB_NEED_DAMPING | PLUMB_NEED_AXIS_LOCKS |
                             PLUMB_NEED_KINEMATIC | PLUMB_NEED_CONTACTS | PLUMB_NEED_RESTITUTION;
const PlumbVec3 still{0, 0, 0};

TestWorld weightless(PlumbNeeds more = 0, std::vector<PlumbSetting> settings = {}) {
  TestWorld world(needs | more, std::move(settings));
  check(*world, world->set_gravity(still));
  return world;
}

/// 2 kg, centre of mass off the frame, a full inertia tensor.
PlumbBodyDesc lopsided(PlumbShape shape) {
  PlumbBodyDesc desc = body_desc();
  desc.shape = shape;
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = 2;
  desc.centre_of_mass = {.3, -.2, .1};
  desc.inertia = {1, 2, 2.5};
  desc.inertia_orientation = {0, 0, std::sin(.4), std::cos(.4)};
  return desc;
}

TEST(Bodies, PoseIsOfTheFrameAndVelocityOfTheCentreOfMass) {
  const TestWorld world = weightless();
  PlumbBodyDesc desc = lopsided(world.box(.5, .5, .5));
  desc.pose = {{1, 2, 3}, {0, std::sin(.5), 0, std::cos(.5)}};
  const PlumbBody body = world.body(desc);
  const auto pose = world.row(body, PLUMB_FIELD_POSE);
  EXPECT_NEAR(pose[0], 1, 1e-14);
  EXPECT_NEAR(pose[1], 2, 1e-14);
  EXPECT_NEAR(pose[2], 3, 1e-14);
  EXPECT_NEAR(pose[4], std::sin(.5), 1e-14);
  // An impulse through the centre of mass turns nothing, one beside it does by I^-1 (r x J).
  world.write(body, PLUMB_FIELD_IMPULSE, {4, 0, 0});
  auto v = world.row(body, PLUMB_FIELD_VELOCITY);
  EXPECT_NEAR(v[0], 2, 1e-14);
  EXPECT_NEAR(std::hypot(v[3], v[4], v[5]), 0, 1e-14);
}

TEST(Bodies, ImpulseAtAPointTurnsByTheFullTensor) {
  const TestWorld world = weightless();
  const PlumbBody body = world.body(lopsided(world.box(.5, .5, .5)));
  world.write(body, PLUMB_FIELD_IMPULSE_AT_POINT, {0, 0, 1, .3 + 1, -.2, .1});  // r = x, J = z: r x J = -y
  // Principal axes turned by .8 rad about z: I^-1 = R diag(1, .5, .4) R^T.
  const double c = std::cos(.8), s = std::sin(.8);
  const auto v = world.row(body, PLUMB_FIELD_VELOCITY);
  EXPECT_NEAR(v[2], .5, 1e-14);
  EXPECT_NEAR(v[3], -c * s * (1 - .5), 1e-12);
  EXPECT_NEAR(v[4], -(s * s * 1 + c * c * .5), 1e-12);
  EXPECT_NEAR(v[5], 0, 1e-12);
}

TEST(Bodies, ForcesActOnceWhateverTheSubsteps) {
  for (const double substeps : {1.0, 4.0}) {
    const TestWorld world = weightless(0, {setting("substeps", substeps, PLUMB_SETTING_INT)});
    const PlumbBody body = world.dynamic(world.sphere(.5), {0, 0, 0});
    const double mass = world.row(body, PLUMB_FIELD_MASS)[0];
    world.write(body, PLUMB_FIELD_FORCE, {mass * 60, 0, 0});
    world.step();
    EXPECT_NEAR(world.velocity(body).x, 1, 1e-12);
    world.step();
    EXPECT_NEAR(world.velocity(body).x, 1, 1e-12);
  }
}

TEST(Bodies, DampingIsExponential) {
  const TestWorld world = weightless();
  PlumbBodyDesc desc = body_desc();
  desc.shape = world.sphere(.5);
  desc.linear_velocity = {3, 0, 0};
  desc.angular_velocity = {0, 2, 0};
  desc.linear_damping = .5;
  desc.angular_damping = .25;
  const PlumbBody body = world.body(desc);
  world.step(120);
  const auto v = world.row(body, PLUMB_FIELD_VELOCITY);
  EXPECT_NEAR(v[0], 3 * std::exp(-1), 1e-12);
  EXPECT_NEAR(v[4], 2 * std::exp(-.5), 1e-12);
  world.step(60, 1.0 / 30);  // another step length
  EXPECT_NEAR(world.velocity(body).x, 3 * std::exp(-2), 1e-12);
}

TEST(Bodies, GravityScaleScales) {
  const TestWorld world(needs);
  for (const double scale : {0.0, 1.0, -.5, 2.0}) {
    PlumbBodyDesc desc = body_desc();
    desc.gravity_scale = scale;
    desc.shape = world.sphere(.1);
    desc.pose.position = {10 * scale, 0, 0};
    const PlumbBody body = world.body(desc);
    world.step();
    EXPECT_NEAR(world.velocity(body).y, -9.81 * scale * dt, 1e-12);
  }
}

TEST(Bodies, LockedAxesDoNotMoveEvenWhenPushed) {
  const TestWorld world(needs);
  world.fixed(world.box(10, 1, 10), {0, -1, 0});
  PlumbBodyDesc desc = body_desc();
  desc.shape = world.box(.5, .5, .5);
  desc.pose = {{.1, .8, .2}, {0, 0, std::sin(.2), std::cos(.2)}};
  desc.linear_velocity = {1, 0, 1};
  desc.locks = PLUMB_LOCK_LINEAR_Z | PLUMB_LOCK_ANGULAR_X | PLUMB_LOCK_ANGULAR_Y;
  const PlumbBody body = world.body(desc);
  for (int i = 0; i < 120; ++i) {
    world.write(body, PLUMB_FIELD_FORCE, {0, 0, 5000});
    world.write(body, PLUMB_FIELD_TORQUE, {500, 500, 0});
    world.step();
    const auto v = world.row(body, PLUMB_FIELD_VELOCITY);
    ASSERT_EQ(world.position(body).z, .2);
    ASSERT_EQ(v[2], 0);
    ASSERT_EQ(v[3], 0);
    ASSERT_EQ(v[4], 0);
  }
  EXPECT_NEAR(world.position(body).y, .5, .01);  // fell over its edge: free in the plane
}

TEST(Bodies, ParticlesDoNotTurn) {
  const TestWorld world(needs);
  world.fixed(world.box(10, 1, 10), {0, -1, 0});
  PlumbBodyDesc desc = body_desc();
  desc.shape = world.box(.5, .5, .5);
  desc.flags = PLUMB_BODY_NO_ROTATION;
  desc.pose = {{0, .9, 0}, {0, 0, std::sin(.3), std::cos(.3)}};
  desc.angular_velocity = {1, 2, 3};
  const PlumbBody body = world.body(desc);
  world.step(120);
  const auto pose = world.row(body, PLUMB_FIELD_POSE), v = world.row(body, PLUMB_FIELD_VELOCITY);
  EXPECT_NEAR(pose[5], std::sin(.3), 1e-12);
  EXPECT_EQ(v[3], 1);
  EXPECT_EQ(v[5], 3);
  EXPECT_LT(std::abs(v[1]), 1e-3);
}

TEST(Bodies, KinematicReachesItsTargetInOneStepAndThenRests) {
  const TestWorld world(needs);
  PlumbBodyDesc desc = body_desc(PLUMB_KINEMATIC);
  desc.shape = world.box(1, .5, 1);
  const PlumbBody lift = world.body(desc);
  const PlumbBody load = world.dynamic(world.box(.25, .25, .25), {0, .75, 0});
  world.step(30);
  const double turned = .1;
  world.write(lift, PLUMB_FIELD_KINEMATIC_TARGET, {.5 / 60, .02, 0, 0, std::sin(turned), 0, std::cos(turned)});
  world.step();
  const auto pose = world.row(lift, PLUMB_FIELD_POSE), v = world.row(lift, PLUMB_FIELD_VELOCITY);
  EXPECT_EQ(pose[0], .5 / 60);
  EXPECT_EQ(pose[1], .02);
  EXPECT_EQ(pose[4], std::sin(turned));
  EXPECT_NEAR(v[0], .5, 1e-12);
  EXPECT_NEAR(v[4], 2 * turned * 60, 1e-9);
  EXPECT_GT(world.velocity(load).y, .5);  // it carries what lies on it
  world.step();
  EXPECT_EQ(world.row(lift, PLUMB_FIELD_POSE), pose);
  EXPECT_EQ(world.velocity(lift).x, 0);
}

TEST(Bodies, SleepWakeAndTell) {
  const TestWorld world(needs | PLUMB_NEED_SLEEPING | PLUMB_NEED_EVENTS);
  const PlumbBody ground = world.fixed(world.box(10, 1, 10), {0, -1, 0});
  const PlumbBody a = world.dynamic(world.box(.5, .5, .5), {0, .5, 0}),
                  b = world.dynamic(world.box(.5, .5, .5), {3, .5, 0});
  bool slept = false;
  for (int i = 0; i < 600 && !slept; ++i) {
    const PlumbStepReport report = world.step();
    for (const PlumbEvent& event : world->events())
      slept = slept || (event.type == PLUMB_EVENT_SLEEP && event.body_a == a);
    if (slept) {
      EXPECT_LT(report.awake, 2u);
    }
  }
  ASSERT_TRUE(slept);
  EXPECT_EQ(world.row(a, PLUMB_FIELD_AWAKE)[0], 0);
  world.step(60);
  for (const PlumbEvent& event : world->events())
    EXPECT_NE(event.type, PLUMB_EVENT_CONTACT_END);  // asleep is still touching
  world.write(a, PLUMB_FIELD_IMPULSE, {0, 2000, 0});
  world.step();
  ASSERT_FALSE(world->events().empty());
  EXPECT_EQ(world->events().back().type, PLUMB_EVENT_WAKE);
  world.step(300);
  check(*world, world->destroy_bodies({&ground, 1}));
  world.step(2);
  EXPECT_LT(world.velocity(b).y, 0);  // the ground has gone
}

TEST(Bodies, StaticsCanBeTeleported) {
  const TestWorld world(needs);
  const PlumbBody ground = world.fixed(world.box(10, 1, 10), {0, -1, 0});
  const PlumbBody box = world.dynamic(world.box(.5, .5, .5), {0, .5, 0});
  world.step(10);
  world.write(ground, PLUMB_FIELD_POSE, {0, -3, 0, 0, 0, 0, 1});
  world.step(10);
  EXPECT_LT(world.velocity(box).y, -1);
  EXPECT_EQ(world.position(ground).y, -3);
}

}  // namespace
}  // namespace plumb::ode_test
