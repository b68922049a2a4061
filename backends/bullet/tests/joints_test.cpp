// Joints: each type holds what it should and leaves free what it should; limits, motors, springs, reactions, breaking.
#include <gtest/gtest.h>

#include <cmath>

#include "plumb_scene.hpp"

namespace {

constexpr PlumbNeeds kJointNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_JOINTS | PLUMB_NEED_JOINT_REACTIONS |
                                   PLUMB_NEED_EVENTS | PLUMB_NEED_FORCES | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;

/// A cube of 8 kg and side 1 that hangs on one joint to the world.
struct Hung {
  explicit Hung(PlumbJointDesc desc, bool gravity = false, PlumbVec3 at = {0, 0, 0}, PlumbVec3 velocity = {},
                PlumbVec3 spin = {})
      : world(scenes::make_world(kJointNeeds)) {
    plumb::check(*world, world->set_gravity(gravity ? PlumbVec3{0, -9.81, 0} : PlumbVec3{0, 0, 0}));
    PlumbBodyDesc cube = plumb::body_desc();
    cube.shape = scenes::add_box(*world, {0.5, 0.5, 0.5});
    cube.density = 8;
    cube.pose.position = at;
    cube.linear_velocity = velocity;
    cube.angular_velocity = spin;
    body = scenes::add_body(*world, cube);
    desc.body_b = body;
    plumb::check(*world, world->joints()->create_joints({&desc, 1}, {&joint, 1}));
  }
  std::array<double, 6> coordinates() { return row(PLUMB_JOINT_COORDINATES); }
  std::array<double, 6> row(PlumbJointField field) {
    std::array<double, 6> values{};
    plumb::check(*world, world->joints()->read_joints(field, {&joint, 1}, plumb::rows_over(std::span(&values, 1))));
    return values;
  }
  void run(int steps) {
    for (int i = 0; i < steps; ++i) scenes::advance(*world);
  }
  std::unique_ptr<plumb::IPhysicsWorld> world;
  PlumbBody body = 0;
  PlumbJoint joint = 0;
};

/// Kicked in every direction, a joint's locked axes stay at 0 and its free ones move.
void expect_free(PlumbJointDesc desc, std::array<bool, 6> free) {
  Hung hung(desc, false, {0, 0, 0}, {0.3, 0.4, 0.5}, {0.6, 0.7, 0.8});
  hung.run(30);
  const auto at = hung.coordinates();
  for (std::size_t axis = 0; axis < 6; ++axis) {
    if (free[axis])
      EXPECT_GT(std::abs(at[axis]), 0.05) << "axis " << axis;
    else
      EXPECT_LT(std::abs(at[axis]), 0.01) << "axis " << axis;
  }
}

TEST(Joints, LeaveTheirFreeAxesFree) {
  expect_free(plumb::joint_desc(PLUMB_JOINT_BALL), {false, false, false, true, true, true});
  expect_free(plumb::joint_desc(PLUMB_JOINT_HINGE), {false, false, false, true, false, false});
  expect_free(plumb::joint_desc(PLUMB_JOINT_SLIDER), {true, false, false, false, false, false});
  expect_free(plumb::joint_desc(PLUMB_JOINT_FIXED), {false, false, false, false, false, false});
  expect_free(plumb::joint_desc(PLUMB_JOINT_UNIVERSAL), {false, false, false, true, true, false});
  PlumbJointDesc generic = plumb::joint_desc(PLUMB_JOINT_GENERIC);
  generic.axis_modes[1] = generic.axis_modes[5] = PLUMB_AXIS_LOCKED;
  expect_free(generic, {true, false, true, true, true, false});
}

TEST(Joints, MotorsDriveTheirAxisTheRightWay) {
  const auto drive = [](PlumbJointType type, std::size_t axis, double velocity) {
    PlumbJointDesc desc = plumb::joint_desc(type);
    desc.motors[axis] = {velocity, 1000, 1, 0};
    if (type == PLUMB_JOINT_GENERIC)
      for (std::size_t i = 0; i < 6; ++i) desc.axis_modes[i] = i == axis ? PLUMB_AXIS_FREE : PLUMB_AXIS_LOCKED;
    Hung hung(desc);
    hung.run(60);
    EXPECT_NEAR(hung.coordinates()[axis], velocity, 0.02 * std::abs(velocity)) << "type " << type << " axis " << axis;
  };
  drive(PLUMB_JOINT_HINGE, 3, 0.7);
  drive(PLUMB_JOINT_HINGE, 3, -0.7);
  drive(PLUMB_JOINT_SLIDER, 0, 0.5);
  drive(PLUMB_JOINT_UNIVERSAL, 4, 0.5);
  for (std::size_t axis = 0; axis < 6; ++axis) drive(PLUMB_JOINT_GENERIC, axis, 0.6);
}

TEST(Joints, MotorsStopAtTheirForce) {
  PlumbJointDesc desc = plumb::joint_desc(PLUMB_JOINT_SLIDER);
  desc.motors[0] = {1, 4, 1, 0};  // 4 N on 8 kg: .5 m/s2
  Hung slider(desc);
  slider.run(60);
  EXPECT_NEAR(scenes::read_row<6>(*slider.world, PLUMB_FIELD_VELOCITY, slider.body)[0], 0.5, 0.01);
  desc = plumb::joint_desc(PLUMB_JOINT_HINGE);
  desc.motors[3] = {10, 4.0 / 3, 1, 0};  // 4/3 N m on 4/3 kg m2: 1 rad/s2
  Hung hinge(desc);
  hinge.run(60);
  EXPECT_NEAR(scenes::read_row<6>(*hinge.world, PLUMB_FIELD_VELOCITY, hinge.body)[3], 1, 0.02);
}

TEST(Joints, LimitsHold) {
  const auto push = [](PlumbJointType type, std::size_t axis, double speed) {
    PlumbJointDesc desc = plumb::joint_desc(type);
    desc.limits[axis] = {-0.2, 0.3, 1, 0};
    if (type == PLUMB_JOINT_GENERIC) {
      for (PlumbAxisMode& mode : desc.axis_modes) mode = PLUMB_AXIS_LOCKED;
      desc.axis_modes[axis] = PLUMB_AXIS_LIMITED;
    }
    PlumbVec3 velocity{}, spin{};
    double* components[6] = {&velocity.x, &velocity.y, &velocity.z, &spin.x, &spin.y, &spin.z};
    *components[axis] = speed;
    Hung hung(desc, false, {0, 0, 0}, velocity, spin);
    double farthest = 0;
    for (int i = 0; i < 120; ++i) {
      hung.run(1);
      const double now = hung.coordinates()[axis];
      if (std::abs(now) > std::abs(farthest)) farthest = now;
    }
    EXPECT_NEAR(farthest, speed > 0 ? 0.3 : -0.2, 0.02) << "type " << type << " axis " << axis << " speed " << speed;
  };
  for (const double speed : {-1.0, 1.0}) {
    push(PLUMB_JOINT_HINGE, 3, speed);
    push(PLUMB_JOINT_SLIDER, 0, speed);
    push(PLUMB_JOINT_UNIVERSAL, 3, speed);
    for (std::size_t axis = 0; axis < 6; ++axis) push(PLUMB_JOINT_GENERIC, axis, speed);
  }
}

TEST(Joints, DistanceIsRigidOrLimited) {
  PlumbJointDesc desc = plumb::joint_desc(PLUMB_JOINT_DISTANCE);
  desc.rest_length = 2;
  Hung pendulum(desc, true, {2, 0, 0});
  double worst = 0;
  const auto distance = [](Hung& hung) {
    const auto at = scenes::read_row<7>(*hung.world, PLUMB_FIELD_POSE, hung.body);
    return std::hypot(at[0], at[1], at[2]);
  };
  for (int i = 0; i < 120; ++i) {
    pendulum.run(1);
    worst = std::max(worst, std::abs(distance(pendulum) - 2));
  }
  EXPECT_LT(worst, 0.03);
  desc.limits[0] = {1, 2, 1, 0};
  Hung away(desc, false, {1.5, 0, 0}, {3, 0, 0});
  away.run(60);
  EXPECT_NEAR(distance(away), 2, 0.01);
  Hung nearer(desc, false, {1.5, 0, 0}, {-3, 0, 0});
  nearer.run(60);
  EXPECT_NEAR(distance(nearer), 1, 0.01);
}

/// Times ten swings of an undamped spring, and looks whether the tenth is as wide as the first.
void expect_oscillation(Hung& hung, std::size_t axis, double frequency) {
  std::vector<double> crossings, peaks;
  double before = hung.coordinates()[axis], peak = 0;
  constexpr double dt = 1.0 / 240;
  for (int step = 1; crossings.size() < 11 && step < 24000; ++step) {
    scenes::advance(*hung.world, dt);
    const double now = hung.coordinates()[axis];
    if (before < 0 && now >= 0) {
      crossings.push_back((step - now / (now - before)) * dt);
      peaks.push_back(peak);
      peak = 0;
    }
    peak = std::max(peak, std::abs(now));
    before = now;
  }
  ASSERT_EQ(crossings.size(), 11u);
  EXPECT_NEAR(10 / (crossings.back() - crossings.front()), frequency, 0.01 * frequency) << "axis " << axis;
  EXPECT_NEAR(peaks.back() / peaks[1], 1, 0.02) << "axis " << axis;
}

TEST(Joints, SpringsHaveTheirFrequency) {
  PlumbJointDesc slider = plumb::joint_desc(PLUMB_JOINT_SLIDER);
  slider.springs[0] = {0, 2, 0, 1, 0};
  Hung linear(slider, false, {0.2, 0, 0});
  expect_oscillation(linear, 0, 2);
  PlumbJointDesc hinge = plumb::joint_desc(PLUMB_JOINT_HINGE);
  hinge.springs[3] = {0, 1.5, 0, 1, 0};
  Hung angular(hinge, false, {0, 0, 0}, {}, {1, 0, 0});
  expect_oscillation(angular, 3, 1.5);
}

TEST(Joints, CriticalSpringsDoNotSwing) {
  PlumbJointDesc distance = plumb::joint_desc(PLUMB_JOINT_DISTANCE);
  distance.rest_length = 1;
  distance.springs[0] = {0, 3, 1, 1, 0};
  Hung hung(distance, false, {1.5, 0, 0});
  double least = 2;
  for (int i = 0; i < 180; ++i) {
    hung.run(1);
    least = std::min(least, scenes::read_row<7>(*hung.world, PLUMB_FIELD_POSE, hung.body)[0]);
  }
  EXPECT_GT(least, 0.995);
  EXPECT_NEAR(scenes::read_row<7>(*hung.world, PLUMB_FIELD_POSE, hung.body)[0], 1, 1e-3);
}

TEST(Joints, ReactionsCarryTheWeight) {
  for (const PlumbJointType type : {PLUMB_JOINT_BALL, PLUMB_JOINT_HINGE, PLUMB_JOINT_SLIDER, PLUMB_JOINT_FIXED,
                                    PLUMB_JOINT_UNIVERSAL, PLUMB_JOINT_DISTANCE}) {
    PlumbJointDesc desc = plumb::joint_desc(type);
    desc.frame_a.position = {0, 2, 0};
    desc.rest_length = 2;
    if (type != PLUMB_JOINT_DISTANCE) desc.frame_b.position = {0, 2, 0};
    Hung hung(desc, true);
    hung.run(60);
    const auto reaction = hung.row(PLUMB_JOINT_REACTION);
    EXPECT_NEAR(reaction[1], 8 * 9.81, 0.5) << "type " << type;
    EXPECT_NEAR(std::hypot(reaction[0], reaction[2]), 0, 0.5) << "type " << type;
  }
}

TEST(Joints, FixedArmsBearTheirTorque) {
  PlumbJointDesc desc = plumb::joint_desc(PLUMB_JOINT_FIXED);
  desc.frame_b.position = {-1, 0, 0};
  Hung hung(desc, true, {1, 0, 0});
  hung.run(120);
  const auto reaction = hung.row(PLUMB_JOINT_REACTION);
  EXPECT_NEAR(reaction[1], 8 * 9.81, 1);
  EXPECT_NEAR(reaction[5], 8 * 9.81 * 1, 1);  // about frame b, whose lever to the weight is 1 m
}

TEST(Joints, BreakAboveTheirForceAndSaySo) {
  PlumbJointDesc desc = plumb::joint_desc(PLUMB_JOINT_BALL);
  desc.break_force = 100;  // the weight is 78.5 N
  Hung hung(desc, true);
  hung.run(60);
  EXPECT_EQ(hung.coordinates().size(), 6u);
  const std::array<double, 3> pull{0, -40, 0};
  scenes::write_row(*hung.world, PLUMB_FIELD_FORCE, hung.body, pull);
  scenes::advance(*hung.world);
  const auto events = hung.world->events();
  ASSERT_EQ(events.size(), 1u);
  EXPECT_EQ(events[0].type, PLUMB_EVENT_JOINT_BROKEN);
  EXPECT_EQ(events[0].joint, hung.joint);
  EXPECT_EQ(hung.world->joints()->destroy_joints({&hung.joint, 1}), PLUMB_E_STALE_HANDLE);
  const double y = scenes::read_row<7>(*hung.world, PLUMB_FIELD_POSE, hung.body)[1];
  hung.run(60);
  EXPECT_LT(scenes::read_row<7>(*hung.world, PLUMB_FIELD_POSE, hung.body)[1], y - 4);
}

TEST(Joints, ConnectedBodiesTouchOnlyWhenTold) {
  for (const std::uint32_t collide : {0u, 1u}) {
    auto world = scenes::make_world(kJointNeeds | PLUMB_NEED_CONTACTS);
    plumb::check(*world, world->set_gravity({0, 0, 0}));
    const PlumbShape shape = scenes::add_box(*world, {0.5, 0.5, 0.5});
    const PlumbBody a = scenes::add_body(*world, scenes::frictionless(PLUMB_DYNAMIC, shape, {0, 0, 0}));
    const PlumbBody b = scenes::add_body(*world, scenes::frictionless(PLUMB_DYNAMIC, shape, {0.99, 0, 0}));
    scenes::advance(*world);
    EXPECT_FALSE(world->contacts().empty());
    PlumbJointDesc desc = plumb::joint_desc(PLUMB_JOINT_BALL);
    desc.body_a = a;
    desc.body_b = b;
    desc.frame_a.position = {0.495, 0, 0};
    desc.frame_b.position = {-0.495, 0, 0};
    desc.collide_connected = collide;
    PlumbJoint joint = 0;
    plumb::check(*world, world->joints()->create_joints({&desc, 1}, {&joint, 1}));
    scenes::advance(*world);
    EXPECT_EQ(world->contacts().empty(), collide == 0);
    plumb::check(*world, world->joints()->destroy_joints({&joint, 1}));
    scenes::advance(*world);
    EXPECT_FALSE(world->contacts().empty());
  }
}

}  // namespace
