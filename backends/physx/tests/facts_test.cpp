// What is known of PhysX and of how it is wrapped, and must stay known.
#include <gtest/gtest.h>

#include <numbers>

#include "plumb/backend/small_math.hpp"
#include "plumb_scene.hpp"

namespace {

using namespace scenes;

constexpr PlumbFilter kSeesAll = {1, 0xffffffffu, 0, 0};

PlumbNeeds with(PlumbNeeds more) { return kNeeds | more; }

PlumbBody add_floor(plumb::IPhysicsWorld& world) {
  PlumbBodyDesc floor = plumb::body_desc(PLUMB_STATIC);
  floor.shape = add_box(world, {50, 1, 50});
  floor.pose.position = {0, -1, 0};
  return add_body(world, floor);
}

/// The weight of a tower lies in the normal impulses of its lowest contacts, with either solver.
TEST(PhysX, ContactImpulsesCarryATower) {
  for (const char* solver : {"pgs", "tgs"}) {
    PlumbScene tower(scenes::tower(5), with(PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES),
                     {word_setting("solver", solver)});
    for (int i = 0; i < 240; ++i) advance(*tower.world);
    double pushed = 0;
    int points = 0;
    for (const PlumbContact& contact : tower.world->contacts()) {
      if (contact.body_a != tower.bodies[0] && contact.body_b != tower.bodies[0]) continue;
      pushed += contact.normal_impulse;
      ++points;
    }
    EXPECT_EQ(points, 4) << solver;
    EXPECT_NEAR(pushed, 5 * 1000 * 9.81 / 60, 0.02 * 5 * 1000 * 9.81 / 60) << solver;
  }
}

/// A cube on a slope too flat to slide on is held by friction impulses along the slope.
TEST(PhysX, FrictionImpulsesHoldACubeOnASlope) {
  constexpr double kSlope = 0.1;
  const auto world = make_world(with(PLUMB_NEED_CONTACTS | PLUMB_NEED_CONTACT_IMPULSES));
  plumb::check(*world, world->set_gravity({9.81 * std::sin(kSlope), -9.81 * std::cos(kSlope), 0}));
  add_floor(*world);
  PlumbBodyDesc desc = plumb::body_desc();
  desc.shape = add_box(*world, {0.5, 0.5, 0.5});
  desc.pose.position = {0, 0.5, 0};
  const PlumbBody cube = add_body(*world, desc);
  for (int i = 0; i < 60; ++i) advance(*world);
  PlumbVec3 sum{};
  for (const PlumbContact& contact : world->contacts()) {
    const double sign = contact.body_b == cube ? 1 : -1;  // on the cube
    sum.x += sign * (contact.tangent_impulse.x + contact.normal_impulse * contact.normal.x);
    sum.y += sign * (contact.tangent_impulse.y + contact.normal_impulse * contact.normal.y);
  }
  EXPECT_NEAR(sum.x, -1000 * 9.81 * std::sin(kSlope) / 60, 0.02 * 1000 * 9.81 * std::sin(kSlope) / 60);
  EXPECT_NEAR(sum.y, 1000 * 9.81 * std::cos(kSlope) / 60, 0.01 * 1000 * 9.81 / 60);
}

/// PhysX keeps impulses for its next step; the adapter's change the velocity at once, about principal axes as well.
TEST(PhysX, ImpulsesChangeVelocitiesAtOnce) {
  const auto world = make_world(with(PLUMB_NEED_FORCES));
  PlumbBodyDesc desc = plumb::body_desc();
  desc.mass_mode = PLUMB_MASS_EXPLICIT;
  desc.mass = 2;
  desc.inertia = {4, 5, 6};
  desc.inertia_orientation = {0, 0, std::sqrt(0.5), std::sqrt(0.5)};  // principal x is the body's y
  const PlumbBody body = add_body(*world, desc);
  write_row<3>(*world, PLUMB_FIELD_IMPULSE, body, {2, 0, 0});
  write_row<3>(*world, PLUMB_FIELD_ANGULAR_IMPULSE, body, {5, 4, 6});
  const auto velocity = read_row<6>(*world, PLUMB_FIELD_VELOCITY, body);
  EXPECT_NEAR(velocity[0], 1, 1e-6);
  for (std::size_t k = 3; k < 6; ++k) EXPECT_NEAR(velocity[k], 1, 1e-6) << k;
}

/// PhysX's own limit, which is a setting.
TEST(PhysX, SpinsAreSlowedToTheLimit) {
  const auto after = [](std::vector<PlumbSetting> settings) {
    const auto world = make_world(kNeeds, std::move(settings));
    PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 0, 0});
    desc.angular_velocity = {0, 300, 0};
    const PlumbBody body = add_body(*world, desc);
    advance(*world);
    return read_row<6>(*world, PLUMB_FIELD_VELOCITY, body)[4];
  };
  EXPECT_NEAR(after({}), 100, 0.01);
  EXPECT_NEAR(after({number_setting("max_angular_speed", 1e6)}), 300, 0.01);
}

/// Impacts slower than 2 m/s do not bounce, as PhysX ships.
TEST(PhysX, SlowImpactsDoNotBounceByDefault) {
  const auto highest = [](std::vector<PlumbSetting> settings) {
    const auto world = make_world(with(PLUMB_NEED_RESTITUTION), std::move(settings));
    add_floor(*world);
    PlumbBodyDesc ball = plumb::body_desc();
    ball.shape = add_sphere(*world, 0.5);
    ball.pose.position = {0, 0.55, 0};
    ball.material.restitution = 1;
    const PlumbBody body = add_body(*world, ball);
    double most = 0;
    for (int i = 0; i < 60; ++i) {
      advance(*world);
      if (i > 15) most = std::max(most, read_row<7>(*world, PLUMB_FIELD_POSE, body)[1]);
    }
    return most;
  };
  EXPECT_NEAR(highest({}), 0.5, 0.005);
  EXPECT_GT(highest({number_setting("bounce_threshold", 0.1)}), 0.53);
}

/// Of two surfaces friction is the root of the product, restitution the larger: PhysX is told so by its materials.
TEST(PhysX, MaterialsCombineAsTheInterfaceAsks) {
  const auto world = make_world(with(PLUMB_NEED_RESTITUTION));
  plumb::check(*world, world->set_gravity({0, -10, 0}));
  PlumbBodyDesc floor = plumb::body_desc(PLUMB_STATIC);
  floor.shape = add_box(*world, {500, 1, 50});
  floor.pose.position = {0, -1, 0};
  floor.material.friction = 0.9;
  floor.material.restitution = 0.6;
  add_body(*world, floor);
  PlumbBodyDesc desc = plumb::body_desc();
  desc.shape = add_box(*world, {0.5, 0.1, 0.5});
  desc.pose.position = {0, 0.1, 0};
  desc.linear_velocity = {9, 0, 0};
  desc.material.friction = 0.4;
  const PlumbBody slider = add_body(*world, desc);
  desc = plumb::body_desc();
  desc.shape = add_sphere(*world, 0.5);
  desc.pose.position = {0, 3, 20};
  desc.linear_velocity = {0, -8, 0};
  desc.gravity_scale = 0;
  desc.material.restitution = 0.2;
  const PlumbBody ball = add_body(*world, desc);
  for (int i = 0; i < 60; ++i) advance(*world);
  EXPECT_NEAR(read_row<6>(*world, PLUMB_FIELD_VELOCITY, slider)[0], 9 - 0.6 * 10, 0.1);
  EXPECT_NEAR(read_row<6>(*world, PLUMB_FIELD_VELOCITY, ball)[1], 0.6 * 8, 0.01);
}

/// PhysX has room for 65,535 materials in a process: those that nobody has any more are given back.
TEST(PhysX, MaterialsComeAndGo) {
  const auto world = make_world(kNeeds);
  const PlumbBody body = add_body(*world, frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 0, 0}));
  for (int i = 0; i < 70000; ++i) write_row<2>(*world, PLUMB_FIELD_MATERIAL, body, {1e-5 * i, 0});
  EXPECT_NEAR(read_row<2>(*world, PLUMB_FIELD_MATERIAL, body)[0], 0.69999, 1e-6);
}

/// A dynamic body with another scale of gravity falls by its share, and one without any stays.
TEST(PhysX, GravityHasShares) {
  const auto world = make_world(kNeeds);
  for (const double scale : {0.0, 0.5, -2.0}) {
    PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 0, 0});
    desc.gravity_scale = scale;
    const PlumbBody body = add_body(*world, desc);
    for (int i = 0; i < 60; ++i) advance(*world);
    EXPECT_NEAR(read_row<6>(*world, PLUMB_FIELD_VELOCITY, body)[1], -9.81 * scale, 1e-3) << scale;
    plumb::check(*world, world->destroy_bodies({&body, 1}));
  }
}

/// A cylinder on a mesh whose triangles have materials of their own: PhysX's convex cores read beyond the table there.
TEST(PhysX, CylindersStandOnMeshesOfSeveralMaterials) {
  const auto world = make_world(with(PLUMB_NEED_CONTACTS));
  const std::vector<double> vertices = {-5, 0, -5, -5, 0, 5, 5, 0, -5, 5, 0, 5};
  const std::vector<std::uint32_t> indices = {0, 1, 2, 2, 1, 3}, rows = {0, 1};
  const PlumbMaterial materials[] = {{0.1, 0, {}}, {0.9, 0, {}}};
  PlumbShapeDesc mesh = plumb::shape_desc(PLUMB_TRIANGLE_MESH);
  mesh.vertices = vertices.data();
  mesh.vertex_count = 4;
  mesh.indices = indices.data();
  mesh.triangle_count = 2;
  mesh.materials = materials;
  mesh.material_count = 2;
  mesh.triangle_materials = rows.data();
  PlumbBodyDesc ground = plumb::body_desc(PLUMB_STATIC);
  ground.shape = add_shape(*world, mesh);
  const PlumbBody floor = add_body(*world, ground);
  PlumbShapeDesc can = plumb::shape_desc(PLUMB_CYLINDER);
  can.radius = can.half_height = 0.5;
  PlumbBodyDesc desc = plumb::body_desc();
  desc.shape = add_shape(*world, can);
  desc.pose.position = {2, 0.5, 2};  // on the second triangle
  const PlumbBody body = add_body(*world, desc);
  for (int i = 0; i < 60; ++i) advance(*world);
  EXPECT_NEAR(read_row<7>(*world, PLUMB_FIELD_POSE, body)[1], 0.5, 0.01);
  ASSERT_FALSE(world->contacts().empty());
  for (const PlumbContact& contact : world->contacts())
    EXPECT_EQ(contact.body_a == floor ? contact.child_a : contact.child_b, 1u);
}

/// Heights are whole numbers to PhysX: they are off by no more than a part of the range.
TEST(PhysX, HeightsAreRoundedToTheirRange) {
  const auto world = make_world(with(PLUMB_NEED_QUERIES));
  constexpr double kRange = 8;
  std::vector<double> heights;
  for (int i = 0; i < 16; ++i) heights.push_back(0.123456789 * i * i - 3);
  heights[5] = heights[0] + kRange;
  PlumbShapeDesc field = plumb::shape_desc(PLUMB_HEIGHT_FIELD);
  field.heights = heights.data();
  field.rows = field.columns = 4;
  field.spacing = {1, 0, 2};
  add_body(*world, frictionless(PLUMB_STATIC, add_shape(*world, field), {0, 0, 0}));
  for (int row = 0; row < 4; ++row)
    for (int column = 0; column < 4; ++column) {
      const double x = 0.999 * (column - 1.5), z = 0.999 * 2 * (row - 1.5);
      const PlumbRay ray = {{x, 100, z}, {0, -200, 0}, kSeesAll};
      const plumb::Hits hits = world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
      const double height = heights[static_cast<std::size_t>(4 * row + column)];
      if (row != 1 && row != 2 && column != 1 && column != 2) {
        EXPECT_NEAR(hits.hits[0].position.y, height, 0.03) << row << " " << column;
      }
    }
}

/// PhysX tells nothing of those that sleep; their contact does not end for that.
TEST(PhysX, SleepersTouchOn) {
  const auto world = make_world(with(PLUMB_NEED_EVENTS | PLUMB_NEED_SLEEPING));
  add_floor(*world);
  const PlumbBody cube = add_body(*world, frictionless(PLUMB_DYNAMIC, add_box(*world, {0.5, 0.5, 0.5}), {0, 0.5, 0}));
  int begun = 0, ended = 0, slept = 0;
  for (int i = 0; i < 240; ++i) {
    advance(*world);
    for (const PlumbEvent& event : world->events()) {
      begun += event.type == PLUMB_EVENT_CONTACT_BEGIN ? 1 : 0;
      ended += event.type == PLUMB_EVENT_CONTACT_END ? 1 : 0;
      slept += event.type == PLUMB_EVENT_SLEEP ? 1 : 0;
    }
  }
  EXPECT_EQ(read_row<1>(*world, PLUMB_FIELD_AWAKE, cube)[0], 0);
  EXPECT_EQ(begun, 1);
  EXPECT_EQ(ended, 0);
  EXPECT_EQ(slept, 1);
}

/// Without the need nobody falls asleep, though PhysX would like to.
TEST(PhysX, NobodySleepsUnasked) {
  const auto world = make_world(kNeeds);
  add_floor(*world);
  const PlumbBody cube = add_body(*world, frictionless(PLUMB_DYNAMIC, add_box(*world, {0.5, 0.5, 0.5}), {0, 0.5, 0}));
  for (int i = 0; i < 240; ++i) EXPECT_EQ(advance(*world).awake, 1u);
  EXPECT_EQ(read_row<1>(*world, PLUMB_FIELD_AWAKE, cube)[0], 1);
}

/// The same bits for any number of threads, in a scene of several islands.
TEST(PhysX, ThreadsChangeNothing) {
  const auto after = [](std::uint32_t threads) {
    PlumbWorldDesc desc = plumb::world_desc(with(PLUMB_NEED_CONTACTS));
    desc.threads = threads;
    const auto world = backend().create_world(desc);
    add_floor(*world);
    const PlumbShape box = add_box(*world, {0.5, 0.5, 0.5});
    for (int i = 0; i < 300; ++i) {
      PlumbBodyDesc cube = plumb::body_desc();
      cube.shape = box;
      cube.pose.position = {(i % 7) * 0.9 - 3 + 20 * (i / 147), 1 + (i / 49) * 1.3, (i / 7 % 7) * 0.9 - 3};
      add_body(*world, cube);
    }
    for (int i = 0; i < 120; ++i) advance(*world);
    std::uint64_t hash = 0;
    plumb::check(*world, world->hash(hash));
    return hash;
  };
  const std::uint64_t one = after(1);
  EXPECT_EQ(after(2), one);
  EXPECT_EQ(after(4), one);
}

TEST(PhysX, NumbersBeyondFloatAreRefused) {
  const auto world = make_world(kNeeds);
  PlumbBodyDesc desc = frictionless(PLUMB_DYNAMIC, add_sphere(*world, 0.5), {0, 1e300, 0});
  PlumbBody body = 0;
  EXPECT_EQ(world->create_bodies({&desc, 1}, {&body, 1}), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_NE(world->error_text().find("pose.position"), std::string::npos) << world->error_text();
}

}  // namespace
