// Energy and momentum against figures of the catalogue and against motions that conserve them.
#include "referee/mechanics.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shapes.hpp"

namespace plumb::referee::testing {
namespace {

BodyState a3_box() {  // half (.5, .25, .1), 100 kg
  PlumbBodyDesc desc = body_desc();
  desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
  desc.mass = 100;
  return {mass_of(desc, box(0.5, 0.25, 0.1).get()), {}, Vec3::Zero(), Vec3::Zero()};
}

TEST(Mechanics, SpinningBoxOfTheCatalogue) {  // A5b: omega (.5, 5, 0)
  BodyState body = a3_box();
  body.angular = {0.5, 5, 0};
  EXPECT_NEAR(energy(std::span(&body, 1), {0, -9.81, 0}).rotational, 108.63541667, 1e-8);
  EXPECT_NEAR(angular_momentum(std::span(&body, 1)).norm(), 43.35017701, 1e-8);
  // Turning body and spin together changes neither number.
  const Pose turn = turned(77, {1, 2, 3});
  body.pose = turn;
  body.angular = turn.rotation * body.angular;
  EXPECT_NEAR(energy(std::span(&body, 1), {0, -9.81, 0}).rotational, 108.63541667, 1e-8);
  EXPECT_NEAR(angular_momentum(std::span(&body, 1)).norm(), 43.35017701, 1e-8);
}

TEST(Mechanics, PotentialIsThatOfTheCentreOfMass) {
  BodyState body = a3_box();
  body.mass.centre = {0, 1, 0};
  body.pose = turned(90, Vec3::UnitZ(), {5, 2, 0});  // the centre of mass is 1 m to the left of the body's origin
  body.linear = {3, 4, 0};
  const Energy e = energy(std::span(&body, 1), {0, -9.81, 0}, {0, 0.5, 0}, 7);
  EXPECT_NEAR(body.centre().x(), 4, 1e-12);
  EXPECT_NEAR(e.potential, 100 * 9.81 * 1.5, 1e-9);
  EXPECT_NEAR(e.linear, 1250, 1e-9);
  EXPECT_NEAR(e.total(), 1250 + 100 * 9.81 * 1.5 + 7, 1e-9);
}

TEST(Mechanics, StaticBodiesCarryNothing) {
  BodyState wall;
  wall.linear = {100, 0, 0};
  wall.pose.position = {0, std::nan(""), 0};
  EXPECT_EQ(energy(std::span(&wall, 1), {0, -9.81, 0}).total(), 0);
  EXPECT_EQ(linear_momentum(std::span(&wall, 1)).norm(), 0);
  EXPECT_EQ(angular_momentum(std::span(&wall, 1)).norm(), 0);
}

TEST(Mechanics, AngularMomentumAboutAnotherPoint) {
  Random random(51);
  std::vector<BodyState> bodies;
  for (int i = 0; i < 20; ++i) {
    BodyState body = a3_box();
    body.pose = random.pose(10);
    body.linear = random.vector(5);
    body.angular = random.vector(5);
    bodies.push_back(body);
  }
  const Vec3 point = {3, -2, 7};  // L about a point = L - point x P
  const Vec3 expected = angular_momentum(bodies) - point.cross(linear_momentum(bodies));
  EXPECT_LE((angular_momentum(bodies, point) - expected).norm(), 1e-9);
  EXPECT_GT(sum_of_momenta(bodies), linear_momentum(bodies).norm());
  EXPECT_EQ(total_mass(bodies), 2000);
}

TEST(Mechanics, VelocityAtAPoint) {
  BodyState body = a3_box();
  body.linear = {1, 0, 0};
  body.angular = {0, 0, 2};
  EXPECT_LE((body.velocity_at({0, -0.5, 0}) - Vec3(2, 0, 0)).norm(), 1e-15);  // rolls over: 1 + 2 * .5
}

TEST(EnergyAccount, InjectionAndDriftAreKeptApart) {
  EnergyAccount account;
  for (const double e : {10.0, 12.0, 9.0, 10.0}) account.add(e);
  EXPECT_EQ(account.injected(), 3);
  EXPECT_EQ(account.lost(), 3);
  EXPECT_EQ(account.drift(), 0);
  EXPECT_EQ(account.largest_rise(), 2);
  account.add(15, 5);  // what the host put in is no fault
  EXPECT_EQ(account.injected(), 3);
  EXPECT_EQ(account.drift(), 0);
}

TEST(MomentumBalance, GravityAndImpulsesAccountForTheChange) {
  Random random(52);
  const Vec3 gravity = {0, -9.81, 0};
  const double dt = 0.01;
  std::vector<BodyState> before, after;
  std::vector<ExternalImpulse> impulses;
  for (int i = 0; i < 10; ++i) {
    BodyState body = a3_box();
    body.pose = random.pose(3);
    body.linear = random.vector(2);
    body.angular = random.vector(2);
    before.push_back(body);
    const ExternalImpulse push = {random.vector(30), body.centre() + random.vector(0.5)};
    impulses.push_back(push);
    body.linear += dt * gravity + push.impulse / body.mass.mass;  // velocities only: poses as they were
    body.angular += body.inertia().inverse() * (push.point - body.centre()).cross(push.impulse);
    after.push_back(body);
  }
  const MomentumBalance balance = momentum_balance(before, after, gravity, dt, impulses, {1, 2, 3});
  EXPECT_LE(balance.linear.norm(), 1e-10);
  EXPECT_LE(balance.angular.norm(), 1e-9);
  after[3].linear.x() += 0.01;
  EXPECT_NEAR(momentum_balance(before, after, gravity, dt, impulses).linear.x(), 1, 1e-9);
}

}  // namespace
}  // namespace plumb::referee::testing
