// Joint drift: each type is blind to what it leaves free and sees what it locks.
#include "referee/joints.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "shapes.hpp"

namespace plumb::referee::testing {
namespace {

// The joint between a body at `frame` and another such that b's frame sits at `relative` in a's.
struct Jointed {
  PlumbJointDesc desc;
  Pose a, b;
};
Jointed jointed(PlumbJointType type, const Pose& relative) {
  Random random(61);
  Jointed made{joint_desc(type), random.pose(100), {}};
  const auto random_frame = [&] {
    const Pose pose = random.pose(2);
    const Quat q(pose.rotation);
    return PlumbPose{plain(pose.position), {q.x(), q.y(), q.z(), q.w()}};
  };
  made.desc.frame_a = random_frame();
  made.desc.frame_b = random_frame();
  made.b = made.a * pose(made.desc.frame_a) * relative * pose(made.desc.frame_b).inverse();
  return made;
}
JointError error_of(const Jointed& joint) { return joint_error(joint.desc, joint.a, joint.b); }
JointError error_of(PlumbJointType type, const Pose& relative) { return error_of(jointed(type, relative)); }

constexpr double near_zero = 1e-12;
constexpr double degree = 0.017453292519943295;

TEST(Joints, CoordinatesAreThoseOfTheRelativeFrame) {
  const Pose relative = Pose{Mat3::Identity(), {1, 2, 3}} * turned(20, Vec3::UnitX()) * turned(-30, Vec3::UnitY()) *
                        turned(40, Vec3::UnitZ());
  const Jointed joint = jointed(PLUMB_JOINT_GENERIC, relative);
  const auto found = joint_coordinates(joint.desc, joint.a, joint.b);
  const double truth[6] = {1, 2, 3, 20 * degree, -30 * degree, 40 * degree};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found[i], truth[i], near_zero);
}

TEST(Joints, Ball) {
  EXPECT_NEAR(error_of(PLUMB_JOINT_BALL, turned(100, {1, 2, 3})).position, 0, near_zero);
  const JointError off = error_of(PLUMB_JOINT_BALL, turned(100, {1, 2, 3}, {0.3, 0, 0.4}));
  EXPECT_NEAR(off.position, 0.5, near_zero);
  EXPECT_EQ(off.angle, 0);
}

TEST(Joints, Hinge) {
  EXPECT_NEAR(error_of(PLUMB_JOINT_HINGE, turned(100, Vec3::UnitX())).angle, 0, near_zero);
  const JointError off =
      error_of(PLUMB_JOINT_HINGE, turned(100, Vec3::UnitX(), {0, 0.1, 0}) * turned(2, Vec3::UnitZ()));
  EXPECT_NEAR(off.angle, 2 * degree, near_zero);
  EXPECT_NEAR(off.position, 0.1, near_zero);
}

TEST(Joints, HingeLimit) {
  Jointed joint = jointed(PLUMB_JOINT_HINGE, turned(50, Vec3::UnitX()));
  joint.desc.limits[3] = {-30 * degree, 45 * degree, 1, 0};
  EXPECT_NEAR(error_of(joint).limit_angle, 5 * degree, near_zero);
  joint = jointed(PLUMB_JOINT_HINGE, turned(-31, Vec3::UnitX()));
  joint.desc.limits[3] = {-30 * degree, 45 * degree, 1, 0};
  EXPECT_NEAR(error_of(joint).limit_angle, 1 * degree, near_zero);
  joint.desc.limits[3].enabled = 0;
  EXPECT_EQ(error_of(joint).limit_angle, 0);
}

TEST(Joints, HingeLimitBeyondAHalfTurn) {
  const auto beyond = [](double degrees, double lower, double upper) {
    Jointed joint = jointed(PLUMB_JOINT_HINGE, turned(degrees, Vec3::UnitX()));
    joint.desc.limits[3] = {lower * degree, upper * degree, 1, 0};
    return error_of(joint).limit_angle;
  };
  EXPECT_EQ(beyond(-200, -209, 55), 0) << "a pose tells no -200 from 160";
  EXPECT_NEAR(beyond(-212, -209, 55), 3 * degree, near_zero);
  EXPECT_NEAR(beyond(60, -209, 55), 5 * degree, near_zero);
  EXPECT_EQ(beyond(250, -358, 358), 0);
}

TEST(Joints, Slider) {
  EXPECT_NEAR(error_of(PLUMB_JOINT_SLIDER, at(7, 0, 0)).position, 0, near_zero);
  Jointed joint = jointed(PLUMB_JOINT_SLIDER, turned(3, {1, 2, 3}, {7, 0.3, -0.4}));
  joint.desc.limits[0] = {-1, 6.5, 1, 0};
  EXPECT_NEAR(error_of(joint).position, 0.5, near_zero);
  EXPECT_NEAR(error_of(joint).angle, 3 * degree, near_zero);
  EXPECT_NEAR(error_of(joint).limit_position, 0.5, near_zero);
}

TEST(Joints, Distance) {
  Jointed joint = jointed(PLUMB_JOINT_DISTANCE, turned(70, {3, 1, 2}, {0.3, 0, 0.4}));
  joint.desc.rest_length = 0.6;
  EXPECT_NEAR(error_of(joint).position, 0.1, near_zero);
  joint.desc.limits[0] = {0.1, 0.45, 1, 0};
  EXPECT_EQ(error_of(joint).position, 0);
  EXPECT_NEAR(error_of(joint).limit_position, 0.05, near_zero);
}

TEST(Joints, SwingTwist) {
  Jointed joint = jointed(PLUMB_JOINT_SWING_TWIST, turned(70, {0, 0.6, 0.8}) * turned(-100, Vec3::UnitX()));
  const auto found = joint_coordinates(joint.desc, joint.a, joint.b);
  const double truth[6] = {0, 0, 0, -100 * degree, 42 * degree, 56 * degree};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(found[i], truth[i], near_zero);
  EXPECT_EQ(error_of(joint).limit_angle, 0);
  joint.desc.limits[4] = {-80 * degree, 80 * degree, 1, 0};
  joint.desc.limits[5] = {-40 * degree, 40 * degree, 1, 0};
  const double along = 1 / std::hypot(0.6 / 80, 0.8 / 40);  // the cone's half angle on this meridian, degrees
  EXPECT_NEAR(error_of(joint).limit_angle, (70 - along) * degree, near_zero);
  joint.desc.limits[5] = {-80 * degree, 80 * degree, 1, 0};
  EXPECT_EQ(error_of(joint).limit_angle, 0);
  joint.desc.limits[3] = {-97 * degree, 1, 1, 0};
  EXPECT_NEAR(error_of(joint).limit_angle, 3 * degree, near_zero);
  EXPECT_NEAR(error_of(PLUMB_JOINT_SWING_TWIST, turned(100, {1, 2, 3}, {0.3, 0, 0.4})).position, 0.5, near_zero);
}

TEST(Joints, Fixed) {
  const JointError off = error_of(PLUMB_JOINT_FIXED, turned(178, {1, 1, 0}, {0, 0, 2}));
  EXPECT_NEAR(off.position, 2, near_zero);
  EXPECT_NEAR(off.angle, 178 * degree, 1e-9);
}

TEST(Joints, Universal) {
  const Pose bent = turned(20, Vec3::UnitX()) * turned(30, Vec3::UnitY());
  EXPECT_NEAR(error_of(PLUMB_JOINT_UNIVERSAL, bent).angle, 0, near_zero);
  EXPECT_NEAR(error_of(PLUMB_JOINT_UNIVERSAL, turned(20, Vec3::UnitX()) * turned(4, Vec3::UnitZ())).angle, 4 * degree,
              near_zero);
}

TEST(Joints, Generic) {
  Jointed joint = jointed(PLUMB_JOINT_GENERIC, Pose{Mat3::Identity(), {0.3, 5, 0.4}} * turned(10, Vec3::UnitY()));
  const PlumbAxisMode modes[6] = {PLUMB_AXIS_LOCKED, PLUMB_AXIS_LIMITED, PLUMB_AXIS_LOCKED,
                                  PLUMB_AXIS_LOCKED, PLUMB_AXIS_FREE,    PLUMB_AXIS_LOCKED};
  std::copy(modes, modes + 6, joint.desc.axis_modes);
  joint.desc.limits[1] = {-1, 4.5, 0, 0};  // limited by its mode, whatever enabled says
  EXPECT_NEAR(error_of(joint).position, 0.5, near_zero);
  EXPECT_NEAR(error_of(joint).limit_position, 0.5, near_zero);
  EXPECT_NEAR(error_of(joint).angle, 0, near_zero);
  joint.desc.axis_modes[4] = PLUMB_AXIS_LOCKED;
  EXPECT_NEAR(error_of(joint).angle, 10 * degree, near_zero);
}

/// Two turns of which the third is locked are told apart all the way round: no angle jumps where the second is square.
TEST(Joints, TwoFreeTurnsHaveNoSingularPlace) {
  const Vec3 axes[] = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  for (std::size_t locked = 0; locked < 3; ++locked) {
    const std::size_t first = locked == 0 ? 1 : 0, second = locked == 2 ? 1 : 2;
    for (const double one : {-170, -100, -20, 0, 80, 95, 179})
      for (const double other : {-179, -95, -90, -30, 0, 90, 150}) {
        Jointed joint = jointed(PLUMB_JOINT_GENERIC, turned(one, axes[first]) * turned(other, axes[second]));
        for (PlumbAxisMode& mode : joint.desc.axis_modes) mode = PLUMB_AXIS_LOCKED;
        joint.desc.axis_modes[3 + first] = PLUMB_AXIS_LIMITED;
        joint.desc.axis_modes[3 + second] = PLUMB_AXIS_FREE;
        joint.desc.limits[3 + first] = {(one - 1) * degree, (one + 1) * degree, 1, 0};
        const auto found = joint_coordinates(joint.desc, joint.a, joint.b);
        EXPECT_NEAR(found[3 + first], one * degree, 1e-9);
        EXPECT_NEAR(found[3 + second], other * degree, 1e-9);
        EXPECT_NEAR(error_of(joint).angle, 0, 1e-7);
        EXPECT_EQ(error_of(joint).limit_angle, 0);
        if (locked != 2) continue;
        joint.desc.type = PLUMB_JOINT_UNIVERSAL;
        EXPECT_NEAR(joint_coordinates(joint.desc, joint.a, joint.b)[3], one * degree, 1e-9);
        EXPECT_NEAR(error_of(joint).angle, 0, 1e-7);
      }
  }
}

}  // namespace
}  // namespace plumb::referee::testing
