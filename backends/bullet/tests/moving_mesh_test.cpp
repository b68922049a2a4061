// Triangle meshes that move by forces.
#include <gtest/gtest.h>

#include <cmath>

#include "plumb_scene.hpp"

namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_CONTACTS |
                              PLUMB_NEED_CONTACT_IMPULSES | PLUMB_NEED_QUERIES;

PlumbShape add_mesh_box(plumb::IPhysicsWorld& world, PlumbVec3 half, PlumbVec3 middle = {}) {
  double corners[24];
  for (int i = 0; i < 8; ++i) {
    corners[3 * i] = middle.x + ((i & 1) != 0 ? half.x : -half.x);
    corners[3 * i + 1] = middle.y + ((i & 2) != 0 ? half.y : -half.y);
    corners[3 * i + 2] = middle.z + ((i & 4) != 0 ? half.z : -half.z);
  }
  constexpr std::uint32_t triangles[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                           2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
  PlumbShapeDesc desc = plumb::shape_desc(PLUMB_TRIANGLE_MESH);
  desc.vertices = corners;
  desc.vertex_count = 8;
  desc.indices = triangles;
  desc.triangle_count = 12;
  return scenes::add_shape(world, desc);
}

PlumbShape add_flat_field(plumb::IPhysicsWorld& world) {
  constexpr double heights[25] = {};
  PlumbShapeDesc desc = plumb::shape_desc(PLUMB_HEIGHT_FIELD);
  desc.heights = heights;
  desc.rows = desc.columns = 5;
  desc.spacing = {2, 0, 2};
  return scenes::add_shape(world, desc);
}

PlumbBody add(plumb::IPhysicsWorld& world, PlumbMotion motion, PlumbShape shape, PlumbVec3 at) {
  PlumbBodyDesc desc = plumb::body_desc(motion);
  desc.shape = shape;
  desc.pose.position = at;
  return scenes::add_body(world, desc);
}

/// On what stands still, the top of which is at 0; the centimetre of thickness and a tremble are declared.
TEST(MovingMesh, RestsOnEveryGround) {
  for (const PlumbShapeType ground : {PLUMB_BOX, PLUMB_TRIANGLE_MESH, PLUMB_HEIGHT_FIELD, PLUMB_PLANE}) {
    auto world = scenes::make_world(kNeeds);
    const PlumbShape under = ground == PLUMB_BOX             ? scenes::add_box(*world, {2, 2, 2})
                             : ground == PLUMB_TRIANGLE_MESH ? add_mesh_box(*world, {2, 2, 2})
                             : ground == PLUMB_PLANE         ? scenes::add_shape(*world, plumb::shape_desc(PLUMB_PLANE))
                                                             : add_flat_field(*world);
    const bool solid = ground == PLUMB_BOX || ground == PLUMB_TRIANGLE_MESH;
    add(*world, PLUMB_STATIC, under, {0, solid ? -2.0 : 0.0, 0});
    const PlumbBody cube = add(*world, PLUMB_DYNAMIC, add_mesh_box(*world, {0.5, 0.5, 0.5}), {0.1, 0.52, 0});
    double carried = 0;
    for (int i = 0; i < 240; ++i) {
      scenes::advance(*world);
      for (const PlumbContact& contact : world->contacts())
        if (i >= 180) carried += std::abs(contact.normal_impulse * contact.normal.y);
    }
    const auto pose = scenes::read_row<7>(*world, PLUMB_FIELD_POSE, cube);
    EXPECT_NEAR(pose[1], 0.51, 0.005) << "on shape " << ground;
    EXPECT_GT(pose[6], 0.9999) << "on shape " << ground;
    EXPECT_LT(std::hypot(pose[0] - 0.1, pose[2]), 0.03) << "on shape " << ground;
    EXPECT_NEAR(carried, 1000 * 9.81, 100) << "on shape " << ground;
  }
}

/// Where the mesh stands still there is a fifth of the tremble at most.
TEST(RestingMesh, Carries) {
  for (const bool is_sphere : {false, true}) {
    auto world = scenes::make_world(kNeeds);
    add(*world, PLUMB_STATIC, add_mesh_box(*world, {2, 2, 2}), {0, -2, 0});
    const PlumbShape shape = is_sphere ? scenes::add_sphere(*world, 0.5) : scenes::add_box(*world, {0.5, 0.5, 0.5});
    const PlumbBody body = add(*world, PLUMB_DYNAMIC, shape, {0.1, 0.51, 0});
    for (int i = 0; i < 240; ++i) scenes::advance(*world);
    EXPECT_NEAR(scenes::read_row<7>(*world, PLUMB_FIELD_POSE, body)[1], 0.5, 2e-3);
    const auto velocity = scenes::read_row<6>(*world, PLUMB_FIELD_VELOCITY, body);
    for (const double value : velocity) EXPECT_NEAR(value, 0, 0.02);
  }
}

/// A ring is no hull: a post stands in its hole and holds it.
TEST(MovingMesh, HasItsHoles) {
  auto world = scenes::make_world(kNeeds);
  std::vector<double> corners;
  std::vector<std::uint32_t> triangles;
  constexpr int around = 4;
  for (int i = 0; i < around; ++i) {
    const double angle = (0.5 + i) * std::acos(-1.0) / 2;
    for (const double radius : {0.6, 1.2})
      for (const double y : {-0.2, 0.2})
        corners.insert(corners.end(), {radius * std::cos(angle), y, radius * std::sin(angle)});
    const auto here = static_cast<std::uint32_t>(4 * i), next = static_cast<std::uint32_t>(4 * ((i + 1) % around));
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
      triangles.insert(triangles.end(), {a, b, c, a, c, d});
    };
    quad(here + 2, here + 3, next + 3, next + 2);  // outside
    quad(here + 1, here, next, next + 1);          // inside
    quad(here + 3, here + 1, next + 1, next + 3);  // top
    quad(here, here + 2, next + 2, next);          // bottom
  }
  PlumbShapeDesc desc = plumb::shape_desc(PLUMB_TRIANGLE_MESH);
  desc.vertices = corners.data();
  desc.vertex_count = static_cast<std::uint32_t>(corners.size() / 3);
  desc.indices = triangles.data();
  desc.triangle_count = static_cast<std::uint32_t>(triangles.size() / 3);
  add(*world, PLUMB_STATIC, scenes::add_box(*world, {20, 5, 20}), {0, -5, 0});
  add(*world, PLUMB_STATIC, scenes::add_box(*world, {0.2, 2, 0.2}), {0, 2, 0});
  PlumbBodyDesc body = plumb::body_desc();
  body.shape = scenes::add_shape(*world, desc);
  body.pose.position = {0, 0.3, 0};
  body.linear_velocity = {3, 0, 0};
  body.material.friction = 0;
  const PlumbBody ring = scenes::add_body(*world, body);
  for (int i = 0; i < 120; ++i) scenes::advance(*world);
  const auto pose = scenes::read_row<7>(*world, PLUMB_FIELD_POSE, ring);
  EXPECT_LT(std::abs(pose[0]), 0.4);
  EXPECT_NEAR(pose[1], 0.21, 0.02);
}

/// Its mass lies elsewhere than its origin: the triangles must go with the frame, not with the centre of mass.
TEST(MovingMesh, MayHaveItsMassAnywhere) {
  auto world = scenes::make_world(kNeeds);
  add(*world, PLUMB_STATIC, scenes::add_box(*world, {20, 5, 20}), {0, -5, 0});
  const PlumbBody cube = add(*world, PLUMB_DYNAMIC, add_mesh_box(*world, {0.5, 0.5, 0.5}, {3, 0.2, -1}), {0, 0.32, 0});
  const auto mass = scenes::read_row<11>(*world, PLUMB_FIELD_MASS, cube);
  EXPECT_NEAR(mass[0], 1000, 1e-3);
  EXPECT_NEAR(mass[1], 3, 1e-5);
  for (int i = 0; i < 120; ++i) scenes::advance(*world);
  const auto pose = scenes::read_row<7>(*world, PLUMB_FIELD_POSE, cube);
  EXPECT_NEAR(pose[1], 0.31, 0.005);
  EXPECT_GT(pose[6], 0.9999);
}

TEST(MovingMesh, IsSeenByRaysAndCollide) {
  auto world = scenes::make_world(kNeeds);
  plumb::check(*world, world->set_gravity({0, 0, 0}));
  const PlumbShape mesh = add_mesh_box(*world, {0.5, 0.5, 0.5});
  const PlumbBody cube = add(*world, PLUMB_DYNAMIC, mesh, {0, 1, 0});
  scenes::advance(*world);
  PlumbRay ray{};
  ray.origin = {0.1, 5, 0.2};
  ray.translation = {0, -10, 0};
  ray.filter = plumb::body_desc().filter;
  const plumb::Hits hits = world->queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1});
  plumb::check(*world, hits.result);
  ASSERT_EQ(hits.hits.size(), 1u);
  EXPECT_EQ(hits.hits[0].body, cube);
  EXPECT_NEAR(hits.hits[0].fraction, 0.35, 2e-3);
  for (const PlumbShape other :
       {mesh, add_flat_field(*world), scenes::add_shape(*world, plumb::shape_desc(PLUMB_PLANE))}) {
    PlumbPosedPair pair{};
    pair.shape_a = mesh;
    pair.shape_b = other;
    pair.pose_a = pair.pose_b = plumb::identity_pose();
    pair.pose_a.position.y = other == mesh ? 1.005 : 0.505;  // within the margin
    PlumbPairResult result{};
    std::span<const PlumbPairPoint> points;
    plumb::check(*world, world->collide()->collide_pairs({&pair, 1}, {&result, 1}, points));
    EXPECT_GT(points.size(), 0u) << other;
    for (const PlumbPairPoint& point : points) EXPECT_NEAR(std::abs(point.normal.y), 1, 0.01) << other;
  }
}

/// Where its triangles are, not where Bullet's margin is, and with its centre of mass beside its origin.
TEST(MovingMesh, IsAsFarAwayAsItsTriangles) {
  auto world = scenes::make_world(kNeeds);
  plumb::check(*world, world->set_gravity({0, 0, 0}));
  const PlumbBody cube = add(*world, PLUMB_DYNAMIC, add_mesh_box(*world, {0.5, 0.5, 0.5}, {3, 0, 0}), {0, 1, 0});
  scenes::advance(*world);
  PlumbShapeDesc ball = plumb::shape_desc(PLUMB_SPHERE);
  ball.radius = 0.25;
  const PlumbProbe probe = {
      scenes::add_shape(*world, ball), {{3.25, 4, 0.125}, {0, 0, 0, 1}}, 10, plumb::body_desc().filter};
  const plumb::ClosestBodies found = world->closest()->closest_bodies(PLUMB_HIT_CLOSEST, {&probe, 1});
  plumb::check(*world, found.result);
  ASSERT_EQ(found.rows.size(), 1u);
  EXPECT_EQ(found.rows[0].body, cube);
  EXPECT_NEAR(found.rows[0].distance, 2.25, 1e-5);
  EXPECT_NEAR(found.rows[0].normal.y, -1, 1e-5);
  EXPECT_TRUE(found.rows[0].child == 6 || found.rows[0].child == 7) << found.rows[0].child;
}

}  // namespace
