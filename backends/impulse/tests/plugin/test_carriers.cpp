// Kinematic bodies carry what stands on them, press what is between them, and may be put elsewhere.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kCarrierNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_KINEMATIC;
constexpr const char* kSolvers[] = {"tgs_soft", "si", "jacobi", "xpbd"};

std::vector<double> read(Scene& scene, PlumbField field, PlumbBody body, std::size_t columns) {
  std::vector<double> row(columns);
  check(scene.world(),
        scene.world().read(field, {&body, 1},
                           Rows(reinterpret_cast<std::byte*>(row.data()), 1, columns * sizeof(double), PLUMB_F64)));
  return row;
}
double speed(Scene& scene, PlumbBody body) {
  const std::vector<double> v = scene.velocity(body);
  return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}
PlumbVec3 place(Scene& scene, PlumbBody body) {
  const std::vector<double> row = read(scene, PLUMB_FIELD_POSE, body, 7);
  return {row[0], row[1], row[2]};
}
PlumbShape make_platform(Scene& scene, bool mesh) {
  return mesh ? scene.make(flat_grid(8, 1).desc()) : scene.box({4, 0.5, 4});
}

/// Sent by targets, forth and back and up, with every solver, on a box and on a mesh.
TEST(Carriers, AMovingPlatformTakesABoxAlong) {
  for (const char* const solver : kSolvers)
    for (const bool mesh : {false, true}) {
      SCOPED_TRACE(std::string(solver) + (mesh ? " mesh" : " box"));
      Scene scene(engine(), kCarrierNeeds, kDown, 1, {"solver", solver});
      const double below = mesh ? 0 : -0.5;
      const PlumbBody platform = scene.add_kinematic(make_platform(scene, mesh), {0, below, 0});
      const PlumbBody body = scene.add(scene.box({0.3, 0.3, 0.3}), {0.5, 0.3, 0.2});
      scene.run(30);
      const PlumbVec3 start = place(scene, body);
      scene.before_step = [&](Scene& now, int step) {
        const double t = (step - 29) / 60.0;
        now.target(platform, {1.5 * (1 - std::cos(t)), below + 0.4 * (1 - std::cos(1.5 * t)), std::sin(t) * 0.2});
      };
      for (int i = 0; i < 400; ++i) {
        scene.run(1);
        const double t = (i + 1) / 60.0;
        const PlumbVec3 at = place(scene, body);
        EXPECT_NEAR(at.x - start.x, 1.5 * (1 - std::cos(t)), 0.02);
        EXPECT_NEAR(at.y - start.y, 0.4 * (1 - std::cos(1.5 * t)), 0.02);
        EXPECT_NEAR(at.z - start.z, std::sin(t) * 0.2, 0.02);
        if (HasFailure()) break;
      }
    }
}

/// A box 1 m from the axis of a platform that turns by 1 rad/s: 1 m/s2 holds it, of the 4.9 that friction has.
TEST(Carriers, ATurningPlatformTakesABoxAround) {
  for (const char* const solver : kSolvers)
    for (const bool mesh : {false, true}) {
      SCOPED_TRACE(std::string(solver) + (mesh ? " mesh" : " box"));
      Scene scene(engine(), kCarrierNeeds, kDown, 1, {"solver", solver});
      const PlumbBody platform = scene.add_kinematic(make_platform(scene, mesh), {0, mesh ? 0 : -0.5, 0});
      scene.write(PLUMB_FIELD_VELOCITY, platform, {0, 0, 0, 0, 1, 0});
      scene.body.linear_velocity = {0, 0, -1};
      scene.body.angular_velocity = {0, 1, 0};
      const PlumbBody body = scene.add(scene.box({0.3, 0.3, 0.3}), {1, 0.3, 0});
      scene.run(360);
      const PlumbVec3 at = place(scene, body);
      EXPECT_NEAR(at.x, std::cos(6.0), 0.06);
      EXPECT_NEAR(at.z, -std::sin(6.0), 0.06);
      EXPECT_NEAR(scene.velocity(body)[4], 1, 0.01);
      EXPECT_NEAR(at.y, 0.3, 0.01);
    }
}

/// Two plates press a cube to half its side in a second, hold it, and open by 1 m/s each.
TEST(Carriers, APressLetsGoGently) {
  for (const char* const solver : kSolvers)
    for (const bool upright : {false, true}) {
      SCOPED_TRACE(std::string(solver) + (upright ? " from above" : " from the sides"));
      Scene scene(engine(), kCarrierNeeds, kDown, 1, {"solver", solver});
      if (!upright) scene.ground();
      const auto at = [&](double side, double gap) {
        const double off = side * (gap / 2 + 0.5);
        return upright ? PlumbVec3{0, 0.5 + off, 0} : PlumbVec3{off, 0.55, 0};
      };
      const PlumbShape plate = upright ? scene.box({2, 0.5, 2}) : scene.box({0.5, 0.5, 2});
      const PlumbBody low = scene.add_kinematic(plate, at(-1, 1)), high = scene.add_kinematic(plate, at(1, 1));
      const PlumbBody body = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
      double fastest = 0;
      for (int step = 1; step <= 240; ++step) {
        const double gap = step <= 60 ? 1 - 0.5 * step / 60 : step <= 90 ? 0.5 : 0.5 + 2.0 * (step - 90) / 60;
        scene.target(low, at(-1, std::min(gap, 2.0)));
        scene.target(high, at(1, std::min(gap, 2.0)));
        scene.run(1);
        const double now = speed(scene, body);
        ASSERT_TRUE(std::isfinite(now));
        if (step > 90) fastest = std::max(fastest, now);
      }
      // Between plates that do not give way the impulses of si, which nothing lets leak, grow from step to step: it
      // may throw the cube.
      if (std::string(solver) != "si") {
        EXPECT_LT(fastest, 3);
      }
    }
}

/// Put elsewhere, a platform is gone from below what stood on it, and has no velocity that anybody could take.
TEST(Carriers, ATeleportKicksNobody) {
  for (const char* const solver : kSolvers) {
    SCOPED_TRACE(solver);
    Scene scene(engine(), kCarrierNeeds, kDown, 1, {"solver", solver});
    const PlumbBody platform = scene.add_kinematic(scene.box({4, 0.5, 4}), {0, -0.5, 0});
    const PlumbShape cube = scene.box({0.3, 0.3, 0.3});
    const PlumbBody body = scene.add(cube, {0, 0.3, 0}), other = scene.add(cube, {2, 0.3, 0});
    for (int i = 1; i <= 20; ++i) {
      scene.target(platform, {0.01 * i, -0.5, 0});
      scene.run(1);
    }
    scene.target(platform, {0.5, -0.5, 0});
    scene.write(PLUMB_FIELD_POSE, platform, {5.4, -0.5, 0, 0, 0, 0, 1});
    scene.run(1);
    EXPECT_EQ(speed(scene, platform), 0) << "the target is forgotten";
    EXPECT_NEAR(place(scene, platform).x, 5.4, 1e-6);
    EXPECT_LT(std::abs(scene.velocity(body)[0]), 0.65) << "no more than it had";
    EXPECT_LT(std::abs(scene.velocity(other)[0]), 0.65);
    scene.run(19);
    EXPECT_NEAR(scene.velocity(body)[1], -9.81 / 3, 0.2) << "it falls";
    EXPECT_NEAR(place(scene, other).y, 0.3, 0.02) << "and this stands";
    EXPECT_LT(speed(scene, other), 0.05);
  }
}

/// Put a little into what stands on it, a platform lifts that out without a throw.
TEST(Carriers, ATeleportFromBelowThrowsNobody) {
  for (const char* const solver : kSolvers) {
    SCOPED_TRACE(solver);
    Scene scene(engine(), kCarrierNeeds, kDown, 1, {"solver", solver});
    const PlumbBody platform = scene.add_kinematic(scene.box({4, 0.5, 4}), {0, -0.5, 0});
    const PlumbBody body = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
    scene.run(20);
    scene.write(PLUMB_FIELD_POSE, platform, {0, -0.3, 0, 0, 0, 0, 1});
    double highest = 0;
    for (int i = 0; i < 120; ++i) {
      scene.run(1);
      highest = std::max(highest, place(scene, body).y);
    }
    EXPECT_LT(highest, 0.7 + 0.5);
    EXPECT_NEAR(place(scene, body).y, 0.7, 0.02);
  }
}

}  // namespace
}  // namespace plumb::impulse::test
