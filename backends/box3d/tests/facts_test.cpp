// What is known of Box3D and of how it is wrapped, and must stay known.
#include <gtest/gtest.h>

#include <numbers>

#include "plumb_scene.hpp"

namespace {

using namespace scenes;

constexpr PlumbFilter kSeesAll = {1, 0xffffffffu, 0, 0};

PlumbNeeds with(PlumbNeeds more) { return kNeeds | more; }

/// The weight of a tower lies in the normal impulses of its lowest contacts.
TEST(Box3d, ContactImpulsesCarryATower) {
  PlumbScene tower(scenes::tower(5), with(PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES));
  for (int i = 0; i < 120; ++i) advance(*tower.world);
  double pushed = 0;
  for (const PlumbContact& contact : tower.world->contacts())
    if (contact.body_a == tower.bodies[0] || contact.body_b == tower.bodies[0]) pushed += contact.normal_impulse;
  EXPECT_NEAR(pushed, 5 * 1000 * 9.81 / 60, 0.01 * 5 * 1000 * 9.81 / 60);
}

TEST(Box3d, RefusesAHullOfTooManyEdgesInWords) {
  const auto world = make_world(kNeeds);
  std::vector<double> vertices;
  for (int i = 0; i < 400; ++i) {  // Fibonacci's sphere
    const double y = 1 - (i + 0.5) / 200, ring = std::sqrt(1 - y * y), turn = i * std::numbers::pi * (3 - std::sqrt(5));
    vertices.insert(vertices.end(), {ring * std::cos(turn), y, ring * std::sin(turn)});
  }
  PlumbShapeDesc desc = plumb::shape_desc(PLUMB_CONVEX_HULL);
  desc.vertices = vertices.data();
  desc.vertex_count = 400;
  PlumbShape shape = 0;
  const PlumbResult result = world->create_shapes({&desc, 1}, {&shape, 1});
  if (result == PLUMB_OK) GTEST_SKIP() << "this Box3D thins out hulls";
  EXPECT_EQ(result, PLUMB_E_UNSUPPORTED);
  EXPECT_NE(world->error_text().find("400 vertices"), std::string::npos) << world->error_text();
}

/// More sides roll more smoothly: a prism of 6 soon stops where one of 42 goes on.
TEST(Box3d, SidesOfCylindersAreASetting) {
  const auto way_of = [](double sides) {
    const auto world = make_world(kNeeds, {number_setting("cylinder_sides", sides, PLUMB_SETTING_INT)});
    PlumbShapeDesc desc = plumb::shape_desc(PLUMB_CYLINDER);
    desc.radius = 0.5;
    desc.half_height = 0.5;
    PlumbBodyDesc ground = plumb::body_desc(PLUMB_STATIC);
    ground.shape = add_box(*world, {20, 0.5, 20});
    ground.pose.position = {0, -0.5, 0};
    add_body(*world, ground);
    PlumbBodyDesc roller = plumb::body_desc();
    roller.shape = add_shape(*world, desc);
    roller.pose = {{0, 0.55, 0}, {std::sqrt(0.5), 0, 0, std::sqrt(0.5)}};
    roller.linear_velocity = {1, 0, 0};
    roller.angular_velocity = {0, 0, -2};
    const PlumbBody body = add_body(*world, roller);
    for (int i = 0; i < 120; ++i) advance(*world);
    return read_row<7>(*world, PLUMB_FIELD_POSE, body)[0];
  };
  EXPECT_GT(way_of(42), way_of(6) + 0.2);
}

/// A ray tells a body in which it starts at fraction 0, as the capability's note says.
TEST(Box3d, RaysFromWithinHitAtTheStart) {
  const auto world = make_world(with(PLUMB_NEED_QUERIES));
  for (const PlumbShape shape : {add_sphere(*world, 1), add_box(*world, {1, 1, 1})}) {
    const PlumbBody body = add_body(*world, frictionless(PLUMB_STATIC, shape, {0, 0, 0}));
    const PlumbRay ray = {{0.1, 0.2, 0.3}, {0, 5, 0}, kSeesAll};
    const plumb::Hits hits = world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
    ASSERT_EQ(hits.hits.size(), 1u);
    EXPECT_EQ(hits.hits[0].body, body);
    EXPECT_EQ(hits.hits[0].fraction, 0);
    plumb::check(*world, world->destroy_bodies({&body, 1}));
  }
}

/// Box3D ends casts at its slop of 5 mm; the adapter brings them to the touch.
TEST(Box3d, CastsEndWhereShapesTouch) {
  const auto world = make_world(with(PLUMB_NEED_QUERIES));
  add_body(*world, frictionless(PLUMB_STATIC, add_box(*world, {5, 1, 5}), {0, -1, 0}));
  for (const PlumbShape shape : {add_sphere(*world, 0.5), add_box(*world, {0.5, 0.5, 0.5})}) {
    const PlumbCast cast = {shape, {{0, 4.5, 0}, {0, 0, 0, 1}}, {0, -8, 0}, kSeesAll};
    const plumb::Hits hits = world->queries()->cast_shapes(PLUMB_HIT_CLOSEST, {&cast, 1});
    EXPECT_NEAR(hits.hits[0].fraction, 0.5, 1e-5);
    EXPECT_NEAR(hits.hits[0].position.y, 0, 1e-4);
    EXPECT_NEAR(hits.hits[0].normal.y, 1, 1e-4);
  }
}

/// The wheel that stands for a universal joint keeps a's x square to b's y and the origins together.
TEST(Box3d, UniversalJointsHoldUnderAWeight) {
  const auto world = make_world(with(PLUMB_NEED_JOINTS));
  PlumbBodyDesc desc = plumb::body_desc();
  desc.shape = add_box(*world, {0.5, 0.1, 0.1});
  desc.pose.position = {0.5, 0, 0.3};
  desc.angular_velocity = {3, 0, 1};
  const PlumbBody body = add_body(*world, desc);
  PlumbJointDesc joint = plumb::joint_desc(PLUMB_JOINT_UNIVERSAL);
  joint.body_b = body;
  joint.frame_b.position = {-0.5, 0, -0.3};
  PlumbJoint id = 0;
  plumb::check(*world, world->joints()->create_joints({&joint, 1}, {&id, 1}));
  for (int i = 0; i < 240; ++i) {
    advance(*world);
    std::array<double, 6> at{};
    plumb::check(*world,
                 world->joints()->read_joints(PLUMB_JOINT_COORDINATES, {&id, 1}, plumb::rows_over(std::span(&at, 1))));
    EXPECT_LT(std::hypot(at[0], at[1], at[2]), 1e-2) << i;
    EXPECT_LT(std::abs(std::sin(at[5])), 6e-2) << i;  // half a turn is the same axis
  }
}

TEST(Box3d, LimitsThatAJointHasNotAreRefused) {
  const auto world = make_world(with(PLUMB_NEED_JOINTS));
  const PlumbBody body = add_body(*world, frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 0, 0}));
  PlumbJointDesc joint = plumb::joint_desc(PLUMB_JOINT_BALL);
  joint.body_b = body;
  joint.limits[4] = {-1, 1, 1, 0};
  PlumbJoint id = 0;
  EXPECT_EQ(world->joints()->create_joints({&joint, 1}, {&id, 1}), PLUMB_E_UNSUPPORTED);
  EXPECT_NE(world->error_text().find("limit"), std::string::npos) << world->error_text();
}

TEST(Box3d, NumbersBeyondFloatAreRefused) {
  const auto world = make_world(kNeeds);
  PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 1e300, 0});
  PlumbBody body = 0;
  EXPECT_EQ(world->create_bodies({&desc, 1}, {&body, 1}), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_NE(world->error_text().find("pose.position"), std::string::npos) << world->error_text();
}

}  // namespace
