// What lies on a mesh or a height field is not looked for anew in every step; nothing may come of that.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;
constexpr PlumbVec3 kHalf = {0.5, 0.25, 0.4};
constexpr double kStep = 1.0 / 60, kGravity = 9.81;
constexpr Flat kFlats[] = {Flat::kMesh, Flat::kBackOfMesh, Flat::kField};

TEST(SurfaceRecycling, WhatIsLeftWithoutGroundFalls) {
  constexpr int kSteps = 30;
  for (const Flat flat : kFlats) {
    Scene scene(engine(), kNeeds, kDown, 1);
    const PlumbBody ground = scene.add_static(make_flat(scene, flat, 20, 0.1), {0, 0, 0});
    scene.add(scene.box(kHalf), {0, kHalf.y, 0});
    scene.run(60);
    const double before = scene.poses().back().position.y;
    EXPECT_NEAR(before, kHalf.y, 1e-4);
    scene.remove(ground);
    scene.run(kSteps);
    const double fallen = kGravity * kStep * kStep * kSteps * kSteps / 2;
    EXPECT_NEAR(before - scene.poses().back().position.y, fallen, 0.05 * fallen);
  }
}

/// So slowly that many steps in a row recycle the same contacts.
TEST(SurfaceRecycling, WhatSlidesOverARimTipsThereAsOffABox) {
  const auto crossing = [](bool on_mesh) {
    Scene scene(engine(), kNeeds, kDown, 1);
    if (on_mesh)
      scene.add_static(make_flat(scene, Flat::kMesh, 20, 0.1), {0, 0, 0});
    else
      scene.add_static(scene.box({1, 1, 1}), {0, -1, 0});
    scene.body.material.friction = 0;
    scene.body.linear_velocity = {0.01, 0, 0};
    scene.add(scene.box(kHalf), {0.995, kHalf.y, 0});
    scene.run(90);
    return scene.poses().back();
  };
  const PlumbPose mesh = crossing(true), box = crossing(false);
  EXPECT_LT(box.orientation.z, -0.01);
  EXPECT_NEAR(mesh.orientation.z, box.orientation.z, 0.2 * std::abs(box.orientation.z));
  EXPECT_NEAR(mesh.position.y, box.position.y, 0.01);
}

TEST(SurfaceRecycling, WhatRidesOnAMovingSurfaceGoesWithIt) {
  constexpr double kSpeed = 0.3;
  for (const Flat flat : kFlats) {
    Scene scene(engine(), kNeeds | PLUMB_NEED_KINEMATIC, kDown, 1);
    const PlumbBody platform = scene.add_kinematic(make_flat(scene, flat, 40, 0.1), {0, 0, 0});
    scene.body.material.friction = 0.8;
    const PlumbBody box = scene.add(scene.box(kHalf), {0, kHalf.y, 0});
    double x = 0;
    scene.before_step = [&](Scene& at, int) { at.target(platform, {x += kSpeed * kStep, 0, 0}); };
    scene.run(180);
    EXPECT_NEAR(scene.velocity(box)[0], kSpeed, 1e-3);
    EXPECT_NEAR(scene.poses().back().position.x, x, 0.02);  // it slipped v^2 / (2 mu g) at first
    EXPECT_NEAR(scene.poses().back().position.y, kHalf.y, 1e-3);
  }
}

/// A wall of the same mesh that was out of reach when contacts were last looked for.
TEST(SurfaceRecycling, AWallStopsWhatIsPushedFromRest) {
  constexpr double kWall = 1;
  for (const double gap : {1e-4, 2e-3, 0.02, 0.3})
    for (const double speed : {0.05, 0.5, 5.0}) {
      SCOPED_TRACE(::testing::Message() << "gap " << gap << " at " << speed);
      Scene scene(engine(), kNeeds, kDown, 1);
      TriangleSet room = grid(40, 0.05, [](double, double) { return 0.0; });
      const std::uint32_t a = room.add(kWall, 0, -1), b = room.add(kWall, 0, 1), c = room.add(kWall, 2, -1),
                          d = room.add(kWall, 2, 1);
      room.triangle(a, b, c);
      room.triangle(c, b, d);
      scene.add_static(scene.make(room.desc()), {0, 0, 0});
      scene.body.material.friction = 0;
      const PlumbBody box = scene.add(scene.box(kHalf), {kWall - kHalf.x - gap, kHalf.y, 0});
      scene.run(60);
      scene.write(PLUMB_FIELD_VELOCITY, box, {speed, 0, 0, 0, 0, 0});
      double furthest = 0;
      for (int step = 0; step < 60; ++step) {
        scene.run(1);
        furthest = std::max(furthest, scene.poses().back().position.x + kHalf.x);
      }
      EXPECT_LT(furthest, kWall + 2e-3);
      if (gap + 0.05 < speed) {
        EXPECT_GT(furthest, kWall - 2e-3);
      }
    }
}

/// Bumps that hold a box on a few points let it come to rest, though it could lie on others as well.
TEST(SurfaceRecycling, BoxesOnGravelComeToRest) {
  Scene scene(engine(), kNeeds, kDown, 1);
  const TriangleSet gravel = grid(120, 0.05, [](double x, double z) {
    return 0.02 * std::sin(37 * x) * std::cos(41 * z) + 0.01 * std::sin(23 * x + 11 * z);
  });
  scene.add_static(scene.make(gravel.desc()), {0, 0, 0});
  scene.body.material.friction = 0.5;
  std::vector<PlumbBody> boxes;
  for (int i = 0; i < 9; ++i)
    boxes.push_back(scene.add(scene.box(kHalf), {1.7 * (i % 3) - 1.7, 0.5, 1.7 * (i / 3) - 1.7}, {0, 0, 0, 1}));
  scene.run(300);
  for (const PlumbBody box : boxes)
    for (const double speed : scene.velocity(box)) EXPECT_NEAR(speed, 0, 1e-4);
}

}  // namespace
}  // namespace plumb::impulse::test
