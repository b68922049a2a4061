// Gears and racks: what they hold as closed forms say it, for how long, how fast, and under contacts.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kGearNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS | PLUMB_NEED_FORCES | PLUMB_NEED_JOINT_REACTIONS | PLUMB_NEED_SNAPSHOT;
constexpr PlumbVec3 kNone = {0, 0, 0};

/// Wheels that turn about x.
struct Train {
  explicit Train(PlumbNeeds needs = kGearNeeds, const PlumbVec3& gravity = kNone) : scene(engine(), needs, gravity, 1) {
    scene.body.material.friction = 0;
  }
  PlumbBody free_wheel(double moment, const PlumbVec3& at) {
    scene.body.mass_mode = PLUMB_MASS_EXPLICIT;
    scene.body.mass = 10;
    scene.body.inertia = {moment, 0.6 * moment, 0.6 * moment};
    return scene.add(scene.box({0.02, 0.1, 0.1}), at);
  }
  PlumbBody wheel(double moment, const PlumbVec3& at, double speed = 0, double torque = 0) {
    const PlumbBody body = free_wheel(moment, at);
    PlumbJointDesc axle = joint_desc(PLUMB_JOINT_HINGE);
    axle.body_b = body;
    axle.frame_a.position = at;
    axle.motors[3] = {speed, torque, torque > 0 ? 1U : 0U, 0};
    axles.push_back(scene.join(axle));
    return body;
  }
  PlumbJoint couple(PlumbJointType type, PlumbBody a, PlumbBody b, double ratio) {
    PlumbJointDesc desc = joint_desc(type);
    desc.body_a = a;
    desc.body_b = b;
    desc.ratio = ratio;
    if (type == PLUMB_JOINT_RACK_AND_PINION) desc.frame_b.orientation = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};
    return scene.join(desc);
  }
  /// Slides along y, and is a rack along it.
  PlumbBody bar(double mass, const PlumbVec3& at) {
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = mass;
    const PlumbBody body = scene.add(scene.box({0.02, 0.3, 0.02}), at);
    PlumbJointDesc guide = joint_desc(PLUMB_JOINT_SLIDER);
    guide.body_b = body;
    guide.frame_a = {at, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}};
    guide.frame_b.orientation = guide.frame_a.orientation;
    scene.join(guide);
    return body;
  }
  double turning(PlumbBody body) { return scene.velocity(body)[3]; }
  std::vector<double> reaction(PlumbJoint joint) {
    std::vector<double> row(6);
    check(scene.world(), scene.world().joints()->read_joints(
                             PLUMB_JOINT_REACTION, {&joint, 1},
                             Rows(reinterpret_cast<std::byte*>(row.data()), 1, 6 * sizeof(double), PLUMB_F64)));
    return row;
  }

  Scene scene;
  std::vector<PlumbJoint> axles;
};

/// A torque on the first wheel turns all of them as one of moment I_a + I_b / r^2, and the gear bears what turns the
/// second.
TEST(Gears, ShareATorque) {
  for (const double ratio : {3.0, -0.25, 40.0}) {
    Train train;
    const PlumbBody a = train.wheel(0.4, {0, 0, 0}), b = train.wheel(0.7, {0, 0.5, 0});
    const PlumbJoint gear = train.couple(PLUMB_JOINT_GEAR, a, b, ratio);
    for (int i = 0; i < 120; ++i) {
      train.scene.write(PLUMB_FIELD_TORQUE, a, {0.5, 0, 0});
      train.scene.run(1);
    }
    const double rate = 0.5 / (0.4 + 0.7 / (ratio * ratio)), speed = 2 * rate;
    EXPECT_NEAR(train.turning(a), speed, 1e-4 * speed) << ratio;
    EXPECT_NEAR(train.turning(b), -speed / ratio, 1e-4 * std::abs(speed / ratio)) << ratio;
    EXPECT_NEAR(train.reaction(gear)[3], -0.7 * rate / ratio, 1e-3 * std::abs(rate / ratio)) << ratio;
  }
}

/// What the gear gives one it takes from the other: r I_a w_a - I_b w_b stays. So does what each does across its axis.
TEST(Gears, OfWheelsInTheAirKeepWhatTheyShare) {
  Train train;
  const PlumbBody a = train.free_wheel(0.4, {0, 0, 0}), b = train.free_wheel(0.7, {0, 1, 0});
  train.couple(PLUMB_JOINT_GEAR, a, b, 2.5);
  train.scene.write(PLUMB_FIELD_VELOCITY, a, {0, 0, 0, 7, 0, 0});
  train.scene.write(PLUMB_FIELD_VELOCITY, b, {0.1, 0, 0, 1, 0, 0});
  train.scene.run(300);
  EXPECT_NEAR(2.5 * 0.4 * train.turning(a) - 0.7 * train.turning(b), 2.5 * 0.4 * 7 - 0.7, 1e-4);
  EXPECT_NEAR(train.turning(a) + 2.5 * train.turning(b), 0, 1e-4);
  EXPECT_NEAR(train.scene.velocity(b)[0], 0.1, 1e-6) << "a gear does not push";
}

/// No place tells how often a wheel went round: this one turns by more than half a turn in a step, and more than one.
TEST(Gears, CountWheelsThatTurnFastByTheWayOfARack) {
  for (const double speed : {150.0, 250.0, 700.0}) {
    Train train;
    const PlumbBody wheel = train.wheel(0.1, {0, 0, 0}, speed, 1e4), bar = train.bar(5, {0, 0, 0.2});
    train.couple(PLUMB_JOINT_RACK_AND_PINION, wheel, bar, speed);
    train.scene.run(600);
    EXPECT_NEAR(train.scene.poses()[1].position.y, 10, 0.005) << speed;
    EXPECT_NEAR(train.turning(wheel), speed, 1e-3 * speed);
  }
}

/// Between wheels of which one is held: it bears the torque on the other, or does not.
TEST(Gears, BreakUnderMoreThanTheyBear) {
  for (const double torque : {9.0, 11.0}) {
    Train train(kGearNeeds | PLUMB_NEED_EVENTS);
    const PlumbBody a = train.wheel(0.4, {0, 0, 0}), b = train.wheel(0.7, {0, 0.5, 0}, 0, 1e4);
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_GEAR);
    desc.body_a = b;
    desc.body_b = a;
    desc.ratio = 3;
    desc.break_torque = 30;  // on a: three times what acts on b
    train.scene.join(desc);
    for (int i = 0; i < 60; ++i) {
      train.scene.write(PLUMB_FIELD_TORQUE, a, {torque / 10 * 30, 0, 0});
      train.scene.run(1);
    }
    EXPECT_EQ(std::abs(train.turning(a)) > 1, torque > 10) << torque;
    EXPECT_NEAR(train.turning(b), 0, 1e-3);
  }
}

/// To and fro, for a minute: a rack that hangs on its pinion neither slips nor creeps.
TEST(Gears, DoNotSlip) {
  Train train(kGearNeeds, kDown);
  const PlumbBody wheel = train.wheel(0.2, {0, 0, 0}), bar = train.bar(30, {0, 0, 0.2});
  train.couple(PLUMB_JOINT_RACK_AND_PINION, wheel, bar, 10);
  double turned = 0, last = 0, slip = 0;
  for (int i = 0; i < 3600; ++i) {
    train.scene.write(PLUMB_FIELD_TORQUE, wheel, {0.1 * 30 * 9.81 * (1 + 0.2 * std::cos(0.05 * i)), 0, 0});
    train.scene.run(1);
    const PlumbPose pose = train.scene.poses()[0];
    const double angle = 2 * std::atan2(pose.orientation.x, pose.orientation.w);
    turned += std::remainder(angle - last, 2 * std::numbers::pi);
    last = angle;
    slip = std::max(slip, std::abs(turned - 10 * train.scene.poses()[1].position.y));
  }
  EXPECT_LT(slip, 2e-3) << "rad";
  EXPECT_GT(std::abs(turned), 1) << "it stood still";
}

/// From the other side the ratio is one over it.
TEST(Gears, AreTheSameFromEitherSide) {
  double speeds[2];
  for (const bool swapped : {false, true}) {
    Train train;
    const PlumbBody a = train.wheel(0.4, {0, 0, 0}), b = train.wheel(0.7, {0, 0.5, 0});
    train.couple(PLUMB_JOINT_GEAR, swapped ? b : a, swapped ? a : b, swapped ? 0.5 : 2.0);
    train.scene.write(PLUMB_FIELD_VELOCITY, a, {0, 0, 0, 5, 0, 0});
    train.scene.run(60);
    speeds[swapped ? 1 : 0] = train.turning(b);
  }
  EXPECT_NEAR(speeds[0], speeds[1], 1e-5);
  EXPECT_LT(speeds[0], -0.5);
}

/// Their way is part of what a snapshot keeps: the motor leans on the teeth, and a step later it is another number.
TEST(Gears, GoOnAsTheyWereFromASnapshot) {
  Train train(kGearNeeds, kDown);
  const PlumbBody wheel = train.wheel(0.2, {0, 0, 0}, 9, 35), bar = train.bar(30, {0, 0, 0.2});
  train.couple(PLUMB_JOINT_RACK_AND_PINION, wheel, bar, 10);
  train.scene.run(50);
  IPhysicsWorld& world = train.scene.world();
  std::span<const std::byte> saved;
  check(world, world.snapshot()->save(saved));
  const std::vector<std::byte> kept(saved.begin(), saved.end());
  train.scene.run(50);
  const std::uint64_t after = train.scene.hash();
  check(world, world.snapshot()->restore(kept));
  train.scene.run(50);
  EXPECT_EQ(train.scene.hash(), after);
}

/// A motor lifts, or holds, a table with a heavy box on it through so many gears of 1.25, every other one an inner one,
/// and a rack.
struct Hoist : Train {
  explicit Hoist(double speed, int gears) : Train(kGearNeeds | PLUMB_NEED_COLLISION, kDown) {
    PlumbBody last = wheel(0.01, {0, 0, 0}, speed, 1e4);
    for (int i = 1; i <= gears; ++i) {
      const PlumbBody next = wheel(0.01, {0, 0.3 * i, 0});
      couple(PLUMB_JOINT_GEAR, last, next, i % 2 == 0 ? -1.25 : 1.25);
      last = next;
    }
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = 20;
    const PlumbBody table = scene.add(scene.box({0.5, 0.05, 0.5}), {0, 0, 3});
    PlumbJointDesc guide = joint_desc(PLUMB_JOINT_SLIDER);
    guide.body_b = table;
    guide.frame_a = {{0, 0, 3}, {0, 0, std::sqrt(0.5), std::sqrt(0.5)}};
    guide.frame_b.orientation = guide.frame_a.orientation;
    scene.join(guide);
    couple(PLUMB_JOINT_RACK_AND_PINION, last, table, 20);
    scene.body.mass = 1500;
    scene.add(scene.box({0.3, 0.3, 0.3}), {0, 0.351, 3});
  }
  double height(std::size_t from_end) {
    const std::vector<PlumbPose> poses = scene.poses();
    return poses[poses.size() - from_end].position.y;
  }
};

/// A long train is no whip: with contacts on what it lifts a motor keeps its speed through five gears.
TEST(Gears, OfALongTrainDriveWhatBearsALoad) {
  Hoist hoist(30, 5);
  hoist.scene.run(60);
  const double start = hoist.height(2), speed = 30 / std::pow(1.25, 5) / 20;
  hoist.scene.run(240);
  EXPECT_NEAR(std::abs(hoist.height(2) - start), 4 * speed, 2e-4 * 4 * speed);
  EXPECT_NEAR(hoist.height(1) - hoist.height(2), 0.35, 2e-3);
}

TEST(Gears, HoldALoadForAMinute) {
  Hoist hoist(0, 3);
  hoist.scene.run(60);
  const double start = hoist.height(2);
  hoist.scene.run(3600);
  EXPECT_NEAR(hoist.height(2), start, 2e-5) << "m";
}

}  // namespace
}  // namespace plumb::impulse::test
