// Planes, triangle meshes and height fields in the world: what stands, slides and rolls on them does as on a box.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kSurfaceNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_CONTACTS | PLUMB_NEED_KINEMATIC;

enum class Ground { kBox, kPlane, kMesh, kBackOfMesh, kField };
constexpr Ground kGrounds[] = {Ground::kPlane, Ground::kMesh, Ground::kBackOfMesh, Ground::kField};

PlumbShape make_ground(Scene& scene, Ground ground, std::uint32_t cells, double side) {
  if (ground == Ground::kBox) return scene.box({50, 0.5, 50});
  if (ground == Ground::kPlane) return scene.make(shape_desc(PLUMB_PLANE));
  const Flat flat = ground == Ground::kField        ? Flat::kField
                    : ground == Ground::kBackOfMesh ? Flat::kBackOfMesh
                                                    : Flat::kMesh;
  return make_flat(scene, flat, cells, side);
}
void add_ground(Scene& scene, Ground ground, std::uint32_t cells = 64, double side = 0.47) {
  scene.add_static(make_ground(scene, ground, cells, side), {0, ground == Ground::kBox ? -0.5 : 0, 0});
}

struct Ride {
  double distance, sideways, most_rise;
};
enum class Rider { kBox, kSphere, kCapsule, kHull };
constexpr Rider kRiders[] = {Rider::kBox, Rider::kSphere, Rider::kCapsule, Rider::kHull};

/// Sends a body over the ground, askew to its edges.
Ride ride(Ground ground, Rider rider) {
  Scene scene(engine(), kSurfaceNeeds, kDown, 1);
  add_ground(scene, ground);
  const double speed = rider == Rider::kSphere || rider == Rider::kCapsule ? 3 : 5;
  const double heading = 0.3;
  const PlumbQuat turn = {0, std::sin(-heading / 2), 0, std::cos(-heading / 2)};
  const PlumbShape shape =
      rider == Rider::kBox      ? scene.box({0.5, 0.5, 0.5})
      : rider == Rider::kSphere ? scene.sphere(0.5)
      : rider == Rider::kHull
          ? scene.hull({{-0.5, -0.5, -0.5}, {0.5, -0.5, -0.5}, {0.5, -0.5, 0.5}, {-0.5, -0.5, 0.5}, {0, 0.5, 0}})
          : scene.capsule(0.5, 0.6);
  const double half = std::sqrt(0.5);  // a capsule lies across its way
  const PlumbQuat lying = {half * turn.w, half * turn.y, -half * turn.y, half * turn.w};
  scene.body.material.friction = 0.5;
  scene.body.linear_velocity = {speed * std::cos(heading), 0, speed * std::sin(heading)};
  const double start = 0.5;
  const PlumbBody body = scene.add(shape, {0.113, start, 0.071}, rider == Rider::kCapsule ? lying : turn);
  Ride out{0, 0, 0};
  for (int i = 0; i < 150; ++i) {
    scene.run(1);
    if (i > 30) out.most_rise = std::max(out.most_rise, std::abs(scene.velocity(body)[1]) / speed);
  }
  const PlumbVec3 at = scene.poses().back().position;
  const double dx = at.x - 0.113, dz = at.z - 0.071;
  out.distance = dx * std::cos(heading) + dz * std::sin(heading);
  out.sideways = std::abs(dz * std::cos(heading) - dx * std::sin(heading));
  EXPECT_NEAR(at.y, start, 0.02);
  return out;
}

TEST(Surfaces, InnerEdgesDoNotCatch) {
  for (const Rider rider : kRiders) {
    const Ride on_box = ride(Ground::kBox, rider);
    EXPECT_LT(on_box.most_rise, 0.02);
    for (const Ground ground : kGrounds) {
      SCOPED_TRACE("ground " + std::to_string(static_cast<int>(ground)) + " rider " +
                   std::to_string(static_cast<int>(rider)));
      const Ride on_it = ride(ground, rider);
      EXPECT_NEAR(on_it.distance / on_box.distance, 1, 0.01);
      EXPECT_LT(on_it.most_rise, on_box.most_rise + 0.002);
      EXPECT_LT(on_it.sideways, 0.02);
    }
  }
}

/// All shapes stand on a coarse and a fine mesh cube as on a box.
TEST(Surfaces, AMeshCubeHoldsAsABox) {
  for (const std::uint32_t cells : {1U, 5U})
    for (const double aside : {0.0, 0.31})
      for (const Rider rider : kRiders) {
        SCOPED_TRACE(std::to_string(cells) + " cells, " + std::to_string(aside) + " aside, rider " +
                     std::to_string(static_cast<int>(rider)));
        Scene scene(engine(), kSurfaceNeeds, kDown, 1);
        scene.add_static(scene.make(cube(1, cells).desc()), {0, -1, 0});
        const double half = std::sqrt(0.5);
        const PlumbShape shape =
            rider == Rider::kBox      ? scene.box({1, 0.5, 1})
            : rider == Rider::kSphere ? scene.sphere(0.5)
            : rider == Rider::kCapsule
                ? scene.capsule(0.5, 0.4)
                : scene.hull({{-1, -0.5, -1}, {1, -0.5, -1}, {1, -0.5, 1}, {-1, -0.5, 1}, {0, 0.5, 0}});
        scene.add(shape, {aside, 0.52, 0},
                  rider == Rider::kCapsule ? PlumbQuat{0, 0, half, half} : PlumbQuat{0, 0, 0, 1});
        scene.run(120);
        const PlumbVec3 at = scene.poses().back().position;
        EXPECT_NEAR(at.y, 0.5, 0.01);
        EXPECT_NEAR(at.x, aside, 0.01);
        EXPECT_NEAR(at.z, 0, 0.01);
      }
}

/// A box slides off a cube of triangles as it does off a box, with no wall to hold it at the rim.
TEST(Surfaces, NothingHoldsABoxAtTheRim) {
  const auto end = [](bool mesh) {
    Scene scene(engine(), kSurfaceNeeds, kDown, 1);
    scene.add_static(mesh ? scene.make(cube(1, 4).desc()) : scene.box({1, 1, 1}), {0, -1, 0});
    scene.body.material.friction = 0.1;
    scene.body.linear_velocity = {4, 0, 0};
    scene.add(scene.box({1, 0.5, 1}), {0, 0.5, 0});
    scene.run(30);
    return scene.poses().back().position;
  };
  const PlumbVec3 on_mesh = end(true), on_box = end(false);
  EXPECT_NEAR(on_mesh.x, on_box.x, 0.01);
  EXPECT_NEAR(on_mesh.y, on_box.y, 0.01);
}

TEST(Surfaces, AStepStopsABox) {
  Scene scene(engine(), kSurfaceNeeds, kDown, 1);
  const TriangleSet steps =
      grid(40, 0.25, [](double x, double) { return x > 1.05 ? 0.3 : 0.0; });  // a steep ramp from 1 to 1.25
  scene.add_static(scene.make(steps.desc()), {0, 0, 0});
  scene.add_static(scene.make(cube(1, 6).desc()), {0, 0, 3});
  scene.body.material.friction = 0;
  scene.body.linear_velocity = {0, 0, 2};
  scene.add(scene.box({0.3, 0.3, 0.3}), {0, 0.3, 0});  // into the wall of the cube at z = 2
  scene.run(120);
  const PlumbVec3 at = scene.poses().back().position;
  EXPECT_LE(at.z, 1.71);
  EXPECT_NEAR(at.y, 0.3, 0.01);
}

TEST(Surfaces, AMovingMeshCarriesWhatStandsOnIt) {
  Scene scene(engine(), kSurfaceNeeds, kDown, 1);
  scene.body.material.friction = 1;
  const PlumbBody table = scene.add_kinematic(scene.make(flat_grid(20, 0.4).desc()), {0, 0, 0});
  scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  scene.before_step = [&](Scene& s, int step) { s.target(table, {0.01 * (step + 1), 0.005 * (step + 1), 0}); };
  scene.run(120);
  const PlumbVec3 at = scene.poses().back().position;
  EXPECT_NEAR(at.x, 1.2, 0.05);
  EXPECT_NEAR(at.y, 1.1, 0.01);
}

TEST(Surfaces, ContactsNameTheTriangle) {
  for (const bool field : {false, true}) {
    Scene scene(engine(), kSurfaceNeeds, kDown, 1);
    const std::vector<double> heights(25, 0.0);
    scene.add_static(field ? scene.make(field_desc(heights, 5, 5, 1)) : scene.make(flat_grid(4, 1).desc()), {0, 0, 0});
    scene.add(scene.sphere(0.1), {0.8, 0.1, -1.4});  // the cell of column 2, row 0; behind its diagonal
    scene.run(2);
    const auto contacts = scene.world().contacts();
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_EQ(contacts[0].child_a + contacts[0].child_b, 2U * 2U + 1U);
  }
}

/// More triangles under one body than there was room for, and than there are colours; shown to the host, lest those in
/// one plane be one contact.
TEST(Surfaces, ALargeBoxRestsOnManySmallTriangles) {
  Scene scene(engine(), kSurfaceNeeds | PLUMB_NEED_CONTACT_MODIFICATION, kDown, 1);
  scene.body.flags = static_cast<std::uint32_t>(PLUMB_BODY_MODIFY_CONTACTS);
  scene.add_static(scene.make(flat_grid(60, 0.06).desc()), {0, 0, 0});
  scene.add(scene.box({0.9, 0.2, 0.9}), {0, 0.21, 0});
  scene.run(60);
  EXPECT_GT(scene.world().contacts().size(), 1024U);
  EXPECT_NEAR(scene.poses().back().position.y, 0.2, 0.01);
  EXPECT_NEAR(scene.poses().back().position.x, 0, 0.01);
}

TEST(Surfaces, FlatTrianglesOfNoAreaAreLeftOut) {
  Scene scene(engine(), kSurfaceNeeds, kDown, 1);
  TriangleSet set = flat_grid(4, 1);
  set.triangle(0, 0, 1);
  set.triangle(2, 12, 22);
  scene.add_static(scene.make(set.desc()), {0, 0, 0});
  scene.add(scene.box({0.3, 0.3, 0.3}), {0, 0.3, 0});
  scene.run(60);
  EXPECT_NEAR(scene.poses().back().position.y, 0.3, 0.01);
}

PlumbShape make_cylinder(Scene& scene, double radius, double half) {
  PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
  desc.radius = radius;
  desc.half_height = half;
  return scene.make(desc);
}

TEST(RoundBodies, CylindersStandAndStackOnEveryGround) {
  for (const Ground ground : {Ground::kBox, Ground::kPlane, Ground::kMesh, Ground::kField}) {
    Scene scene(engine(), kSurfaceNeeds, kDown, 1);
    add_ground(scene, ground);
    const PlumbShape thick = make_cylinder(scene, 0.5, 0.5), thin = make_cylinder(scene, 0.3, 0.4);
    scene.add(thick, {0.2, 0.51, 0.1});
    scene.add(thick, {0.2, 1.52, 0.1});
    scene.add(thin, {0.2, 2.43, 0.1});
    scene.add(scene.box({0.3, 0.3, 0.3}), {0.2, 3.14, 0.1});
    scene.run(240);
    const std::vector<PlumbPose> poses = scene.poses();
    const double heights[] = {0.5, 1.5, 2.4, 3.1};
    for (std::size_t i = 0; i < 4; ++i) {
      SCOPED_TRACE("ground " + std::to_string(static_cast<int>(ground)) + " body " + std::to_string(i));
      EXPECT_NEAR(poses[i + 1].position.y, heights[i], 0.01);
      EXPECT_NEAR(poses[i + 1].position.x, 0.2, 0.01);
      EXPECT_NEAR(poses[i + 1].position.z, 0.1, 0.01);
    }
  }
}

/// A rolling cylinder keeps its speed and its heading.
TEST(RoundBodies, CylindersRollTrueOnEveryGround) {
  for (const Ground ground : {Ground::kBox, Ground::kPlane, Ground::kMesh, Ground::kField}) {
    SCOPED_TRACE("ground " + std::to_string(static_cast<int>(ground)));
    Scene scene(engine(), kSurfaceNeeds, kDown, 1);
    add_ground(scene, ground);
    const double half = std::sqrt(0.5);
    scene.body.linear_velocity = {2, 0, 0};
    scene.body.angular_velocity = {0, 0, -4};
    scene.add(make_cylinder(scene, 0.5, 0.7), {0, 0.5, 0}, {half, 0, 0, half});
    scene.run(240);
    const PlumbVec3 at = scene.poses()[1].position;
    EXPECT_NEAR(at.x, 8, 0.02);
    EXPECT_NEAR(at.y, 0.5, 0.005);
    EXPECT_NEAR(at.z, 0, 0.01);
  }
}

/// However deep it is in a plane and however it lies there, a rod is pushed out.
TEST(RoundBodies, CylindersComeOutOfAPlane) {
  constexpr double kRadius = 0.02, kHalf = 0.12;
  for (const double depth : {0.01, 0.03, 0.06, 0.1})
    for (const double tilt : {0.0, 0.02, 0.2, 0.6, 1.0, 1.4, 1.55}) {  // of its axis from level
      SCOPED_TRACE("depth " + std::to_string(depth) + " tilt " + std::to_string(tilt));
      Scene scene(engine(), kSurfaceNeeds, kDown, 1);
      add_ground(scene, Ground::kPlane);
      const double turn = (std::acos(-1.0) / 2 - tilt) / 2;
      const double reach = kHalf * std::sin(tilt) + kRadius * std::cos(tilt);
      scene.add(make_cylinder(scene, kRadius, kHalf), {0, reach - depth, 0}, {std::sin(turn), 0, 0, std::cos(turn)});
      scene.run(300);
      const PlumbPose pose = scene.poses()[1];
      const PlumbQuat& q = pose.orientation;
      const double up = std::min(1.0, std::abs(1 - 2 * (q.x * q.x + q.z * q.z)));
      EXPECT_GT(pose.position.y, kHalf * up + kRadius * std::sqrt(1 - up * up) - 1e-3);
    }
}

}  // namespace
}  // namespace plumb::impulse::test
