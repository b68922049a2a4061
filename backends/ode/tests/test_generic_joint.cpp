// The generic joint, which the adapter makes of rows: each axis locked, limited, driven and sprung, whichever body is
// free and with both steppers.
#include <gtest/gtest.h>

#include <cmath>

#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

constexpr PlumbNeeds needs =
    PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS | PLUMB_NEED_JOINT_REACTIONS | PLUMB_NEED_FRICTION | PLUMB_NEED_EVENTS;

enum class Free { b_of_world, b_of_static, a_of_static, both };

struct Case {
  std::size_t axis;
  Free free;
  const char* stepper;
};

/// Two cubes of 1 m whose frames lie askew at a corner, all axes locked.
struct Jointed {
  Jointed(Free free, const char* stepper, PlumbVec3 gravity = {0, 0, 0}) : world(needs, {setting("stepper", stepper)}) {
    check(*world, world->set_gravity(gravity));
    const auto fixed = [&] { return world.fixed(world.box(.1, .1, .1)); };
    const auto loose = [&] { return world.dynamic(world.box(.5, .5, .5), {0, 0, 0}); };
    if (free == Free::b_of_static) desc.body_a = fixed();
    if (free == Free::a_of_static || free == Free::both) desc.body_a = loose();
    desc.body_b = free == Free::a_of_static ? fixed() : loose();
    desc.frame_a = desc.frame_b = {{.5, .5, .5}, {.5, -.1, .3, std::sqrt(1 - .35)}};
    for (PlumbAxisMode& mode : desc.axis_modes) mode = PLUMB_AXIS_LOCKED;
  }
  void make() { joint = world.joint(desc); }
  [[nodiscard]] std::vector<double> coordinates() const { return world.row(joint, PLUMB_JOINT_COORDINATES, 6); }
  /// The axis is there, and the locked ones are at 0.
  void expect_at(std::size_t axis, double value, double tolerance) const {
    const auto at = coordinates();
    EXPECT_NEAR(at[axis], value, tolerance);
    for (std::size_t other = 0; other < 6; ++other) {
      if (other == axis) continue;
      EXPECT_NEAR(at[other], 0, .01) << "locked axis " << other;
    }
  }
  void motor(std::size_t axis, double speed, double force) const {
    double row[12] = {};
    row[2 * axis] = speed;
    row[2 * axis + 1] = force;
    const ConstRows rows(reinterpret_cast<const std::byte*>(row), 1, sizeof row, PLUMB_F64);
    check(*world, world->joints()->write_joints(PLUMB_JOINT_MOTOR, {&joint, 1}, rows));
  }

  TestWorld world;
  PlumbJointDesc desc = joint_desc(PLUMB_JOINT_GENERIC);
  PlumbJoint joint = 0;
};

class GenericAxes : public testing::TestWithParam<Case> {};

TEST_P(GenericAxes, MotorThenLimitsMoveTheCoordinateAsTold) {
  const auto [axis, free, stepper] = GetParam();
  Jointed jointed(free, stepper);
  jointed.desc.axis_modes[axis] = PLUMB_AXIS_LIMITED;
  jointed.desc.limits[axis] = {-.2, .3, 1, 0};
  jointed.desc.motors[axis] = {.5, 1e6, 1, 0};
  jointed.make();
  jointed.world.step(24);
  jointed.expect_at(axis, .2, .02);
  jointed.motor(axis, .5, 500);  // what a stop must hold against
  jointed.world.step(120);
  jointed.expect_at(axis, .3, .02);
  jointed.motor(axis, -.5, 500);
  jointed.world.step(240);
  jointed.expect_at(axis, -.2, .02);
  jointed.motor(axis, 0, 0);
  jointed.world.step(60);
  jointed.expect_at(axis, -.2, .02);
}

TEST_P(GenericAxes, SpringComesToRest) {
  const auto [axis, free, stepper] = GetParam();
  Jointed jointed(free, stepper);
  jointed.desc.axis_modes[axis] = PLUMB_AXIS_FREE;
  jointed.desc.springs[axis] = {.3, 1, 1, 1, 0};
  jointed.make();
  jointed.world.step(30);
  EXPECT_GT(jointed.coordinates()[axis], .1);  // on its way
  EXPECT_LT(jointed.coordinates()[axis], .3);
  jointed.world.step(180);
  jointed.expect_at(axis, .3, .01);
}

std::string case_name(const testing::TestParamInfo<Case>& info) {
  constexpr const char* names[] = {"b_of_world", "b_of_static", "a_of_static", "both"};
  return "axis" + std::to_string(info.param.axis) + "_" + names[static_cast<int>(info.param.free)] + "_" +
         info.param.stepper;
}

std::vector<Case> every_case() {
  std::vector<Case> all;
  for (std::size_t axis = 0; axis < 6; ++axis)
    for (const Free free : {Free::b_of_world, Free::b_of_static, Free::a_of_static, Free::both})
      for (const char* stepper : {"quickstep", "step"}) all.push_back({axis, free, stepper});
  return all;
}

INSTANTIATE_TEST_SUITE_P(Every, GenericAxes, testing::ValuesIn(every_case()), case_name);

/// A motor is no stronger than told: along an axis 1000 N move 1000 kg by half a metre in the first second.
TEST(Generic, MotorForceIsBounded) {
  Jointed jointed(Free::b_of_world, "quickstep");
  jointed.desc.axis_modes[1] = PLUMB_AXIS_FREE;
  jointed.desc.motors[1] = {100, 1000, 1, 0};
  jointed.make();
  jointed.world.step(60);
  jointed.expect_at(1, .5, .02);
}

/// With y turned by a radian the axes of x and z lean towards each other: z stays locked while x is driven, at its
/// speed.
TEST(Generic, TurnsAreAboutXThenYThenZ) {
  Jointed jointed(Free::b_of_world, "step");
  jointed.desc.axis_modes[4] = PLUMB_AXIS_LIMITED;
  jointed.desc.limits[4] = {1, 1, 1, 0};
  jointed.desc.axis_modes[3] = PLUMB_AXIS_FREE;
  jointed.make();
  jointed.world.step(120);
  jointed.motor(3, .5, 1e5);
  jointed.world.step(30);
  const double start = jointed.coordinates()[3];
  jointed.world.step(60);
  const auto at = jointed.coordinates();
  EXPECT_NEAR(at[3] - start, .5, .01);
  EXPECT_NEAR(at[4], 1, .02);
  EXPECT_NEAR(at[5], 0, .02);
  for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_NEAR(at[axis], 0, .01);
}

/// All axes locked, it carries like a fixed joint: force and the torque about frame b.
TEST(Generic, ReactionIsThatOfAFixedJoint) {
  for (const Free free : {Free::b_of_world, Free::a_of_static}) {
    Jointed jointed(free, "step", {0, -10, 0});
    jointed.make();
    jointed.world.step(60);
    const auto r = jointed.world.row(jointed.joint, PLUMB_JOINT_REACTION, 6);
    const double weight = free == Free::b_of_world ? 1e4 : -1e4;
    EXPECT_NEAR(r[0], 0, 10);
    EXPECT_NEAR(r[1], weight, 10);
    EXPECT_NEAR(r[2], 0, 10);
    EXPECT_NEAR(r[3], .5 * weight, 20);
    EXPECT_NEAR(r[4], 0, 20);
    EXPECT_NEAR(r[5], -.5 * weight, 20);
  }
}

TEST(Generic, BreaksAboveItsForce) {
  for (const double strength : {5e3, 2e4}) {
    Jointed jointed(Free::b_of_world, "quickstep", {0, -10, 0});
    jointed.desc.break_force = strength;
    jointed.make();
    EXPECT_EQ(jointed.world.step(30).joints, strength < 1e4 ? 0u : 1u);
  }
}

TEST(Generic, ASpringLeavesNoRoomForALimit) {
  Jointed jointed(Free::b_of_world, "quickstep");
  jointed.desc.axis_modes[2] = PLUMB_AXIS_LIMITED;
  jointed.desc.springs[2] = {0, 1, 1, 1, 0};
  EXPECT_EQ(jointed.world->joints()->create_joints({&jointed.desc, 1}, {&jointed.joint, 1}), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(jointed.world->error_text().find("axis 2"), std::string::npos);
}

}  // namespace
}  // namespace plumb::ode_test
