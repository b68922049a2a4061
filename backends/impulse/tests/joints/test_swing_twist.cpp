// Swing-twist joints: what hangs in a cone slides along it as the closed form says and comes to rest where it is
// lowest, and limbs stay within theirs, whatever they run into.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "plumb/backend/joint_coordinates.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

using Vector = Eigen::Vector3d;

constexpr PlumbNeeds kSwingNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS | PLUMB_NEED_GYROSCOPIC;
constexpr double kRodHalf = 0.5, kRodThick = 0.05, kDegree = std::numbers::pi / 180;

PlumbQuat plain(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

/// A rod with its end in a joint to the world, whose cone's axis is inclined by so much from straight down, about z.
struct ConeRod {
  ConeRod(PlumbNeeds needs, double inclined, double half_y, double half_z)
      : scene(engine(), needs, kDown, 1), axes(Eigen::AngleAxisd(inclined - std::numbers::pi / 2, Vector::UnitZ())) {
    scene.body.material.friction = 0;
    desc.frame_a.orientation = plain(axes);
    desc.frame_b.position = {-kRodHalf, 0, 0};
    desc.limits[4] = {-half_y, half_y, 1, 0};
    desc.limits[5] = {-half_z, half_z, 1, 0};
  }
  /// swing: seen from the cone's axis.
  void hang(const Vector& swing) {
    const Eigen::Quaterniond turn(axes * Eigen::AngleAxisd(swing.norm(), swing.normalized()));
    const Vector at = turn * Vector(kRodHalf, 0, 0);
    desc.body_b = rod = scene.add(scene.box({kRodHalf, kRodThick, kRodThick}), {at.x(), at.y(), at.z()}, plain(turn));
    joint = scene.join(desc);
  }
  void step(double dt) {
    PlumbStepReport report{};
    check(scene.world(), scene.world().step(dt));
    check(scene.world(), scene.world().wait(report));
  }
  Vector swing() {
    double row[6];
    check(scene.world(),
          scene.world().joints()->read_joints(PLUMB_JOINT_COORDINATES, {&joint, 1},
                                              Rows(reinterpret_cast<std::byte*>(row), 1, sizeof row, PLUMB_F64)));
    return {0, row[4], row[5]};
  }

  Scene scene;
  Eigen::Quaterniond axes;
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SWING_TWIST);
  PlumbBody rod = 0;
  PlumbJoint joint = 0;
};

/// A rod that its weight presses against a round cone slides along it as a pendulum about the cone's axis, of moment
/// I sin^2(half angle) and lever l sin(half angle): its period by the elliptic integral.
TEST(SwingTwist, WhatSlidesAlongAConeIsAPendulum) {
  constexpr double kInclined = 70 * kDegree, kHalf = 40 * kDegree, kAmplitude = 55 * kDegree;
  constexpr double kMoment = (4 * kRodHalf * kRodHalf + 4 * kRodThick * kRodThick) / 12 + kRodHalf * kRodHalf;
  const double rate = std::sqrt(9.81 * kRodHalf * std::sin(kInclined) / (kMoment * std::sin(kHalf)));
  const double period = 4 * std::comp_ellint_1(std::sin(kAmplitude / 2)) / rate;
  for (const double hertz : {60, 240}) {
    SCOPED_TRACE(hertz);
    ConeRod it(kSwingNeeds, kInclined, kHalf, kHalf);
    // About z by a negative angle is down; from there a parallel is counted.
    it.hang(kHalf * Vector(0, -std::sin(kAmplitude), -std::cos(kAmplitude)));
    double before = -kAmplitude, last = 0;
    int passages = 0;
    for (int i = 1; passages < 9 && i < 20 * hertz; ++i) {
      it.step(1 / hertz);
      const Vector swing = it.swing();
      EXPECT_NEAR(swing.norm(), kHalf, 2e-3) << i;
      const double now = std::atan2(swing.y(), -swing.z());
      if (before * now < 0) {
        last = (i - 1 + before / (before - now)) / hertz;
        ++passages;
      }
      before = now;
    }
    ASSERT_EQ(passages, 9);
    EXPECT_NEAR(last / (8.5 / 2), period, 0.004 * period);
  }
}

/// In an elliptic cone, askew and damped, it comes to rest where that is lowest, as brute force finds.
TEST(SwingTwist, ARodRestsWhereAnEllipticConeIsLowest) {
  for (const double about : {0.3, 1.1, 2.0}) {
    SCOPED_TRACE(about);
    constexpr double kHalfY = 0.35, kHalfZ = 0.9;
    ConeRod it(kSwingNeeds | PLUMB_NEED_DAMPING, 80 * kDegree, kHalfY, kHalfZ);
    it.axes = it.axes * Eigen::AngleAxisd(about, Vector::UnitX());
    it.desc.frame_a.orientation = plain(it.axes);
    it.scene.body.angular_damping = 2;
    it.hang({0, 0.01, 0});
    for (int i = 0; i < 3600; ++i) it.step(1.0 / 60);
    double lowest = 2;
    Vector there = Vector::Zero();
    for (int k = 0; k < 36000; ++k) {
      const double way = k * std::numbers::pi / 18000;
      const Vector swing(0, kHalfY * std::cos(way), kHalfZ * std::sin(way));
      const double height = (it.axes * (Eigen::AngleAxisd(swing.norm(), swing.normalized()) * Vector::UnitX())).y();
      if (height < lowest) {
        lowest = height;
        there = swing;
      }
    }
    EXPECT_LT((it.swing() - there).norm(), 0.01) << it.swing().transpose() << " is not " << there.transpose();
  }
}

/// Chains of limbs fall on each other and on a post: none leaves its cone or its twist, and all come to rest.
TEST(SwingTwist, LimbsThatFallInAHeapStayInTheirCones) {
  for (const double hertz : {30, 60, 240}) {
    SCOPED_TRACE(hertz);
    Scene scene(engine(), kSwingNeeds | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION, kDown, 1);
    scene.ground();
    scene.add_static(scene.capsule(0.2, 0.5), {0, 0.5, 0});
    const PlumbShape limb = scene.capsule(0.08, 0.15);
    std::vector<PlumbJoint> joints;
    std::vector<PlumbBody> limbs;
    const Eigen::Quaterniond along(Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitZ()));  // x is the limb's y
    for (int chain = 0; chain < 6; ++chain)
      for (int i = 0; i < 8; ++i) {
        const PlumbBody before = i == 0 ? 0 : limbs.back();
        limbs.push_back(scene.add(limb, {0.4 * chain - 1, 1.5 + 0.46 * i, 0.05 * chain}));
        if (before == 0) continue;
        PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SWING_TWIST);
        desc.body_a = before;
        desc.body_b = limbs.back();
        desc.frame_a = {{0, 0.23, 0}, plain(along)};
        desc.frame_b = {{0, -0.23, 0}, plain(along)};
        desc.limits[3] = {-0.3, 0.5, 1, 0};
        desc.limits[4] = {-0.3 - 0.1 * chain, 0.3 + 0.1 * chain, 1, 0};
        desc.limits[5] = {-0.9, 0.9, 1, 0};
        joints.push_back(scene.join(desc));
      }
    std::vector<double> rows(6 * joints.size());
    double beyond = 0, twisted = 0, gap = 0;
    for (int i = 0; i < 6 * hertz; ++i) {
      PlumbStepReport report{};
      check(scene.world(), scene.world().step(1 / hertz));
      check(scene.world(), scene.world().wait(report));
      check(scene.world(), scene.world().joints()->read_joints(
                               PLUMB_JOINT_COORDINATES, joints,
                               Rows(reinterpret_cast<std::byte*>(rows.data()), joints.size(), 48, PLUMB_F64)));
      for (std::size_t k = 0; k < joints.size(); ++k) {
        const double* row = &rows[6 * k];
        const double half = 0.3 + 0.1 * static_cast<double>(k / 7);
        const double out = std::hypot(row[4] / half, row[5] / 0.9);
        beyond = std::max(beyond, std::hypot(row[4], row[5]) * (1 - 1 / std::max(out, 1.0)));
        twisted = std::max({twisted, -0.3 - row[3], row[3] - 0.5});
        gap = std::max(gap, std::hypot(row[0], row[1], row[2]));
      }
    }
    const double blow = hertz < 60 ? 0.2 : 0.06;  // may push a limb as far out, for a step or two
    EXPECT_LT(beyond, blow);
    EXPECT_LT(twisted, blow);
    EXPECT_LT(gap, 0.005);
    double fastest = 0;
    for (const PlumbBody body : limbs) {
      const std::vector<double> v = scene.velocity(body);
      fastest = std::max(fastest, std::hypot(v[0], v[1], v[2]));
    }
    EXPECT_LT(fastest, 0.05);
  }
}

/// A chain of limbs that whirls through the full turn, until it has run against all its cones, gains nothing on the
/// way.
TEST(SwingTwist, LimbsThatWhirlGainNoEnergyFromTheirCones) {
  for (const double hertz : {30, 60, 240}) {
    SCOPED_TRACE(hertz);
    constexpr double kSpeed = 30, kArm = 0.28;  // rad/s, m
    Scene scene(engine(), kSwingNeeds, kDown, 1);
    scene.body.material.friction = 0;
    const PlumbShape limb = scene.capsule(0.08, 0.2);
    const Eigen::Quaterniond along(Eigen::AngleAxisd(std::numbers::pi / 2, Vector::UnitZ()));
    std::vector<PlumbBody> limbs;
    for (int i = 0; i < 4; ++i) {
      const double below = kArm * (2 * i + 1);
      scene.body.angular_velocity = {0, 0.5 * kSpeed, kSpeed};
      scene.body.linear_velocity = {below * kSpeed, 0, 0};
      PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SWING_TWIST);
      desc.body_a = i == 0 ? 0 : limbs.back();
      limbs.push_back(desc.body_b = scene.add(limb, {0, -below, 0}));
      desc.frame_a = {{0, i == 0 ? 0 : -kArm, 0}, plain(along)};
      desc.frame_b = {{0, kArm, 0}, plain(along)};
      desc.limits[3] = {-0.3, 0.4, 1, 0};
      desc.limits[4] = {-2.9, 2.9, 1, 0};
      desc.limits[5] = {-3, 3, 1, 0};
      scene.join(desc);
    }
    // Of the motion of the centres and the weight; what turns beside is less than a fifth of it, and is left out.
    const auto energy = [&] {
      const std::vector<PlumbPose> poses = scene.poses();
      double sum = 0;
      for (std::size_t i = 0; i < limbs.size(); ++i) {
        const std::vector<double> v = scene.velocity(limbs[i]);
        sum += (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) / 2 + 9.81 * poses[i].position.y;
      }
      return sum;
    };
    const double start = energy();
    double most = start;
    for (int i = 0; i < 20 * hertz; ++i) {
      PlumbStepReport report{};
      check(scene.world(), scene.world().step(1 / hertz));
      check(scene.world(), scene.world().wait(report));
      most = std::max(most, energy());
    }
    EXPECT_LT(most, 1.03 * start);
    EXPECT_LT(energy(), 0.2 * start) << "cones take up blows";
  }
}

/// A motor turns the twist at its speed up to its stop, whichever way what it turns has swung.
TEST(SwingTwist, AMotorTwistsUpToItsStop) {
  ConeRod it(kSwingNeeds, 0, 1, 1);
  it.desc.limits[3] = {-0.5, 2, 1, 0};
  it.desc.motors[3] = {1.5, 100, 1, 0};
  it.hang({0, 0.4, 0.3});
  double row[6] = {};
  const auto twist_after = [&](int steps) {
    for (int i = 0; i < steps; ++i) it.step(1.0 / 60);
    check(it.scene.world(),
          it.scene.world().joints()->read_joints(PLUMB_JOINT_COORDINATES, {&it.joint, 1},
                                                 Rows(reinterpret_cast<std::byte*>(row), 1, sizeof row, PLUMB_F64)));
    return row[3];
  };
  const double early = twist_after(6);
  EXPECT_NEAR(twist_after(48) - early, 1.5 * 0.8, 0.02);
  EXPECT_NEAR(twist_after(60), 2, 0.01);
}

/// A cone that is narrowed while the rod hangs in it takes the rod along, and lets it go where it is taken away.
TEST(SwingTwist, AConeMayBecomeAnother) {
  ConeRod it(kSwingNeeds | PLUMB_NEED_DAMPING, 90 * kDegree, 0.8, 0.8);
  it.scene.body.angular_damping = 3;
  it.hang({0, 0.01, -0.3});
  for (int i = 0; i < 300; ++i) it.step(1.0 / 60);
  EXPECT_NEAR(it.swing().z(), -0.8, 0.01);
  PlumbJointChange change = joint_change(it.joint);
  change.what = PLUMB_MODIFY_LIMITS;
  change.limits[4] = {-0.4, 0.4, 1, 0};
  change.limits[5] = {-0.2, 0.2, 1, 0};
  it.scene.modify(change);
  for (int i = 0; i < 300; ++i) it.step(1.0 / 60);
  EXPECT_NEAR(it.swing().z(), -0.2, 0.01);
  change.limits[4] = change.limits[5] = {};
  it.scene.modify(change);
  for (int i = 0; i < 600; ++i) it.step(1.0 / 60);
  EXPECT_NEAR(it.swing().z(), -std::numbers::pi / 2, 0.05);
}

}  // namespace
}  // namespace plumb::impulse::test
