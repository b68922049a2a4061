// The laws of contact on hand-made contacts whose residuals are known.
#include "referee/contacts.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "shapes.hpp"

namespace plumb::referee::testing {
namespace {

// A 10 kg block on the ground, friction .5, carrying 2 N s.
class OneContact : public ::testing::Test {
 protected:
  OneContact() {
    PlumbBodyDesc desc = body_desc();
    desc.mass_mode = PLUMB_MASS_FROM_TOTAL;
    desc.mass = 10;
    block.mass = mass_of(desc, box(0.5, 0.5, 0.5).get());
    block.pose.position = {0, 0.5, 0};
    contact.normal = {0, 1, 0};
    contact.normal_impulse = 2;
  }
  ContactSample sample() { return {&contact, &ground, &block, 0.5}; }
  ContactQuality quality() {
    const ContactSample one = sample();
    return contact_quality(std::span(&one, 1), scale);
  }

  PlumbContact contact{};
  BodyState ground, block;
  Scale scale = scale_of(10, 10, 0.02, 0.1);  // W 2 N s, v0 1 m/s, L .1 m
};

TEST_F(OneContact, ScaleIsTheScenes) {
  EXPECT_EQ(scale.impulse, 2);
  EXPECT_EQ(scale.speed, 1);
}

TEST_F(OneContact, RestIsPerfect) {
  const ContactQuality q = quality();
  EXPECT_EQ(q.cone_max, 0);
  EXPECT_EQ(q.cone_distance_max, 0);
  EXPECT_EQ(q.signorini_speed_max, 0);
  EXPECT_EQ(q.signorini_gap_max, 0);
  EXPECT_EQ(q.complementarity_max, 0);
  EXPECT_TRUE(std::isnan(q.dissipation_mean));
}

TEST_F(OneContact, ConeViolation) {
  contact.tangent_impulse = {1.25, 0, 0};  // mu l_n is 1
  EXPECT_NEAR(quality().cone_max, 0.25, 1e-8);
  // The projection: l_n' = (mu t + n)/(1 + mu^2) = 2.1, t' = 1.05; distance sqrt(.1^2 + .2^2).
  EXPECT_NEAR(quality().cone_distance_max, std::hypot(0.1, 0.2) / 2, 1e-12);
}

TEST_F(OneContact, SlidingWithFullFrictionIsPerfect) {
  block.linear = {3, 0, 0};
  contact.tangent_impulse = {-1, 0, 0};
  EXPECT_NEAR(quality().dissipation_mean, 0, 1e-12);
  EXPECT_NEAR(quality().complementarity_max, 0, 1e-12);
  contact.tangent_impulse = {0, 0, 0};  // no friction work
  EXPECT_NEAR(quality().dissipation_mean, 1, 1e-12);
  EXPECT_NEAR(quality().complementarity_max, 2 * 0.5 * 3 / 2.0, 1e-12);
  contact.tangent_impulse = {1, 0, 0};  // drives
  EXPECT_NEAR(quality().dissipation_mean, 2, 1e-12);
}

TEST_F(OneContact, SpinAboutTheContactIsNoSlip) {
  block.angular = {0, 5, 0};
  EXPECT_NEAR(slip_of(sample()).tangent.norm(), 0, 1e-12);
  block.angular = {0, 0, -2};  // rolls towards +x: the bottom moves backwards
  EXPECT_NEAR(slip_of(sample()).tangent.x(), -1, 1e-12);
}

TEST_F(OneContact, Creep) {
  block.linear = {0.05, 0, 0};
  contact.tangent_impulse = {-0.5, 0, 0};  // half of what it may
  EXPECT_NEAR(quality().creep_max, 0.05, 1e-12);
}

TEST_F(OneContact, Signorini) {
  block.linear = {0, 0.25, 0};  // parts, but carries load
  contact.depth = -0.01;        // and does not touch
  EXPECT_NEAR(quality().signorini_speed_max, 0.25, 1e-12);
  EXPECT_NEAR(quality().signorini_gap_max, 0.1, 1e-12);
  contact.normal_impulse = -1;
  EXPECT_NEAR(quality().pull_max, 0.5, 1e-12);
}

TEST_F(OneContact, RestitutionExplainsParting) {
  block.linear = {0, 0.25, 0};
  ContactSample bounced = sample();
  bounced.restitution = 0.5;
  bounced.approach_speed = 0.5;
  EXPECT_NEAR(contact_quality(std::span(&bounced, 1), scale).signorini_speed_max, 0, 1e-12);
  EXPECT_NEAR(complementarity(bounced, scale), 0, 1e-12);
}

TEST_F(OneContact, UnknownImpulsesAreCountedOnly) {
  contact.normal_impulse = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(quality().without_impulse, 1u);
  EXPECT_EQ(quality().cone_max, 0);
  const ContactSample one = sample();
  EXPECT_TRUE(ground_impulses(std::span(&one, 1)).empty());
}

TEST_F(OneContact, GroundBalance) {
  const Vec3 gravity(0, -10, 0);
  ContactSample one = sample();
  EXPECT_NEAR(ground_balance(std::span(&one, 1), 10, gravity, 0.02), 0, 1e-12);
  contact.normal_impulse = 1.5;
  EXPECT_NEAR(ground_balance(std::span(&one, 1), 10, gravity, 0.02), 0.25, 1e-12);
  // The other way round: the ground is b, and the normal points into it.
  contact.normal_impulse = 2;
  contact.normal = {0, -1, 0};
  std::swap(one.a, one.b);
  EXPECT_NEAR(ground_balance(std::span(&one, 1), 10, gravity, 0.02), 0, 1e-12);
  EXPECT_NEAR(ground_impulses(std::span(&one, 1))[0].impulse.y(), 2, 1e-12);
}

TEST_F(OneContact, BodyBalance) {
  const Vec3 gravity(0, -10, 0);
  const ContactSample one = sample();
  const BodyState before = block;
  EXPECT_NEAR(body_balance(before, block, std::span(&one, 1), gravity, 0.02, scale), 0, 1e-12);
  contact.position = {0.1, 0, 0};  // off centre: it should have begun to turn
  EXPECT_NEAR(body_balance(before, block, std::span(&one, 1), gravity, 0.02, scale), 0.2 / 0.1 / 2, 1e-12);
  block.angular = block.mass.inertia.inverse() * Vec3(0, 0, 0.2);
  EXPECT_NEAR(body_balance(before, block, std::span(&one, 1), gravity, 0.02, scale), 0, 1e-12);
}

TEST(Cone, ProjectionIsTheNearestPointOfTheCone) {
  Random random(71);
  const Vec3 normal = Vec3(1, 2, 3).normalized();
  for (int i = 0; i < 200; ++i) {
    const double mu = random.in(0, 2);
    const Vec3 impulse = random.vector(1), projected = project_on_cone(impulse, normal, mu);
    const double along = projected.dot(normal);
    ASSERT_LE((projected - along * normal).norm(), mu * along + 1e-12);
    for (int k = 0; k < 200; ++k) {
      const Vec3 tangent = random.direction().cross(normal).normalized();
      const double load = random.in(0, 2);
      const Vec3 other = load * normal + random.in(0, 1) * mu * load * tangent;
      ASSERT_LE((impulse - projected).norm(), (impulse - other).norm() + 1e-12);
    }
  }
}

}  // namespace
}  // namespace plumb::referee::testing
