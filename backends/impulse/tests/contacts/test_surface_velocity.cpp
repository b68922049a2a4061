// Surfaces that run on bodies that stand, against closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kRunningNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_SURFACE_VELOCITY;
constexpr double kGravity = 9.81, kSpeed = 2, kFriction = 0.3;
constexpr const char* kSolvers[] = {"tgs_soft", "si", "jacobi", "xpbd"};

std::vector<double> read(Scene& scene, PlumbField field, PlumbBody body, std::size_t columns) {
  std::vector<double> row(columns);
  check(scene.world(),
        scene.world().read(field, {&body, 1},
                           Rows(reinterpret_cast<std::byte*>(row.data()), 1, columns * sizeof(double), PLUMB_F64)));
  return row;
}
PlumbVec3 place(Scene& scene, PlumbBody body) {
  const std::vector<double> row = read(scene, PLUMB_FIELD_POSE, body, 7);
  return {row[0], row[1], row[2]};
}
bool is_awake(Scene& scene, PlumbBody body) { return read(scene, PLUMB_FIELD_AWAKE, body, 1)[0] != 0; }

PlumbQuat turn_about(const PlumbVec3& axis, double angle) {
  const double s = std::sin(angle / 2);
  return {s * axis.x, s * axis.y, s * axis.z, std::cos(angle / 2)};
}

/// The next bodies' surfaces run so.
void set_belt(Scene& scene, const PlumbVec3& speed) { scene.body.material.surface_velocity = speed; }

/// With every solver: slips for v / (mu g), and is v^2 / (2 mu g) behind then.
TEST(SurfaceVelocity, TakeABoxAlongAsCoulombSays) {
  for (const char* const solver : kSolvers) {
    SCOPED_TRACE(solver);
    Scene scene(engine(), kRunningNeeds, kDown, 1, {"solver", solver});
    scene.body.material.friction = kFriction;
    set_belt(scene, {kSpeed, 0, 0});
    scene.ground();
    set_belt(scene, {0, 0, 0});
    const PlumbBody body = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
    double slips = 0, first = 0, last = 0;
    for (int step = 1; step <= 90; ++step) {
      scene.run(1);
      const double speed = scene.velocity(body)[0], t = step / 60.0;
      EXPECT_NEAR(speed, std::min(kFriction * kGravity * t, kSpeed), kFriction * kGravity / 60) << "at " << t << " s";
      if (speed < kSpeed * 0.999) slips = t + (kSpeed - speed) / (kFriction * kGravity);
      (step == 30 ? first : last) = speed;
    }
    EXPECT_NEAR(slips, 0.67957866, 1.0 / 60);
    EXPECT_NEAR(first, kFriction * kGravity * 0.5, 2e-3);
    EXPECT_NEAR(last, kSpeed, 1e-5);
    // Positions go with the velocity at the end of each part of a step.
    EXPECT_NEAR(kSpeed * 1.5 - place(scene, body).x, 0.67957866, kSpeed / 60 / 2 * 1.1);
    EXPECT_NEAR(place(scene, body).y, 0.5, 0.01);
    EXPECT_NEAR(place(scene, body).z, 0, 1e-4);
  }
}

/// Uphill, against gravity: a = g (mu cos - sin), until it goes with the belt.
TEST(SurfaceVelocity, CarryABoxUphill) {
  constexpr double kSlope = 0.3, kSteep = 0.6;
  for (const char* const solver : kSolvers) {
    SCOPED_TRACE(solver);
    Scene scene(engine(), kRunningNeeds, kDown, 1, {"solver", solver});
    const PlumbQuat tilt = turn_about({0, 0, 1}, kSlope);
    scene.body.material.friction = kSteep;
    set_belt(scene, {kSpeed, 0, 0});
    scene.add_static(scene.box({50, 0.5, 50}), {0, 0, 0}, tilt);
    set_belt(scene, {0, 0, 0});
    const PlumbBody body = scene.add(scene.box({0.5, 0.5, 0.5}), {-std::sin(kSlope), std::cos(kSlope), 0}, tilt);
    const auto along = [&] {
      const std::vector<double> v = scene.velocity(body);
      return v[0] * std::cos(kSlope) + v[1] * std::sin(kSlope);
    };
    scene.run(15);
    EXPECT_NEAR(along(), kGravity * (kSteep * std::cos(kSlope) - std::sin(kSlope)) * 0.25, 5e-3);
    scene.run(105);
    EXPECT_NEAR(along(), kSpeed, 1e-2);
    EXPECT_GT(place(scene, body).y, std::cos(kSlope) + std::sin(kSlope));
  }
}

/// The velocity is in the body's frame.
TEST(SurfaceVelocity, TurnWithTheirBodies) {
  constexpr double kYaw = 0.7;
  Scene scene(engine(), kRunningNeeds, kDown, 1);
  set_belt(scene, {kSpeed, 0, 0});
  scene.add_static(scene.box({50, 0.5, 50}), {0, -0.5, 0}, turn_about({0, 1, 0}, kYaw));
  set_belt(scene, {0, 0, 0});
  const PlumbBody body = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  scene.run(120);
  EXPECT_NEAR(scene.velocity(body)[0], kSpeed * std::cos(kYaw), 1e-3);
  EXPECT_NEAR(scene.velocity(body)[2], -kSpeed * std::sin(kYaw), 1e-3);
  EXPECT_NEAR(scene.velocity(body)[4], 0, 1e-3) << "nothing turns it";
}

/// A ball takes its spin from the belt, too: it rolls on the belt when 2/7 of its speed is the ball's.
TEST(SurfaceVelocity, RollABall) {
  for (const char* const solver : kSolvers) {
    SCOPED_TRACE(solver);
    Scene scene(engine(), kRunningNeeds, kDown, 1, {"solver", solver});
    scene.body.material.friction = kFriction;
    set_belt(scene, {kSpeed, 0, 0});
    scene.ground();
    set_belt(scene, {0, 0, 0});
    const PlumbBody ball = scene.add(scene.sphere(0.5), {0, 0.5, 0});
    scene.run(5);
    EXPECT_NEAR(scene.velocity(ball)[0], kFriction * kGravity * 5 / 60, 5e-3);
    scene.run(55);
    EXPECT_NEAR(scene.velocity(ball)[0], kSpeed * 2 / 7, 2e-3);
    EXPECT_NEAR(scene.velocity(ball)[5], kSpeed * 5 / 7 / 0.5, 1e-2);
  }
}

TEST(SurfaceVelocity, RunOnBodiesThatMove) {
  Scene scene(engine(), kRunningNeeds | PLUMB_NEED_KINEMATIC, kDown, 1);
  set_belt(scene, {kSpeed, 0, 0});
  const PlumbBody carrier = scene.add_kinematic(scene.box({50, 0.5, 50}), {0, -0.5, 0});
  set_belt(scene, {0, 0, 0});
  scene.write(PLUMB_FIELD_VELOCITY, carrier, {-0.5, 0, 1, 0, 0, 0});
  const PlumbBody body = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  scene.run(120);
  EXPECT_NEAR(scene.velocity(body)[0], kSpeed - 0.5, 1e-4);
  EXPECT_NEAR(scene.velocity(body)[2], 1, 1e-4);
}

/// What a belt gives to one body it takes from its own.
TEST(SurfaceVelocity, KeepMomentum) {
  for (const char* const solver : kSolvers) {
    SCOPED_TRACE(solver);
    Scene scene(engine(), kRunningNeeds, kDown, 1, {"solver", solver});
    scene.body.material.friction = 0;
    scene.ground();
    scene.body.material.friction = 0.8;
    scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
    scene.body.mass = 30;
    set_belt(scene, {kSpeed, 0, 0});
    const PlumbBody slab = scene.add(scene.box({6, 0.5, 3}), {0, 0.5, 0});
    set_belt(scene, {0, 0, 0});
    scene.body.mass = 10;
    const PlumbBody body = scene.add(scene.box({0.5, 0.5, 0.5}), {-1, 1.5, 0});
    scene.run(60);
    EXPECT_NEAR(scene.velocity(body)[0], kSpeed * 0.75, 2e-3);
    EXPECT_NEAR(scene.velocity(slab)[0], -kSpeed * 0.25, 2e-3);
  }
}

/// Whatever the axes of inertia are: a slab that lies askew in its body's frame runs along that.
TEST(SurfaceVelocity, RunInTheirBodysFrame) {
  Scene scene(engine(), kRunningNeeds, kDown, 1);
  scene.body.material.friction = 0;
  scene.ground();
  scene.body.material.friction = 0.8;
  std::vector<PlumbVec3> corners;
  for (int i = 0; i < 8; ++i) {
    const double x = i % 2 * 12 - 6, y = i / 2 % 2 - 0.5, z = i / 4 * 6 - 3;
    corners.push_back({0.8 * x + 0.6 * z, y, 0.8 * z - 0.6 * x});
  }
  set_belt(scene, {kSpeed, 0, 0});
  const PlumbBody slab = scene.add(scene.hull(corners), {0, 0.5, 0});
  set_belt(scene, {0, 0, 0});
  const PlumbBody body = scene.add(scene.box({0.5, 0.5, 0.5}), {-1, 1.5, 0});
  scene.run(60);
  EXPECT_NEAR(scene.velocity(body)[0] - scene.velocity(slab)[0], kSpeed, 5e-3);
  EXPECT_NEAR(scene.velocity(body)[2] - scene.velocity(slab)[2], 0, 2e-2);
}

TEST(SurfaceVelocity, RunOnEveryGround) {
  for (const PlumbShapeType type : {PLUMB_PLANE, PLUMB_TRIANGLE_MESH, PLUMB_HEIGHT_FIELD}) {
    SCOPED_TRACE(type);
    Scene scene(engine(), kRunningNeeds, kDown, 1);
    set_belt(scene, {0, 0, kSpeed});
    const TriangleSet grid = flat_grid(16, 2);
    scene.add_static(scene.make(type == PLUMB_PLANE           ? shape_desc(PLUMB_PLANE)
                                : type == PLUMB_TRIANGLE_MESH ? grid.desc()
                                                              : field_desc(std::vector<double>(289, 0.0), 17, 17, 2)),
                     {0, 0, 0});
    set_belt(scene, {0, 0, 0});
    const PlumbBody body = scene.add(scene.box({0.5, 0.5, 0.5}), {0.1, 0.5, 0.2});
    scene.run(90);
    EXPECT_NEAR(scene.velocity(body)[2], kSpeed, 1e-3);
    EXPECT_NEAR(scene.velocity(body)[0], 0, 1e-3);
  }
}

/// A child with a material of its own has a belt of its own; the others have their body's, which can be written.
TEST(SurfaceVelocity, OfChildren) {
  Scene scene(engine(), kRunningNeeds, kDown, 1);
  const PlumbShape half = scene.box({5, 0.5, 5});
  PlumbMaterial running = scene.body.material;
  running.surface_velocity = {0, 0, kSpeed};
  const PlumbCompoundChild children[] = {{half, {{-5, -0.5, 0}, {0, 0, 0, 1}}, 0, 0, {}},
                                         {half, {{5, -0.5, 0}, {0, 0, 0, 1}}, 1, 0, running}};
  PlumbShapeDesc desc = shape_desc(PLUMB_COMPOUND);
  desc.children = children;
  desc.child_count = 2;
  const PlumbBody ground = scene.add_static(scene.make(desc), {0, 0, 0});
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  const PlumbBody on_first = scene.add(cube, {-3, 0.5, 0}), on_second = scene.add(cube, {3, 0.5, 0});
  scene.run(60);
  EXPECT_NEAR(scene.velocity(on_first)[2], 0, 1e-4);
  EXPECT_NEAR(scene.velocity(on_second)[2], kSpeed, 1e-3);
  scene.write(PLUMB_FIELD_SURFACE_VELOCITY, ground, {0, 0, -1});
  EXPECT_EQ(read(scene, PLUMB_FIELD_SURFACE_VELOCITY, ground, 3)[2], -1);
  scene.run(60);
  EXPECT_NEAR(scene.velocity(on_first)[2], -1, 1e-3);
  EXPECT_NEAR(scene.velocity(on_second)[2], kSpeed, 1e-3);
}

/// Slow as it is, a belt lets nobody sleep; nor does it start without those who sleep on it.
TEST(SurfaceVelocity, LetNobodySleep) {
  Scene scene(engine(), kRunningNeeds | PLUMB_NEED_SLEEPING, kDown, 1);
  set_belt(scene, {0.01, 0, 0});
  const PlumbBody belt = scene.add_static(scene.box({50, 0.5, 50}), {0, -0.5, 0});
  set_belt(scene, {0, 0, 0});
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  const PlumbBody below = scene.add(cube, {0, 0.5, 0}), above = scene.add(cube, {0, 1.5, 0});
  scene.run(300);
  EXPECT_TRUE(is_awake(scene, below));
  EXPECT_TRUE(is_awake(scene, above)) << "of the same island";
  EXPECT_NEAR(place(scene, above).x, 0.05, 2e-3);
  scene.write(PLUMB_FIELD_SURFACE_VELOCITY, belt, {0, 0, 0});
  scene.run(60);
  EXPECT_FALSE(is_awake(scene, above)) << "of a belt that stands they sleep";
  scene.write(PLUMB_FIELD_SURFACE_VELOCITY, belt, {1, 0, 0});
  EXPECT_TRUE(is_awake(scene, below));
  scene.run(60);
  EXPECT_NEAR(scene.velocity(above)[0], 1, 1e-2);
}

TEST(SurfaceVelocity, AreInSnapshots) {
  Scene scene(engine(), kRunningNeeds | PLUMB_NEED_SNAPSHOT, kDown, 1);
  set_belt(scene, {kSpeed, 0, 0});
  const PlumbBody belt = scene.add_static(scene.box({50, 0.5, 50}), {0, -0.5, 0}, turn_about({0, 1, 0}, 0.3));
  set_belt(scene, {0, 0, 0});
  scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  scene.run(10);
  std::span<const std::byte> data;
  check(scene.world(), scene.world().snapshot()->save(data));
  const std::vector<std::byte> kept(data.begin(), data.end());
  scene.run(30);
  const std::uint64_t hash = scene.hash();
  scene.write(PLUMB_FIELD_SURFACE_VELOCITY, belt, {-5, 0, 0});
  scene.run(5);
  check(scene.world(), scene.world().snapshot()->restore(kept));
  EXPECT_EQ(read(scene, PLUMB_FIELD_SURFACE_VELOCITY, belt, 3)[0], kSpeed);
  scene.run(30);
  EXPECT_EQ(scene.hash(), hash);
}

/// A world that declares belts and has none goes as one with reactions, which has the code of all joints, too.
TEST(SurfaceVelocity, ThatStandChangeNothing) {
  const auto hash = [](PlumbNeeds more, std::uint32_t threads, double speed) {
    Scene scene(engine(), (kRunningNeeds & ~PLUMB_NEED_SURFACE_VELOCITY) | more, kDown, threads);
    set_belt(scene, {speed, 0, 0});
    scene.container(3, 20);
    set_belt(scene, {0, 0, 0});
    const PlumbShape cube = scene.box({0.4, 0.4, 0.4});
    for (int i = 0; i < 60; ++i)
      scene.add(cube, {1.1 * (i % 4) - 1.6 + 0.01 * i, 1 + 1.2 * (i / 16), 1.1 * (i / 4 % 4) - 1.6});
    scene.run(80);
    return scene.hash();
  };
  EXPECT_EQ(hash(PLUMB_NEED_SURFACE_VELOCITY, 1, 0), hash(0, 1, 0));
  EXPECT_EQ(hash(PLUMB_NEED_SURFACE_VELOCITY, 1, 1), hash(PLUMB_NEED_SURFACE_VELOCITY, 3, 1));
  EXPECT_NE(hash(PLUMB_NEED_SURFACE_VELOCITY, 1, 1), hash(0, 1, 0));
}

TEST(SurfaceVelocity, AreNoFasterThanNumbersGo) {
  Scene scene(engine(), kRunningNeeds, kDown, 1);
  set_belt(scene, {0, 1e300, 0});
  EXPECT_THROW(scene.ground(), Error);
  set_belt(scene, {1, 0, 0});
  const PlumbBody belt = scene.add_static(scene.box({1, 1, 1}), {0, 0, 0});
  EXPECT_THROW(scene.write(PLUMB_FIELD_SURFACE_VELOCITY, belt, {0, 0, -1e300}), Error);
  EXPECT_EQ(read(scene, PLUMB_FIELD_SURFACE_VELOCITY, belt, 3)[0], 1) << "nothing has changed";
}

}  // namespace
}  // namespace plumb::impulse::test
