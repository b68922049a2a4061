// Contacts, materials, filters, sensors, events and queries.
#include <gtest/gtest.h>

#include <cmath>

#include "plumb_program.hpp"

namespace plumb::ode_test {
namespace {

constexpr PlumbNeeds needs = usual_needs | PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES | PLUMB_NEED_EVENTS |
                             PLUMB_NEED_SENSORS | PLUMB_NEED_FILTERS | PLUMB_NEED_RESTITUTION | PLUMB_NEED_QUERIES |
                             PLUMB_NEED_SURFACE_VELOCITY;

PlumbBodyDesc box_desc(const TestWorld& world, PlumbVec3 at, PlumbMotion motion = PLUMB_DYNAMIC) {
  PlumbBodyDesc desc = body_desc(motion);
  desc.shape = world.box(.5, .5, .5);
  desc.pose.position = at;
  return desc;
}

TEST(Contacts, ImpulsesCarryTheWeightOverAnySubsteps) {
  for (const double substeps : {1.0, 4.0}) {
    const TestWorld world(needs, {setting("substeps", substeps, PLUMB_SETTING_INT)});
    const PlumbBody ground = world.fixed(world.box(10, 1, 10), {0, -1, 0});
    const PlumbBody box = world.dynamic(world.box(.5, .5, .5), {0, .5, 0});
    world.step(120);
    double normal = 0, tangent = 0;
    for (const PlumbContact& contact : world->contacts()) {
      EXPECT_EQ(contact.body_a, ground);
      EXPECT_EQ(contact.body_b, box);
      EXPECT_NEAR(contact.normal.y, 1, 1e-6);
      EXPECT_GT(contact.depth, -1e-6);
      normal += contact.normal_impulse;
      tangent += contact.tangent_impulse.x;
    }
    const double weight = 9.81 * world.row(box, PLUMB_FIELD_MASS)[0] * dt;
    EXPECT_NEAR(normal, weight, .02 * weight) << substeps << " sub-steps";
    EXPECT_NEAR(tangent, 0, .02 * weight);
    EXPECT_LE(world->contacts().size(), 8u) << substeps << " sub-steps";
  }
}

TEST(Contacts, PairFrictionAndRestitution) {
  const TestWorld world(needs, {setting("stepper", "step")});
  PlumbBodyDesc ground = body_desc(PLUMB_STATIC);
  ground.shape = world.box(100, 1, 10);
  ground.pose.position.y = -1;
  ground.material = {.2, .5, {}};
  world.body(ground);
  PlumbBodyDesc slider = box_desc(world, {0, .5, 0});
  slider.linear_velocity = {5, 0, 0};
  slider.material = {.8, 0, {}};
  const PlumbBody a = world.body(slider);
  PlumbBodyDesc ball = body_desc();
  ball.shape = world.sphere(.5);
  ball.pose.position = {0, 1.5, 5};
  ball.linear_velocity = {0, -4, 0};
  ball.gravity_scale = 0;
  ball.material = {0, .8, {}};
  const PlumbBody b = world.body(ball);
  world.step(30);
  EXPECT_NEAR(world.velocity(b).y, .8 * 4, 1e-3);             // the larger of the two
  EXPECT_NEAR(world.velocity(a).x, 5 - .4 * 9.81 * .5, .01);  // sqrt(.2 * .8) = .4
}

// A belt drags a box to its speed at mu g, whichever of the two is created first, and in whatever direction.
TEST(Contacts, ConveyorsDrag) {
  for (const bool box_first : {false, true}) {
    for (const double heading : {0.0, .5, 2.0}) {
      const TestWorld world(needs, {setting("stepper", "step")});
      PlumbBodyDesc belt = body_desc(PLUMB_STATIC);
      belt.shape = world.box(100, 1, 100);
      belt.pose = {{0, -1, 0}, {0, std::sin(heading / 2), 0, std::cos(heading / 2)}};
      belt.material = {.3, 0, {2, 0, 0}};
      PlumbBodyDesc load = box_desc(world, {0, .5, 0});
      load.material.friction = .3;
      PlumbBody box = 0;
      if (box_first) box = world.body(load);
      world.body(belt);
      if (!box_first) box = world.body(load);
      world.step(20);
      const PlumbVec3 along{std::cos(heading), 0, -std::sin(heading)};
      PlumbVec3 v = world.velocity(box);
      EXPECT_NEAR(v.x * along.x + v.z * along.z, .3 * 9.81 * 20 * dt, .01) << heading;
      EXPECT_NEAR(v.x * along.z - v.z * along.x, 0, .01) << heading;
      world.step(60);
      v = world.velocity(box);
      EXPECT_NEAR(v.x * along.x + v.z * along.z, 2, .01) << heading;
    }
  }
}

TEST(Contacts, FilterRule) {
  const auto touches = [](PlumbFilter first, PlumbFilter second) {
    const TestWorld world(needs);
    PlumbBodyDesc a = box_desc(world, {0, 0, 0}), b = box_desc(world, {0, .9, 0});
    a.filter = first;
    b.filter = second;
    world.body(a);
    world.body(b);
    world.step();
    return !world->contacts().empty();
  };
  EXPECT_TRUE(touches({1, ~0u, 0, 0}, {1, ~0u, 0, 0}));
  EXPECT_FALSE(touches({1, 2, 0, 0}, {2, 2, 0, 0}));
  EXPECT_TRUE(touches({1, 2, 0, 0}, {2, 1, 0, 0}));
  EXPECT_FALSE(touches({1, ~0u, -3, 0}, {1, ~0u, -3, 0}));
  EXPECT_TRUE(touches({1, 0, 3, 0}, {1, 0, 3, 0}));
}

TEST(Contacts, EventsBeginAndEndAlsoByDestruction) {
  const TestWorld world(needs);
  const PlumbBody ground = world.fixed(world.box(10, 1, 10), {0, -1, 0});
  const PlumbBody box = world.body(box_desc(world, {0, .5, 0}));
  const PlumbBody faller = world.body(box_desc(world, {3, 1, 0}));
  world.step();
  ASSERT_EQ(world->events().size(), 1u);
  EXPECT_EQ(world->events()[0].type, PLUMB_EVENT_CONTACT_BEGIN);
  EXPECT_EQ(world->events()[0].body_a, ground);
  EXPECT_EQ(world->events()[0].body_b, box);
  check(*world, world->destroy_bodies({&box, 1}));
  world.step();
  ASSERT_EQ(world->events().size(), 1u);
  EXPECT_EQ(world->events()[0].type, PLUMB_EVENT_CONTACT_END);
  EXPECT_EQ(world->events()[0].body_b, box);
  (void)faller;
}

TEST(Contacts, SensorsSeeAndPushNothing) {
  const TestWorld world(needs);
  PlumbBodyDesc gate = box_desc(world, {0, 0, 0}, PLUMB_STATIC);
  gate.flags = PLUMB_BODY_SENSOR;
  const PlumbBody sensor = world.body(gate), box = world.body(box_desc(world, {0, 1.2, 0}));
  int entered = 0, left = 0;
  for (int i = 0; i < 90; ++i) {
    world.step();
    EXPECT_TRUE(world->contacts().empty());
    for (const PlumbEvent& event : world->events()) {
      EXPECT_EQ(event.body_a, sensor);
      EXPECT_EQ(event.body_b, box);
      entered += event.type == PLUMB_EVENT_SENSOR_ENTER;
      left += event.type == PLUMB_EVENT_SENSOR_LEAVE;
    }
  }
  EXPECT_EQ(entered, 1);
  EXPECT_EQ(left, 1);
  EXPECT_NEAR(world.velocity(box).y, -9.81 * 90 * dt, 1e-9);
}

TEST(Contacts, CompoundChildrenHaveTheirOwnMaterials) {
  const TestWorld world(needs, {setting("stepper", "step")});
  const PlumbShape half = world.box(5, 1, 5);
  PlumbCompoundChild children[2]{};
  for (int i = 0; i < 2; ++i) children[i] = {half, {{i == 0 ? -5.0 : 5.0, -1, 0}, {0, 0, 0, 1}}, 1, 0, {}};
  children[0].material.friction = 1;
  children[1].material.friction = 0;
  PlumbShapeDesc desc = shape_desc(PLUMB_COMPOUND);
  desc.children = children;
  desc.child_count = 2;
  world.fixed(world.shape(desc));
  for (const double x : {-5.0, 5.0}) {
    PlumbBodyDesc slider = box_desc(world, {x, .5, 0});
    slider.linear_velocity = {0, 0, 2};
    slider.material.friction = .25;
    const PlumbBody body = world.body(slider);
    world.step(10);
    EXPECT_NEAR(world.velocity(body).z, 2 - (x < 0 ? .5 * 9.81 * 10 * dt : 0), .01);
    EXPECT_EQ(world->contacts().back().child_a, x < 0 ? 0u : 1u);
    check(*world, world->destroy_bodies({&body, 1}));
  }
}

/// OPCODE alone crashes on a mesh of one triangle; two of them, crossing, must meet.
TEST(Contacts, LoneTrianglesMeet) {
  const TestWorld world(usual_needs | PLUMB_NEED_CONTACTS);
  check(*world, world->set_gravity({0, 0, 0}));
  const double corners[9] = {-1, 0, -1, 1, 0, -1, 0, 0, 1};
  const std::uint32_t triangle[3] = {0, 1, 2};
  PlumbShapeDesc mesh = shape_desc(PLUMB_TRIANGLE_MESH);
  mesh.vertices = corners;
  mesh.vertex_count = 3;
  mesh.indices = triangle;
  mesh.triangle_count = 1;
  const PlumbShape shape = world.shape(mesh);
  world.fixed(shape);
  PlumbBodyDesc desc = body_desc();
  desc.shape = shape;
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = 1;
  desc.inertia = {1, 1, 1};
  desc.pose.orientation = {std::sqrt(.5), 0, 0, std::sqrt(.5)};
  world.body(desc);
  bool met = false;
  for (int i = 0; i < 30; ++i) {
    world.step();
    met = met || !world->contacts().empty();
  }
  EXPECT_TRUE(met);
}

TEST(Queries, RaysFindTheNearestAndAll) {
  const TestWorld world(needs);
  const PlumbBody near = world.fixed(world.sphere(.5), {2, 0, 0}), far = world.fixed(world.box(.5, .5, .5), {5, 0, 0});
  PlumbShapeDesc mesh = shape_desc(PLUMB_TRIANGLE_MESH);
  const double corners[] = {8, -1, -1, 8, -1, 1, 8, 1, 0};
  const std::uint32_t triangle[] = {0, 1, 2};
  mesh.vertices = corners;
  mesh.vertex_count = 3;
  mesh.indices = triangle;
  mesh.triangle_count = 1;
  const PlumbBody sail = world.fixed(world.shape(mesh));
  const PlumbRay rays[] = {{{0, 0, 0}, {10, 0, 0}, {1, ~0u, 0, 0}}, {{0, 5, 0}, {10, 0, 0}, {1, ~0u, 0, 0}}};
  const Hits closest = world->queries()->cast_rays(PLUMB_HIT_CLOSEST, rays);
  ASSERT_EQ(closest.hits.size(), 2u);
  EXPECT_EQ(closest.hits[0].body, near);
  EXPECT_NEAR(closest.hits[0].fraction, .15, 1e-12);
  EXPECT_NEAR(closest.hits[0].normal.x, -1, 1e-12);
  EXPECT_EQ(closest.hits[1].body, 0u);
  const Hits all = world->queries()->cast_rays(PLUMB_HIT_ALL, rays);
  ASSERT_EQ(all.hits.size(), 3u);
  EXPECT_EQ(all.hits[1].body, far);
  EXPECT_NEAR(all.hits[1].fraction, .45, 1e-12);
  EXPECT_EQ(all.hits[2].body, sail);
  EXPECT_NEAR(all.hits[2].fraction, .8, 1e-6);
  EXPECT_NEAR(all.hits[2].normal.x, -1, 1e-6);
}

TEST(Queries, OverlapsFindEveryBodyOnce) {
  const TestWorld world(needs);
  const PlumbBody a = world.fixed(world.sphere(.5), {0, 0, 0}), b = world.fixed(world.box(.5, .5, .5), {2, 0, 0});
  world.fixed(world.sphere(.5), {5, 0, 0});
  const PlumbOverlap overlap{world.sphere(1), {{1, 0, 0}, {0, 0, 0, 1}}, {1, ~0u, 0, 0}};
  const Hits hits = world->queries()->overlap_shapes({&overlap, 1});
  ASSERT_EQ(hits.hits.size(), 2u);
  EXPECT_EQ(hits.hits[0].body, a);
  EXPECT_EQ(hits.hits[1].body, b);
}

TEST(Queries, CollideTellsDepthAndNormalFromAToB) {
  const TestWorld world(needs);
  const PlumbShape sphere = world.sphere(.5), box = world.box(.5, .5, .5);
  const PlumbPosedPair pairs[] = {{sphere, box, {{0, .9, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}},
                                  {sphere, box, {{0, 2, 0}, {0, 0, 0, 1}}, {{0, 0, 0}, {0, 0, 0, 1}}}};
  PlumbPairResult results[2];
  std::span<const PlumbPairPoint> points;
  check(*world, world->collide()->collide_pairs(pairs, results, points));
  ASSERT_EQ(results[0].point_count, 1u);
  EXPECT_NEAR(results[0].distance, -.1, 1e-12);
  EXPECT_NEAR(points[0].normal.y, -1, 1e-12);
  EXPECT_EQ(results[1].point_count, 0u);
  EXPECT_TRUE(std::isnan(results[1].distance));
}

}  // namespace
}  // namespace plumb::ode_test
