// Limits, motors, springs, universal and generic joints against closed forms, with each solver where it promises them.
#include <algorithm>
#include <array>

#include "plumb/physics_world.hpp"
#include "tests/rigs/joint_rig.hpp"

namespace plumb::impulse {
namespace {

constexpr bool kDouble = sizeof(Real) == 8;
constexpr PlumbVec3 kNoGravity = {0, 0, 0};
constexpr PlumbNeeds kAxisNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_JOINTS;

/// A hinge to the world about z.
PlumbJointDesc axle(PlumbBody body, const PlumbVec3& at = {0, 0, 0}) {
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_HINGE);
  desc.body_b = body;
  desc.frame_a.orientation = desc.frame_b.orientation = about({0, 1, 0}, -kPi_ / 2);
  desc.frame_a.position = at;
  return desc;
}

TEST(JointLimits, RodComesToRestOnItsStop) {
  for (const double solver : {0, 1, 2, 3}) {
    JointRig rig;
    rig.choose_solver(solver);
    const PlumbBody rod = rig.body({0.5, 0, 0}, 1, {0.001, 1.0 / 12, 1.0 / 12});
    PlumbJointDesc desc = axle(rod);
    desc.frame_b.position = {-0.5, 0, 0};
    const double stop = kPi_ / 6;
    desc.limits[3] = {-stop, 1, 1, 0};
    const PlumbJoint hinge = rig.join(desc);
    double deepest = 0;
    for (int i = 0; i < 180; ++i) {
      rig.step();
      deepest = std::min(deepest, rig.coordinates(hinge)[3]);
    }
    const double slack = solver == 0 ? (kDouble ? 1e-6 : 2e-5) : 0.03;
    EXPECT_GT(deepest, -stop - slack) << solver;
    EXPECT_NEAR(rig.coordinates(hinge)[3], -stop, slack) << solver;
    EXPECT_NEAR(rig.speed(rod).angular.z, 0, solver == 0 ? 1e-4 : 0.05) << solver;
  }
}

TEST(JointLimits, NothingIsFeltBetweenThem) {
  JointRig rig(kAxisNeeds, kNoGravity);
  const PlumbBody sled = rig.body({0, 0, 0}, 2, {0.1, 0.1, 0.1}, {0, 0, 0, 1}, {0.5, 0, 0});
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SLIDER);
  desc.body_b = sled;
  desc.limits[0] = {-1, 1, 1, 0};
  const PlumbJoint rail = rig.join(desc);
  rig.run(1.5);
  EXPECT_NEAR(rig.coordinates(rail)[0], 0.75, 1e-6);
  EXPECT_NEAR(rig.speed(sled).linear.x, 0.5, 1e-6);
  rig.run(1);
  EXPECT_NEAR(rig.coordinates(rail)[0], 1, 1e-6);
  EXPECT_NEAR(rig.speed(sled).linear.x, 0, 1e-6);
}

/// Bodies of a joint that are turned, however far, come together, and no faster than errors are taken back. At a right
/// angle for a hinge, and where axes of a universal joint are parallel, rows made of sines
/// are one and the same, or nothing; beyond, they lead the other way.
TEST(Joints, FramesThatAreTurnedComeTogether) {
  struct Case {
    PlumbJointType type;
    std::uint32_t held;  // bits of coordinates
  };
  for (const Case& of : {Case{PLUMB_JOINT_HINGE, 0b110111}, Case{PLUMB_JOINT_SLIDER, 0b111110},
                         Case{PLUMB_JOINT_FIXED, 0b111111}, Case{PLUMB_JOINT_UNIVERSAL, 0b100111}})
    for (const double degrees : {45.0, 85.0, 90.0, 95.0, 135.0, 179.0, 180.0})
      for (const double dt : {1.0 / 30, 1.0 / 240, 1.0 / 3840}) {
        JointRig rig(kAxisNeeds, kNoGravity);
        const PlumbBody a = rig.body({0, 0, 0}, 1, {0.1, 0.15, 0.2}), b = rig.body({1, 0, 0}, 2, {0.2, 0.15, 0.1});
        PlumbJointDesc desc = joint_desc(of.type);
        desc.body_a = a;
        desc.body_b = b;
        desc.frame_a.position = {0.5, 0, 0};
        desc.frame_b = {{-0.5, 0, 0}, about({0, 0, 1}, degrees * kPi_ / 180)};
        const PlumbJoint joint = rig.join(desc);
        double fastest = 0;
        for (double t = 0; t < 2; t += dt) {
          const PlumbVec3 before = rig.pose(b).position;
          rig.step(dt);
          const PlumbVec3 now = rig.pose(b).position;
          fastest = std::max(fastest, std::hypot(now.x - before.x, now.y - before.y, now.z - before.z) / dt);
        }
        EXPECT_LT(fastest, 10) << of.type << " turned by " << degrees << " at " << dt;
        auto at = rig.coordinates(joint);
        if (of.type == PLUMB_JOINT_UNIVERSAL) at[5] = std::sin(at[5]);  // square either way round
        for (std::size_t i = 0; i < 6; ++i) {
          const bool held = (of.held >> i & 1U) != 0;
          EXPECT_NEAR(held ? at[i] : 0, 0, 2e-3) << of.type << " turned by " << degrees << " at " << dt << ": " << i;
        }
      }
}

TEST(JointLimits, NeverPull) {
  JointRig rig(kAxisNeeds, kNoGravity);
  const PlumbBody sled = rig.body({0, 0, 0}, 2);
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SLIDER);
  desc.body_b = sled;
  desc.limits[0] = {0, 1, 1, 0};
  const PlumbJoint rail = rig.join(desc);
  rig.step();
  rig.push(sled, {-2, 0, 0});  // into the stop at which it is
  rig.step();
  rig.push(sled, {2, 0, 0});
  rig.run(0.25);
  EXPECT_NEAR(rig.coordinates(rail)[0], 0.25, 1e-5);
}

TEST(JointLimits, OfAngleBeyondHalfATurn) {
  JointRig rig(kAxisNeeds, kNoGravity);
  const PlumbBody wheel = rig.body({0, 0, 0}, 1, {1, 1, 1}, {0, 0, 0, 1}, {0, 0, 0}, {0, 0, 2});
  PlumbJointDesc desc = axle(wheel);
  desc.limits[3] = {-0.5, 4, 1, 0};
  const PlumbJoint hinge = rig.join(desc);
  rig.run(3);
  EXPECT_NEAR(rig.coordinates(hinge)[3], 4 - 2 * kPi_, 1e-5);
  EXPECT_NEAR(rig.speed(wheel).angular.z, 0, 1e-5);
}

/// A chain of rods that fall on stops between them: equalities and limits in one mechanism.
TEST(JointLimits, ChainFoldsOntoItsStops) {
  for (const std::size_t length : {3U, 12U}) {
    JointRig rig;
    std::vector<PlumbJoint> hinges;
    PlumbBody before = 0;
    for (std::size_t i = 0; i < length; ++i) {
      const double x = static_cast<double>(i);
      const PlumbBody rod = rig.body({x + 0.5, 0, 0}, 1, {0.01, 1.0 / 12, 1.0 / 12});
      PlumbJointDesc desc = axle(rod);
      desc.body_a = before;
      desc.frame_a.position = {before == 0 ? 0 : 0.5, 0, 0};
      desc.frame_b.position = {-0.5, 0, 0};
      desc.limits[3] = {-0.1, 0.1, 1, 0};
      hinges.push_back(rig.join(desc));
      before = rod;
    }
    double worst = 0, open = 0;
    for (int i = 0; i < 600; ++i) {
      rig.step();
      for (const PlumbJoint hinge : hinges) {
        const auto at = rig.coordinates(hinge);
        worst = std::max(worst, std::abs(at[3]) - 0.1);
        open = std::max(open, std::hypot(at[0], at[1], at[2]));
      }
    }
    EXPECT_LT(worst, 1e-3) << length;
    EXPECT_LT(open, 1e-3) << length;
    for (const PlumbJoint hinge : hinges) EXPECT_NEAR(rig.coordinates(hinge)[3], -0.1, 1e-4) << length;
  }
}

TEST(JointLimits, ThreadsGiveTheSameBits) {
  std::vector<PlumbPose> ends;
  for (const std::uint32_t threads : {1U, 2U}) {
    JointRig rig(kAxisNeeds, {0, -kGravity, 0}, threads);
    PlumbBody before = 0;
    for (std::size_t i = 0; i < 150; ++i) {
      const double x = static_cast<double>(i);
      const PlumbBody rod = rig.body({x + 0.5, 0, 0}, 1, {0.01, 1.0 / 12, 1.0 / 12});
      PlumbJointDesc desc = axle(rod);
      desc.body_a = i % 10 == 0 ? 0 : before;
      desc.frame_a.position = {desc.body_a == 0 ? x : 0.5, 0, 0};
      desc.frame_b.position = {-0.5, 0, 0};
      desc.limits[3] = {-0.1, 0.1, 1, 0};
      desc.motors[3] = {0.5, 1, 1, 0};
      rig.join(desc);
      before = rod;
    }
    rig.run(1);
    ends.push_back(rig.pose(before));
  }
  EXPECT_EQ(ends[0].position.x, ends[1].position.x);
  EXPECT_EQ(ends[0].position.y, ends[1].position.y);
  EXPECT_LT(ends[0].position.y, -1);
}

TEST(JointMotors, GiveNoMoreThanTheyMay) {
  for (const double solver : {0, 1, 2, 3}) {
    JointRig rig(kAxisNeeds, kNoGravity);
    rig.choose_solver(solver);
    const PlumbBody disc = rig.body({0, 0, 0}, 2, {0.1, 0.1, 0.25});
    PlumbJointDesc desc = axle(disc);
    desc.motors[3] = {100, 1, 1, 0};
    rig.join(desc);
    rig.run(2);
    EXPECT_NEAR(rig.speed(disc).angular.z, 8, kDouble ? 1e-9 : 1e-4) << solver;
  }
}

TEST(JointMotors, HoldTheirSpeedUnderLoad) {
  for (const double solver : {0, 1, 2, 3}) {
    JointRig rig;
    rig.choose_solver(solver);
    const PlumbBody load = rig.body({0, 0, 0}, 3);
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SLIDER);
    desc.body_b = load;
    desc.frame_a.orientation = desc.frame_b.orientation = about({0, 0, 1}, kPi_ / 2);
    desc.motors[0] = {0.5, 3 * kGravity * 2, 1, 0};
    const PlumbJoint lift = rig.join(desc);
    rig.run(2);
    EXPECT_NEAR(rig.speed(load).linear.y, 0.5, 1e-4) << solver;
    rig.drive(lift, 0, 0.5, 3 * kGravity / 2);  // too weak to hold it
    const double start = rig.speed(load).linear.y;
    rig.run(1);
    EXPECT_NEAR(rig.speed(load).linear.y - start, -kGravity / 2, 2e-3) << solver;
  }
}

/// Motors that hold do not give way under what they bear, however heavy against their arms.
TEST(JointMotors, HoldAnArmStill) {
  for (const double load : {10.0, 1000.0}) {
    JointRig rig(kAxisNeeds);
    PlumbBody before = 0;
    for (int i = 0; i < 3; ++i) {
      const PlumbBody arm = rig.body({0.25 + 0.5 * i, 0, 0}, 10, {0.02, 0.22, 0.22});
      PlumbJointDesc desc = axle(arm);
      desc.body_a = before;
      desc.frame_a.position = {i == 0 ? 0.0 : 0.25, 0, 0};
      desc.frame_b.position = {-0.25, 0, 0};
      desc.motors[3] = {0, 1e6, 1, 0};
      rig.join(desc);
      before = arm;
    }
    const PlumbBody hand = rig.body({1.5, 0, 0}, load);
    rig.join_at(PLUMB_JOINT_FIXED, before, hand, {1.5, 0, 0});
    rig.run(20);
    EXPECT_NEAR(rig.pose(hand).position.y, 0, 5e-3) << load;
  }
}

TEST(JointMotors, AreSwitchedOnByWriting) {
  JointRig rig(kAxisNeeds, kNoGravity);
  const PlumbBody disc = rig.body({0, 0, 0}, 2, {0.1, 0.1, 0.25});
  const PlumbJoint hinge = rig.join(axle(disc));
  rig.run(0.5);
  EXPECT_EQ(rig.speed(disc).angular.z, 0);
  rig.drive(hinge, 3, 3, 1e4);
  rig.run(0.5);
  EXPECT_NEAR(rig.speed(disc).angular.z, 3, 1e-5);
  rig.drive(hinge, 3, 0, 0);
  rig.run(0.5);
  EXPECT_NEAR(rig.speed(disc).angular.z, 3, 1e-4);
}

TEST(JointMotors, WakeWhomTheyDrive) {
  JointRig rig(kAxisNeeds | PLUMB_NEED_SLEEPING, kNoGravity);
  const PlumbBody disc = rig.body({0, 0, 0}, 2, {0.1, 0.1, 0.25});
  PlumbJointDesc desc = axle(disc);
  desc.motors[3] = {0, 1e4, 1, 0};
  const PlumbJoint hinge = rig.join(desc);
  rig.run(2);
  EXPECT_FALSE(rig.is_awake(disc));
  rig.drive(hinge, 3, 2, 1e4);
  rig.run(0.5);
  EXPECT_TRUE(rig.is_awake(disc));
  EXPECT_NEAR(rig.speed(disc).angular.z, 2, 1e-5);
}

/// Angles or places of a body on a spring, at each step.
std::vector<double> swings(double frequency, double damping_ratio, PlumbJointType type, double seconds) {
  JointRig rig(kAxisNeeds, kNoGravity);
  const std::size_t axis = type == PLUMB_JOINT_HINGE ? 3 : 0;
  const PlumbBody body = rig.body({0, 0, 0}, 2, {0.1, 0.2, 0.3});
  PlumbJointDesc desc = type == PLUMB_JOINT_HINGE ? axle(body) : joint_desc(type);
  desc.body_b = body;
  desc.springs[axis] = {0.5, frequency, damping_ratio, 1, 0};
  const PlumbJoint joint = rig.join(desc);
  std::vector<double> at = {-0.5};
  for (double t = 0; t < seconds; t += 1.0 / 60) {
    rig.step();
    at.push_back(rig.coordinates(joint)[axis] - 0.5);
  }
  return at;
}

TEST(JointSprings, SwingAsTheTrueOnes) {
  for (const PlumbJointType type : {PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER})
    for (const double zeta : {0.0, 0.1, 1.0}) {
      const double omega = 2 * kPi_ * 1.5;
      const std::vector<double> at = swings(1.5, zeta, type, 2);
      for (std::size_t i = 0; i < at.size(); ++i) {
        const double t = static_cast<double>(i) / 60, free = omega * std::sqrt(1 - zeta * zeta);
        const double truth = zeta == 1 ? -0.5 * (1 + omega * t) * std::exp(-omega * t)
                                       : -0.5 * std::exp(-zeta * omega * t) *
                                             (std::cos(free * t) + zeta * omega / free * std::sin(free * t));
        EXPECT_NEAR(at[i], truth, 0.01) << type << " " << zeta << " at " << t;
      }
    }
}

TEST(JointSprings, OfAnyStiffnessComeToRest) {
  for (const double frequency : {30.0, 100.0, 1e3, 1e5})
    for (const double zeta : {0.0, 1.0, 50.0}) {
      const std::vector<double> at = swings(frequency, zeta, PLUMB_JOINT_SLIDER, 3);
      for (const double x : at) EXPECT_LT(std::abs(x), 0.5001) << frequency << " " << zeta;
      EXPECT_NEAR(at.back(), 0, zeta == 50 && frequency < 50 ? 1 : 1e-3) << frequency << " " << zeta;
    }
}

/// By stiffness: of the moment or mass that truly moves, at any step.
TEST(JointSprings, ByStiffnessSwingAsTheTrueOnes) {
  for (const PlumbJointType type : {PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER})
    for (const double zeta : {0.0, 0.1, 0.9})
      for (const double dt : {1.0 / 30, 1.0 / 60, 1.0 / 240}) {
        JointRig rig(kAxisNeeds, kNoGravity);
        const bool turns = type == PLUMB_JOINT_HINGE;
        const PlumbBody body = rig.body({0.4, 0, 0}, 2, {0.1, 0.2, 0.3});
        PlumbJointDesc desc = turns ? axle(body) : joint_desc(type);
        desc.body_b = body;
        if (turns) desc.frame_b.position = {-0.4, 0, 0};  // the moment about the axis: .3 + 2 * .16
        if (!turns) desc.frame_a.position = {0.4, 0, 0};
        const double inertia = turns ? 0.62 : 2, omega = 2 * kPi_ * 1.5;
        const std::size_t axis = turns ? 3 : 0;
        desc.springs[axis] = {0.5, inertia * omega * omega, 2 * zeta * omega * inertia, 1, PLUMB_SPRING_STIFFNESS};
        const PlumbJoint joint = rig.join(desc);
        const double free = omega * std::sqrt(1 - zeta * zeta);
        for (double t = dt; t < 2; t += dt) {
          rig.step(dt);
          const double truth =
              -0.5 * std::exp(-zeta * omega * t) * (std::cos(free * t) + zeta * omega / free * std::sin(free * t));
          ASSERT_NEAR(rig.coordinates(joint)[axis] - 0.5, truth, 0.015) << type << " " << zeta << " at " << t;
        }
      }
}

/// A damper in the hinge of a light link that has a heavy one welded to it: what moves is a thousand times more than
/// the two bodies of the joint by themselves. Elimination knows it; passes over joints one by one would take thousands.
TEST(JointSprings, DampWhatMovesAndNotTheLinkAlone) {
  for (const double damping : {0.05, 0.5, 5.0}) {
    JointRig rig(kAxisNeeds, kNoGravity);
    const PlumbVec3 still = {0, 0, 0}, spin = {0, 0, 3};
    const PlumbQuat upright = {0, 0, 0, 1};
    const PlumbBody link = rig.body({0, 0, 0}, 0.002, {5e-4, 5e-4, 5e-4}, upright, still, spin);
    const PlumbBody wheel = rig.body({0, 0, 0.1}, 2, {0.5, 0.5, 0.5}, upright, still, spin);
    PlumbJointDesc hinge = axle(link);
    hinge.springs[3] = {0, 0, damping, 1, PLUMB_SPRING_STIFFNESS};
    const PlumbJoint joint = rig.join(hinge);
    PlumbJointDesc weld = joint_desc(PLUMB_JOINT_FIXED);
    weld.body_a = link;
    weld.body_b = wheel;
    weld.frame_a.position = {0, 0, 0.05};
    weld.frame_b.position = {0, 0, -0.05};
    rig.join(weld);
    rig.run(0.5);
    const double rate = damping / 0.5005, gone = 3 / rate * (1 - std::exp(-rate * 0.5));
    EXPECT_NEAR(rig.coordinates(joint)[3], gone, 0.02 * gone) << damping;
  }
}

TEST(JointSprings, ByStiffnessMayBeAsStiffAsOneLikes) {
  for (const double stiffness : {0.0, 1e2, 1e5, 1e9})
    for (const double damping : {0.0, 1.0, 1e6})
      for (const double dt : {1.0 / 30, 1.0 / 240}) {
        JointRig rig(kAxisNeeds, kNoGravity);
        const PlumbBody rod = rig.body({0.5, 0, 0}, 1, {0.001, 1.0 / 12, 1.0 / 12});
        PlumbJointDesc desc = axle(rod);
        desc.frame_b.position = {-0.5, 0, 0};
        desc.springs[3] = {0.5, stiffness, damping, 1, PLUMB_SPRING_STIFFNESS};
        const PlumbJoint joint = rig.join(desc);
        for (double t = 0; t < 2; t += dt) {
          rig.step(dt);
          ASSERT_LT(std::abs(rig.coordinates(joint)[3] - 0.5), 0.51) << stiffness << " " << damping << " at " << t;
        }
      }
}

TEST(JointSprings, SagUnderTheWeight) {
  for (const double solver : {0, 1, 2, 3})
    for (const double frequency : {1.0, 10.0, 200.0}) {
      JointRig rig;
      rig.choose_solver(solver);
      const PlumbBody bob = rig.body({0, -2, 0}, 3);
      PlumbJointDesc desc = joint_desc(PLUMB_JOINT_DISTANCE);
      desc.body_b = bob;
      desc.rest_length = 2;
      desc.springs[0] = {0, frequency, 1, 1, 0};
      rig.join(desc);
      rig.run(4);
      const double omega = 2 * kPi_ * frequency, sag = kGravity / (omega * omega);
      EXPECT_NEAR(-2 - rig.pose(bob).position.y, sag, 1e-3 * sag + (kDouble ? 1e-9 : 2e-6))
          << solver << " " << frequency;
    }
}

TEST(JointSprings, LeaveRoomForLimitsAndMotors) {
  JointRig rig;
  const PlumbBody bob = rig.body({0, 0, 0}, 1);
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_SLIDER);
  desc.body_b = bob;
  desc.frame_a.orientation = desc.frame_b.orientation = about({0, 0, 1}, kPi_ / 2);  // x upward
  desc.springs[0] = {0, 1, 1, 1, 0};
  desc.limits[0] = {-0.1, 1, 1, 0};
  const PlumbJoint joint = rig.join(desc);
  rig.run(3);
  EXPECT_NEAR(rig.coordinates(joint)[0], -0.1, 1e-5);  // it would sag by .248
  rig.drive(joint, 0, 1, 0.75 * kGravity);             // a motor that takes most of the weight: the spring the rest
  rig.run(6);
  EXPECT_NEAR(rig.coordinates(joint)[0], -0.25 * kGravity / (4 * kPi_ * kPi_), 1e-4);
}

TEST(JointAxes, DistanceStaysWithinItsLimits) {
  JointRig rig;
  const PlumbBody bob = rig.body({1, 0, 0}, 1);
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_DISTANCE);
  desc.body_b = bob;
  desc.limits[0] = {0.5, 1.5, 1, 0};
  const PlumbJoint rope = rig.join(desc);
  double longest = 0;
  for (int i = 0; i < 300; ++i) {
    rig.step();
    const auto at = rig.coordinates(rope);
    longest = std::max(longest, std::hypot(at[0], at[1], at[2]));
  }
  EXPECT_NEAR(longest, 1.5, 1e-4);
}

/// Two shafts at an angle: the second turns by atan(tan(first) cos(angle)).
TEST(JointAxes, UniversalJointTurnsAsItsLawSays) {
  const double bend = kPi_ / 6, speed = 3;
  JointRig rig(kAxisNeeds, kNoGravity);
  const PlumbVec3 along = {std::cos(bend), std::sin(bend), 0};
  const PlumbBody first = rig.body({-1, 0, 0}, 1, {0.05, 0.1, 0.1});
  const PlumbBody second = rig.body(along, 1, {0.05, 0.1, 0.1}, about({0, 0, 1}, bend));
  PlumbJointDesc in = joint_desc(PLUMB_JOINT_HINGE);
  in.body_b = first;
  in.frame_a.position = {-1, 0, 0};
  in.motors[3] = {speed, 1e4, 1, 0};
  const PlumbJoint input = rig.join(in);
  const PlumbJoint output = rig.join_at(PLUMB_JOINT_HINGE, 0, second, along, about({0, 0, 1}, bend));
  // Frame a: x along z. Frame b: y square to the second shaft in the plane of both.
  PlumbJointDesc cross = joint_desc(PLUMB_JOINT_UNIVERSAL);
  cross.body_a = first;
  cross.body_b = second;
  cross.frame_a = {{1, 0, 0}, about({0, 1, 0}, -kPi_ / 2)};
  cross.frame_b = {{-1, 0, 0}, {0, 0, 0, 1}};
  const PlumbJoint universal = rig.join(cross);
  for (int i = 0; i < 300; ++i) {
    rig.step();
    const double a = rig.coordinates(input)[3], b = rig.coordinates(output)[3];
    const double truth = std::atan2(std::sin(a) * std::cos(bend), std::cos(a));
    EXPECT_NEAR(std::remainder(b - truth, 2 * kPi_), 0, 2e-4) << "step " << i;
    const auto at = rig.coordinates(universal);
    EXPECT_LT(std::hypot(at[0], at[1], at[2]), 1e-4);
  }
  EXPECT_NEAR(rig.speed(first).angular.x, speed, 1e-3);
}

/// A generic joint with the free axes of another type moves as that.
TEST(JointAxes, GenericJointStandsForTheOthers) {
  struct Case {
    PlumbJointType type;
    std::uint32_t free;
  };
  for (const Case& c :
       {Case{PLUMB_JOINT_BALL, 0b111000}, Case{PLUMB_JOINT_HINGE, 0b001000}, Case{PLUMB_JOINT_SLIDER, 0b000001},
        Case{PLUMB_JOINT_FIXED, 0}, Case{PLUMB_JOINT_UNIVERSAL, 0b011000}}) {
    std::array<PlumbVec3, 2> ends{};
    for (const bool generic : {false, true}) {
      JointRig rig;
      const PlumbVec3 inertia = {0.1, 0.2, 0.25};
      const PlumbBody a = rig.body({0, 0, 0}, 1, inertia), b = rig.body({1, 0, 0}, 2, inertia, about({0, 0, 1}, 0.3));
      rig.join_at(PLUMB_JOINT_BALL, 0, a, {-0.5, 0, 0});
      PlumbJointDesc desc = joint_desc(generic ? PlumbJointType{PLUMB_JOINT_GENERIC} : c.type);
      for (std::size_t axis = 0; axis < 6; ++axis)
        desc.axis_modes[axis] = (c.free >> axis & 1U) != 0 ? PLUMB_AXIS_FREE : PLUMB_AXIS_LOCKED;
      desc.body_a = a;
      desc.body_b = b;
      desc.frame_a.position = {0.5, 0, 0};
      desc.frame_b.position = {-0.5 * std::cos(0.3), 0.5 * std::sin(0.3), 0};
      desc.frame_b.orientation = about({0, 0, 1}, -0.3);
      rig.join(desc);
      rig.run(1);
      ends[generic ? 1 : 0] = rig.pose(b).position;
    }
    EXPECT_NEAR(ends[0].x, ends[1].x, 2e-4) << c.type;
    EXPECT_NEAR(ends[0].y, ends[1].y, 2e-4) << c.type;
    EXPECT_NEAR(ends[0].z, ends[1].z, 2e-4) << c.type;
  }
}

/// Each pair of free turns, driven by its motors: coordinates go as fast as the motors say.
TEST(JointAxes, TwoOrThreeFreeTurnsAreDrivenApart) {
  for (const std::uint32_t free : {3U, 5U, 6U, 7U}) {
    JointRig rig(kAxisNeeds, kNoGravity);
    const PlumbBody body = rig.body({0, 0, 0}, 1, {0.3, 0.2, 0.1});
    PlumbJointDesc desc = joint_desc(PLUMB_JOINT_GENERIC);
    desc.body_b = body;
    std::array<double, 6> speed{};
    for (std::size_t axis = 0; axis < 6; ++axis) {
      const bool is_free = axis >= 3 && (free >> (axis - 3) & 1U) != 0;
      desc.axis_modes[axis] = is_free ? PLUMB_AXIS_FREE : PLUMB_AXIS_LOCKED;
      if (!is_free) continue;
      speed[axis] = axis == 4 ? 0.6 : axis == 3 ? 1.1 : -0.9;
      desc.motors[axis] = {speed[axis], 1e4, 1, 0};
    }
    const PlumbJoint joint = rig.join(desc);
    rig.run(1.5);
    const auto at = rig.coordinates(joint);
    for (std::size_t axis = 0; axis < 6; ++axis) EXPECT_NEAR(at[axis], 1.5 * speed[axis], 2e-3) << free << " " << axis;
  }
}

/// A hinge that holds all rows at once: the same joint told from the other side.
TEST(JointAxes, SidesCanBeSwapped) {
  std::array<double, 2> angles{};
  for (const bool swapped : {false, true}) {
    JointRig rig(kAxisNeeds, kNoGravity);
    const PlumbBody a = rig.body({0, 0, 0}, 1, {0.1, 0.1, 0.1}), b = rig.body({1, 0, 0}, 4, {0.2, 0.2, 0.2});
    PlumbJointDesc desc = axle(b);
    desc.body_a = swapped ? b : a;
    desc.body_b = swapped ? a : b;
    desc.frame_a.position = {swapped ? -0.5 : 0.5, 0, 0};
    desc.frame_b.position = {swapped ? 0.5 : -0.5, 0, 0};
    desc.motors[3] = {swapped ? -2.0 : 2.0, 0.5, 1, 0};
    desc.springs[3] = {0, 0.5, 0.2, 1, 0};
    desc.limits[3] = {-1, 0.2, 1, 0};
    if (swapped) desc.limits[3] = {-0.2, 1, 1, 0};
    const PlumbJoint hinge = rig.join(desc);
    rig.run(1);
    angles[swapped ? 1 : 0] = (swapped ? -1 : 1) * rig.coordinates(hinge)[3];
  }
  EXPECT_NEAR(angles[0], angles[1], kDouble ? 1e-9 : 1e-5);
  EXPECT_NEAR(angles[0], 0.2, 1e-5);
}

TEST(JointAxes, InternalMotorsKeepMomentum) {
  JointRig rig(kAxisNeeds, kNoGravity);
  const PlumbVec3 inertia = {0.2, 0.3, 0.4};
  std::vector<PlumbBody> bodies;
  for (int i = 0; i < 4; ++i) bodies.push_back(rig.body({1.0 * i, 0, 0}, 2, inertia));
  for (std::size_t i = 0; i + 1 < bodies.size(); ++i) {
    PlumbJointDesc desc = joint_desc(i == 1 ? PLUMB_JOINT_UNIVERSAL : PLUMB_JOINT_HINGE);
    desc.body_a = bodies[i];
    desc.body_b = bodies[i + 1];
    desc.frame_a.position = {0.5, 0.1, 0};
    desc.frame_b.position = {-0.5, 0.1, 0};
    desc.motors[3] = {2.0 - static_cast<double>(i), 3, 1, 0};
    desc.limits[3] = {-0.7, 0.7, 1, 0};
    if (i == 1) desc.springs[4] = {0.4, 2, 0.1, 1, 0};
    rig.join(desc);
  }
  rig.run(5);
  const auto sum = momentum(rig, bodies, 2, inertia);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(sum[i], 0, kDouble ? 1e-7 : 1e-3) << i;
}

TEST(JointAxes, OnLockedAxesAreRefusedInWords) {
  JointRig rig;
  const PlumbBody body = rig.body({0, 0, 0});
  PlumbJointDesc desc = axle(body);
  desc.limits[0] = {-1, 1, 1, 0};
  try {
    rig.join(desc);
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("limits[0] is on an axis that this hinge joint locks; free are 3"),
              std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace plumb::impulse
