// Joints: those of a tree are coordinates, those that close a loop are rows.
#include <gtest/gtest.h>

#include "plumb_scene.hpp"

namespace {

using namespace scenes;

PlumbNeeds with(PlumbNeeds more) { return kNeeds | more; }

std::array<double, 6> coordinates(plumb::IPhysicsWorld& world, PlumbJoint joint) {
  std::array<double, 6> at{};
  plumb::check(world,
               world.joints()->read_joints(PLUMB_JOINT_COORDINATES, {&joint, 1}, plumb::rows_over(std::span(&at, 1))));
  return at;
}

double gap(plumb::IPhysicsWorld& world, PlumbJoint joint) {
  const auto at = coordinates(world, joint);
  return std::hypot(at[0], at[1], at[2]);
}

/// Where each joint were a constraint between free bodies, so heavy a weight would pull it open by millimetres.
TEST(Dart, JointsOfATreeDoNotGape) {
  PlumbScene scene(chain(10));
  for (int i = 0; i < 120; ++i) advance(*scene.world);
  for (const PlumbJoint joint : scene.joints) EXPECT_LT(gap(*scene.world, joint), 1e-9);
}

/// Two points on rods of a metre, let go level: by the Lagrangian both begin to fall with g, as the outer rod's angular
/// acceleration begins with 0; afterwards the rods keep their lengths, and the points their energy.
TEST(Dart, ADoublePendulumObeysItsLagrangian) {
  const auto world = make_world(with(0), {number_setting("substeps", 1, PLUMB_SETTING_INT)});
  const PlumbShape ball = add_sphere(*world, 0.1);
  PlumbBody bodies[2];
  for (int i = 0; i < 2; ++i) {
    PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, ball, {1.0 + i, 0, 0});
    desc.mass_mode = PLUMB_MASS_EXPLICIT;
    desc.mass = i == 0 ? 2 : 3;
    desc.inertia = {1e-9, 1e-9, 1e-9};
    bodies[i] = add_body(*world, desc);
    PlumbJointDesc joint = plumb::joint_desc(PLUMB_JOINT_HINGE);
    joint.body_a = i == 0 ? 0 : bodies[0];
    joint.body_b = bodies[i];
    joint.frame_b.position = {-1, 0, 0};
    joint.frame_a.orientation = joint.frame_b.orientation = x_to_z();
    PlumbJoint id = 0;
    plumb::check(*world, world->joints()->create_joints({&joint, 1}, {&id, 1}));
  }
  const double dt = 1e-4;
  advance(*world, dt);
  EXPECT_NEAR(read_row<6>(*world, PLUMB_FIELD_VELOCITY, bodies[0])[1], -9.81 * dt, 1e-9);
  EXPECT_NEAR(read_row<6>(*world, PLUMB_FIELD_VELOCITY, bodies[1])[1], -9.81 * dt, 1e-9);
  for (int i = 1; i < 10000; ++i) advance(*world, dt);
  const auto one = read_row<7>(*world, PLUMB_FIELD_POSE, bodies[0]),
             two = read_row<7>(*world, PLUMB_FIELD_POSE, bodies[1]);
  EXPECT_NEAR(std::hypot(one[0], one[1]), 1, 1e-9) << "the length of the inner rod";
  EXPECT_NEAR(std::hypot(two[0] - one[0], two[1] - one[1]), 1, 1e-9) << "the length of the outer rod";
  const auto v1 = read_row<6>(*world, PLUMB_FIELD_VELOCITY, bodies[0]),
             v2 = read_row<6>(*world, PLUMB_FIELD_VELOCITY, bodies[1]);
  const double kinetic = (v1[0] * v1[0] + v1[1] * v1[1]) + 1.5 * (v2[0] * v2[0] + v2[1] * v2[1]);
  EXPECT_NEAR(kinetic + 9.81 * (2 * one[1] + 3 * two[1]), 0, 0.05) << "energy, J, of some 100 that went to and fro";
}

PlumbResult join(plumb::IPhysicsWorld& world, PlumbJointType type, PlumbBody a, PlumbBody b, double at,
                 int limited_axis = -1) {
  PlumbJointDesc desc = plumb::joint_desc(type);
  desc.body_a = a;
  desc.body_b = b;
  desc.frame_a.position = {a == 0 ? at : 0.5, 0, 0};
  desc.frame_b.position = {a == 0 && at > 0 ? 0.5 : -0.5, 0, 0};
  if (limited_axis >= 0) desc.limits[limited_axis] = {-1, 1, 1, 0};
  PlumbJoint id = 0;
  return world.joints()->create_joints({&desc, 1}, {&id, 1});
}

/// A bridge of two beams between two walls: its last joint closes a loop.
TEST(Dart, LoopsAreClosedByJointsOfWhichNothingElseIsAsked) {
  const auto world = make_world(with(PLUMB_NEED_JOINTS));
  PlumbBodyDesc beam = frictionless(PLUMB_DYNAMIC, add_box(*world, {0.5, 0.1, 0.1}), {0.5, 0, 0});
  beam.linear_velocity = {1, 0, 0};
  const PlumbBody one = add_body(*world, beam);
  beam.pose.position.x = 1.5;
  const PlumbBody two = add_body(*world, beam);
  ASSERT_EQ(join(*world, PLUMB_JOINT_SLIDER, 0, one, 0, 0), PLUMB_OK);
  ASSERT_EQ(join(*world, PLUMB_JOINT_HINGE, one, two, 0, 3), PLUMB_OK);
  EXPECT_EQ(join(*world, PLUMB_JOINT_SLIDER, 0, two, 2, 0), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(world->error_text().find("a slider joint"), std::string::npos) << world->error_text();
  EXPECT_NE(world->error_text().find("loop"), std::string::npos) << world->error_text();
  ASSERT_EQ(join(*world, PLUMB_JOINT_BALL, 0, two, 2), PLUMB_OK);
  for (int i = 0; i < 120; ++i) advance(*world);
  const auto pose = read_row<7>(*world, PLUMB_FIELD_POSE, two);
  EXPECT_NEAR(pose[0], 1.5, 1e-4) << "the ball at the far wall keeps the bridge from sliding";
  EXPECT_NEAR(pose[1], 0, 1e-4);
}

/// A universal joint is two of DART's with a node between them, which weighs next to nothing: about its first axis
/// alone it swings as a hinge does.
TEST(Dart, NodesBetweenJointsWeighNothing) {
  const auto swing = [](PlumbJointType type) {
    const auto world = make_world(with(0));
    PlumbJointDesc desc = plumb::joint_desc(type);
    desc.body_b = add_body(*world, frictionless(PLUMB_DYNAMIC, add_box(*world, {0.1, 0.2, 0.3}), {0, 0, 1}));
    desc.frame_b.position = {0, 0, -1};
    PlumbJoint id = 0;
    plumb::check(*world, world->joints()->create_joints({&desc, 1}, {&id, 1}));
    for (int i = 0; i < 60; ++i) advance(*world);
    return coordinates(*world, id)[3];
  };
  EXPECT_NEAR(swing(PLUMB_JOINT_UNIVERSAL), swing(PLUMB_JOINT_HINGE), 1e-9);
}

/// Springs are PD controllers whose targets are written while the skeleton lives, of rods too.
TEST(Dart, SpringsGoWhereTheyAreTold) {
  const auto world = make_world(with(0));
  PlumbJointDesc desc = plumb::joint_desc(PLUMB_JOINT_HINGE);
  desc.body_b = add_body(*world, frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.1), {0, 0, 0}));
  desc.springs[3] = {0.2, 4, 1, 1, PLUMB_SPRING_FREQUENCY};
  PlumbJoint hinge = 0, rod = 0;
  plumb::check(*world, world->joints()->create_joints({&desc, 1}, {&hinge, 1}));
  desc.type = PLUMB_JOINT_DISTANCE;
  desc.body_b = add_body(*world, frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.1), {5, -1, 0}));
  desc.frame_a.position = {5, 0, 0};
  desc.springs[0] = {0, 4, 1, 1, PLUMB_SPRING_FREQUENCY};
  desc.rest_length = 1;
  plumb::check(*world, world->joints()->create_joints({&desc, 1}, {&rod, 1}));
  const double sag = 9.81 / std::pow(2 * std::numbers::pi * 4, 2);
  for (const double target : {0.2, 0.7}) {
    const std::array<double, 6> turn{0, 0, 0, target, 0, 0}, length{1 + target, 0, 0, 0, 0, 0};
    const auto told = [](const std::array<double, 6>& row) {
      return plumb::const_rows_over(std::span<const std::array<double, 6>>(&row, 1));
    };
    plumb::check(*world, world->joints()->write_joints(PLUMB_JOINT_SPRING_REST, {&hinge, 1}, told(turn)));
    plumb::check(*world, world->joints()->write_joints(PLUMB_JOINT_SPRING_REST, {&rod, 1}, told(length)));
    for (int i = 0; i < 120; ++i) advance(*world);
    EXPECT_NEAR(coordinates(*world, hinge)[3], target, 1e-4);
    EXPECT_NEAR(coordinates(*world, rod)[0], 1 + target + sag, 1e-4);
  }
}

/// Bodies that come make all skeletons anew; those that were there go on as if nothing had been.
TEST(Dart, BodiesGoOnWhereOthersCome) {
  PlumbScene left(chain(4)), joined(chain(4));
  for (int i = 0; i < 60; ++i) {
    if (i == 30) add_body(*joined.world, frictionless(PLUMB_DYNAMIC, add_sphere(*joined.world, 0.5), {100, 0, 0}));
    advance(*left.world);
    advance(*joined.world);
  }
  for (std::size_t i = 0; i < left.bodies.size(); ++i) {
    const auto a = read_row<7>(*left.world, PLUMB_FIELD_POSE, left.bodies[i]),
               b = read_row<7>(*joined.world, PLUMB_FIELD_POSE, joined.bodies[i]);
    for (std::size_t k = 0; k < 7; ++k) EXPECT_NEAR(a[k], b[k], 1e-9) << "body " << i << ", number " << k;
  }
}

}  // namespace
