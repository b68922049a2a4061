// Joints that are driven to a pose: limbs follow an orientation as Lagrange's equations say, hold it among contacts,
// and a target that is written costs and does no more than a spring that rests there.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <numbers>

#include "plumb/backend/usual_capability.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

using Vector = Eigen::Vector3d;
using Row = std::array<double, 6>;

constexpr PlumbNeeds kDriveNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS | PLUMB_NEED_GYROSCOPIC;

/// Without friction.
Scene bare_scene(PlumbNeeds needs, const PlumbVec3& gravity = kDown) {
  Scene scene(engine(), needs, gravity, 1);
  scene.body.material.friction = 0;
  return scene;
}

PlumbQuat plain(const Eigen::Quaterniond& q) { return {q.x(), q.y(), q.z(), q.w()}; }

Row coordinates(Scene& scene, PlumbJoint joint) {
  Row row;
  check(scene.world(),
        scene.world().joints()->read_joints(PLUMB_JOINT_COORDINATES, {&joint, 1}, rows_over(std::span(&row, 1))));
  return row;
}
void write_rest(Scene& scene, PlumbJoint joint, const Row& rest) {
  check(scene.world(), scene.world().joints()->write_joints(PLUMB_JOINT_SPRING_REST, {&joint, 1},
                                                            const_rows_over(std::span(&rest, 1))));
}
void step(Scene& scene, double dt) {
  PlumbStepReport report{};
  check(scene.world(), scene.world().step(dt));
  check(scene.world(), scene.world().wait(report));
}
double fastest(Scene& scene, std::span<const PlumbBody> bodies) {
  double most = 0;
  for (const PlumbBody body : bodies) {
    const std::vector<double> v = scene.velocity(body);
    most = std::max(most, std::hypot(v[0], v[1], v[2]));
  }
  return most;
}

/// Led round a cone a rod goes round one of half angle s, b behind: k A sin b = c s W, k (s - A cos b) = W^2 sin s
/// (J cos s + J3 (1 - cos s)), J of the rod about its end and J3 about its length.
TEST(Drives, ALimbLedRoundAConeFollowsAsItShould) {
  constexpr double kSwing = 0.9, kRate = 2.5, kStiffness = 10, kDamping = 1.5, kHalf = 0.5, kThick = 0.05;
  constexpr double kJ = (4 * kHalf * kHalf + 4 * kThick * kThick) / 12 + kHalf * kHalf, kJ3 = 8 * kThick * kThick / 12;
  const double x =
      kSwing - kRate * kRate * std::sin(kSwing) * (kJ * std::cos(kSwing) + kJ3 * (1 - std::cos(kSwing))) / kStiffness;
  const double y = kDamping * kSwing * kRate / kStiffness, led = std::hypot(x, y), behind = std::atan2(y, x);
  for (const double hertz : {30, 60, 240}) {
    SCOPED_TRACE(hertz);
    Scene scene = bare_scene(kDriveNeeds, {0, 0, 0});
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SWING_TWIST);
    desc.frame_b.position = {-kHalf, 0, 0};
    for (std::size_t axis = 3; axis < 6; ++axis)
      desc.springs[axis] = {0, kStiffness, kDamping, 1, PLUMB_SPRING_STIFFNESS};
    desc.limits[4] = desc.limits[5] = {-2, 2, 1, 0};
    desc.limits[3] = {-1, 1, 1, 0};
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = 1;
    desc.body_b = scene.add(scene.box({kHalf, kThick, kThick}), {kHalf, 0, 0});
    const PlumbJoint joint = scene.join(desc);
    const int steps = static_cast<int>(12 * hertz);
    for (int i = 0; i < steps; ++i) {
      const double at = kRate * (i + 0.5) / hertz;
      write_rest(scene, joint, {0, 0, 0, 0, led * std::cos(at), led * std::sin(at)});
      step(scene, 1 / hertz);
    }
    const Row row = coordinates(scene, joint);
    const double now = kRate * 12 - behind, allowed = hertz < 60 ? 0.02 : 0.01;
    EXPECT_NEAR(row[4], kSwing * std::cos(now), allowed);
    EXPECT_NEAR(row[5], kSwing * std::sin(now), allowed);
    EXPECT_NEAR(row[3], 0, 0.005);
  }
}

/// On undamped springs alike in all directions a rod that is thrown goes round wide, and keeps its energy and its
/// angular momentum about the joint's axis.
TEST(Drives, WhatSwingsOnSpringsKeepsItsEnergy) {
  constexpr double kStiff = 30, kSoft = 10, kHalf = 0.5, kThick = 0.05, kSpeed = 3;  // N m/rad, m, rad/s
  constexpr double kAcross = (4 * kHalf * kHalf + 4 * kThick * kThick) / 12, kAlong = 8 * kThick * kThick / 12;
  for (const double hertz : {60, 240}) {
    SCOPED_TRACE(hertz);
    Scene scene = bare_scene(kDriveNeeds, {0, 0, 0});
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SWING_TWIST);
    desc.frame_b.position = {-kHalf, 0, 0};
    desc.springs[4] = {0, kStiff, 0, 1, PLUMB_SPRING_STIFFNESS};
    desc.springs[5] = {0, kSoft, 0, 1, PLUMB_SPRING_STIFFNESS};
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = 1;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.1, Vector::UnitY()));
    const Vector at = turn * Vector(kHalf, 0, 0), spin(kSpeed, 0, 0), speed = spin.cross(at);
    scene.body.angular_velocity = {spin.x(), spin.y(), spin.z()};
    scene.body.linear_velocity = {speed.x(), speed.y(), speed.z()};
    desc.body_b = scene.add(scene.box({kHalf, kThick, kThick}), {at.x(), at.y(), at.z()}, plain(turn));
    const PlumbJoint joint = scene.join(desc);
    const auto energy = [&] {
      const std::vector<double> v = scene.velocity(desc.body_b);
      const PlumbVec3 place = scene.poses()[0].position;
      const Vector linear(v[0], v[1], v[2]), angular(v[3], v[4], v[5]);
      const double about_length = 2 * angular.dot(Vector(place.x, place.y, place.z));
      const double turning = kAcross * angular.squaredNorm() + (kAlong - kAcross) * about_length * about_length;
      const Row row = coordinates(scene, joint);
      return (linear.squaredNorm() + turning + kStiff * row[4] * row[4] + kSoft * row[5] * row[5]) / 2;
    };
    const double start = energy();
    for (int i = 0; i < 10 * hertz; ++i) {
      step(scene, 1 / hertz);
      ASSERT_NEAR(energy(), start, 0.02 * start) << i;
    }
  }
}

/// All seven rows of a joint at work: a motor turns the twist against its stop, springs pull the swing beyond its cone.
TEST(Drives, AJointMayHoldAllItsRowsAtOnce) {
  Scene scene = bare_scene(kDriveNeeds);
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SWING_TWIST);
  desc.frame_b.position = {-0.5, 0, 0};
  desc.limits[3] = {-0.4, 0.7, 1, 0};
  desc.motors[3] = {2, 50, 1, 0};
  desc.limits[4] = {-0.5, 0.5, 1, 0};
  desc.limits[5] = {-0.8, 0.8, 1, 0};
  for (std::size_t axis = 4; axis < 6; ++axis) desc.springs[axis] = {1, 4, 1, 1, PLUMB_SPRING_FREQUENCY};
  desc.motors[4] = {0, 0.1, 1, 0};
  desc.body_b = scene.add(scene.box({0.5, 0.1, 0.1}), {0.5, 0, 0});
  const PlumbJoint joint = scene.join(desc);
  for (int i = 0; i < 600; ++i) step(scene, 1.0 / 60);
  const Row row = coordinates(scene, joint);
  EXPECT_NEAR(row[3], 0.7, 5e-3);
  EXPECT_NEAR(std::hypot(row[4] / 0.5, row[5] / 0.8), 1, 5e-3);
  EXPECT_LT(std::hypot(row[0], row[1], row[2]), 1e-4);
  EXPECT_LT(fastest(scene, {&desc.body_b, 1}), 1e-3);
}

/// A chain of limbs on stiff springs that all are led, in turn, with a weight at its end a hundred times theirs, over a
/// ground with boxes: it follows, its joints stay whole, and it comes to rest in its last pose.
TEST(Drives, ALedChainThatRunsIntoThingsHoldsAndRests) {
  for (const double hertz : {30, 60, 240}) {
    SCOPED_TRACE(hertz);
    Scene scene(engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION, kDown,
                1);
    scene.ground();
    constexpr int kLinks = 6;
    const PlumbShape limb = scene.capsule(0.06, 0.14);
    const Eigen::Quaterniond down(Eigen::AngleAxisd(-std::numbers::pi / 2, Vector::UnitZ()));  // x points down
    std::vector<PlumbBody> bodies;
    std::vector<PlumbJoint> joints;
    for (int i = 0; i < kLinks; ++i) {
      PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SWING_TWIST);
      desc.body_a = i == 0 ? 0 : bodies.back();
      bodies.push_back(desc.body_b = scene.add(limb, {0, 2.4 - 0.4 * i - 0.2, 0}));
      desc.frame_a = {{0, i == 0 ? 2.4 : -0.2, 0}, plain(down)};
      desc.frame_b = {{0, 0.2, 0}, plain(down)};
      for (std::size_t axis = 3; axis < 6; ++axis) desc.springs[axis] = {0, 4000, 400, 1, PLUMB_SPRING_STIFFNESS};
      desc.limits[3] = {-0.5, 0.5, 1, 0};
      desc.limits[4] = desc.limits[5] = {-1.2, 1.2, 1, 0};
      joints.push_back(scene.join(desc));
    }
    const PlumbShape box = scene.box({0.15, 0.15, 0.15});
    for (int i = 0; i < 8; ++i) bodies.push_back(scene.add(box, {0.35 * (i % 4) - 0.5, 0.16 + 0.31 * (i / 4), 0.3}));
    double gap = 0;
    for (int i = 0; i < 12 * hertz; ++i) {
      const double t = i / hertz, led = t < 6 ? std::sin(2 * t) * std::sin(std::numbers::pi * t / 6) : 0;
      for (std::size_t k = 0; k < joints.size() && t < 6.1; ++k)
        write_rest(scene, joints[k], {0, 0, 0, 0.2 * led, k % 2 == 0 ? 0.6 * led : 0, k % 2 == 0 ? 0 : 0.4 * led});
      step(scene, 1 / hertz);
      for (const PlumbJoint joint : joints) {
        const Row row = coordinates(scene, joint);
        gap = std::max(gap, std::hypot(row[0], row[1], row[2]));
      }
    }
    EXPECT_LT(gap, 2e-3);
    for (const PlumbJoint joint : joints)
      EXPECT_LT(std::hypot(coordinates(scene, joint)[4], coordinates(scene, joint)[5]), 0.02);
    EXPECT_LT(fastest(scene, bodies), 2e-3);
  }
}

/// Rows that are written do what the same springs do that a change of the joint brings, to the bit, whatever the type.
TEST(Drives, ATargetIsASpringThatRestsThere) {
  const auto run = [](bool by_rows) {
    Scene scene = bare_scene(kDriveNeeds | PLUMB_NEED_COLLISION);
    scene.ground();
    std::vector<PlumbJoint> joints;
    std::vector<PlumbJointDesc> descs;
    for (const PlumbJointType type : {PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER, PLUMB_JOINT_DISTANCE,
                                      PLUMB_JOINT_UNIVERSAL, PLUMB_JOINT_GENERIC, PLUMB_JOINT_SWING_TWIST}) {
      PlumbJointDesc desc = joint_desc(type);
      const double x = 2.0 * static_cast<double>(type);
      desc.frame_a.position = {x, 1, 0};
      desc.frame_b.position = {-0.3, 0, 0};
      desc.rest_length = type == PLUMB_JOINT_DISTANCE ? 0.4 : 0;
      const std::uint32_t free = backend::free_axes(type);
      for (std::size_t axis = 0; axis < 6; ++axis)
        desc.springs[axis] = {0, 3, 0.3, free >> axis & 1U, PLUMB_SPRING_FREQUENCY};
      desc.body_b = scene.add(scene.box({0.3, 0.1, 0.2}), {x + 0.3, 1, 0});
      joints.push_back(scene.join(desc));
      descs.push_back(desc);
    }
    for (int i = 0; i < 240; ++i) {
      for (std::size_t k = 0; k < joints.size() && i % 3 == 0; ++k) {
        const bool rod = descs[k].type == PLUMB_JOINT_DISTANCE;
        Row rest;
        for (std::size_t axis = 0; axis < 6; ++axis)
          rest[axis] = (rod && axis == 0 ? 0.6 : 0) + 0.2 * std::sin(0.1 * i + static_cast<double>(k + axis));
        if (by_rows) {
          write_rest(scene, joints[k], rest);
          continue;
        }
        PlumbJointChange change = joint_change(joints[k]);
        change.what = PLUMB_MODIFY_SPRINGS;
        if (rod) change.what |= PLUMB_MODIFY_LIMITS;
        std::copy(std::begin(descs[k].springs), std::end(descs[k].springs), change.springs);
        for (std::size_t axis = 0; axis < 6; ++axis)
          if (!rod || axis > 0) change.springs[axis].rest = rest[axis];
        change.rest_length = rest[0];
        scene.modify(change);
      }
      step(scene, 1.0 / 60);
    }
    return scene.hash();
  };
  EXPECT_EQ(run(true), run(false));
}

/// Who sleeps wakes by it, and sleeps again in the pose that it was told; the row says what was written.
TEST(Drives, ATargetWakesWhoSleeps) {
  Scene scene = bare_scene(kDriveNeeds | PLUMB_NEED_SLEEPING);
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
  desc.springs[3] = {0.2, 8, 1, 1, PLUMB_SPRING_FREQUENCY};
  desc.body_b = scene.add(scene.box({0.1, 0.3, 0.1}), {0, 0, 0});
  const PlumbJoint joint = scene.join(desc);
  const auto settle = [&](double target) {
    for (int i = 0; i < 240; ++i) step(scene, 1.0 / 60);
    EXPECT_NEAR(coordinates(scene, joint)[3], target, 1e-3);
    double awake = 1;
    check(scene.world(), scene.world().read(PLUMB_FIELD_AWAKE, {&desc.body_b, 1}, rows_over(std::span(&awake, 1))));
    EXPECT_EQ(awake, 0);
  };
  settle(0.2);
  write_rest(scene, joint, {0, 0, 0, -0.7, 0, 0});
  settle(-0.7);
  Row row;
  check(scene.world(),
        scene.world().joints()->read_joints(PLUMB_JOINT_SPRING_REST, {&joint, 1}, rows_over(std::span(&row, 1))));
  EXPECT_EQ(row, (Row{0, 0, 0, -0.7, 0, 0}));
}

}  // namespace
}  // namespace plumb::impulse::test
