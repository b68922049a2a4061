#include <cmath>

#include "backend_under_test.hpp"
#include "plumb/helpers/force_fields.hpp"

namespace plumb::helpers::test {
namespace {

const double pi = std::acos(-1.0);

TEST(Submerged, BoxesAndSpheresByClosedForms) {
  const PlumbPose tilted{{3, 0.25, -2}, {std::sin(pi / 8), 0, 0, std::cos(pi / 8)}};  // 45 degrees about x
  // An edge down: of a square on its corner, the triangle below the line has the height's square as area.
  const double height = std::sqrt(2.0) - 0.25;
  const Submerged box = submerged_hull(box_hull({1, 1, 1}), tilted, {0, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(box.volume, 2 * (height * height), 1e-12);
  EXPECT_NEAR(box.centroid.y, -height / 3, 1e-12);
  EXPECT_NEAR(box.centroid.x, 3, 1e-12);
  const Submerged half = submerged_sphere({0, 0, 0}, 2, {0, 0, 0}, {0, 1, 0});
  EXPECT_NEAR(half.volume, 2 * pi / 3 * 8, 1e-12);
  EXPECT_NEAR(half.centroid.y, -3.0 / 8 * 2, 1e-12);
  EXPECT_NEAR(submerged_hull(cylinder_hull(0.5, 1), identity_pose(), {0, 0.5, 0}, {0, 1, 0}).volume, pi / 4 * 1.5,
              1e-12);
}

TEST(ForceFields, ABoxFloatsAtItsDensityAndBobsInItsPeriod) {
  TestWorld t;
  const PlumbVec3 half{0.5, 0.25, 0.5};
  const double mass = 0.6 * 1000 * 0.5;  // floats 0.3 m deep
  const PlumbBody box = t.box(PLUMB_DYNAMIC, half, {0, 0.02, 0}, mass);
  ForceFields fields(*t.world, std::span(&box, 1));
  Water still;
  still.linear_drag = still.angular_drag = 0;
  const Hull hull = box_hull(half);
  const double rest = -0.05, dt = 1.0 / 240;
  std::vector<double> crossings;
  double before = 1;
  for (int i = 0; i < 1200; ++i) {
    fields.gather();
    fields.float_hull(0, hull, still);
    fields.apply();
    t.step(dt);
    const double y = t.pose(box).position.y - rest;
    if (before > 0 && y <= 0) crossings.push_back(i * dt);
    before = y;
  }
  const double period = 2 * pi * std::sqrt(0.3 / 9.81);
  ASSERT_GE(crossings.size(), 4u);
  EXPECT_NEAR((crossings.back() - crossings.front()) / static_cast<double>(crossings.size() - 1), period,
              0.01 * period);
  still.linear_drag = 5;
  for (int i = 0; i < 1200; ++i) {
    fields.gather();
    fields.float_hull(0, hull, still);
    fields.apply();
    t.step(dt);
  }
  EXPECT_NEAR(t.pose(box).position.y, rest, 1e-3);
}

TEST(ForceFields, PointGravityHoldsACircularOrbit) {
  TestWorld t({0, 0, 0});
  const PlumbBody moon = t.sphere(0.1, {4, 0, 0}, 3);
  t.set_velocity(moon, {{0, 0, 2}, {0, 0, 0}});  // v^2 = r a, a = 1
  ForceFields fields(*t.world, std::span(&moon, 1));
  PointGravity sun;
  sun.strength = 16;
  for (int i = 0; i < 1000; ++i) {
    fields.gather();
    fields.add(sun);
    fields.apply();
    t.step(1.0 / 240);
    const PlumbVec3 at = t.pose(moon).position;
    ASSERT_NEAR(std::hypot(at.x, at.z), 4, 0.03) << i;
  }
}

TEST(ForceFields, WindAndZones) {
  TestWorld t({0, 0, 0});
  const PlumbBody bodies[2] = {t.sphere(0.5, {0, 0, 0}, 2), t.sphere(0.5, {10, 0, 0}, 2)};
  ForceFields fields(*t.world, bodies);
  Wind wind;
  wind.zone.radius = 5;
  wind.velocity = {3, 0, 0};
  wind.drag_area = 2;
  fields.add(wind);
  EXPECT_NEAR(fields.force(0).x, 0.5 * 1.2 * 2 * 9, 1e-12);
  EXPECT_EQ(fields.force(1).x, 0);
  fields.add(DirectionalGravity{{}, {0, 1, 0}});
  EXPECT_NEAR(fields.force(1).y, 2, 1e-6);
}

TEST(Explosion, IsSymmetricFallsOffAndSparesWhatIsBehindAWall) {
  TestWorld t({0, 0, 0});
  const PlumbBody bodies[4] = {t.sphere(0.25, {2, 0, 0}, 2), t.sphere(0.25, {-2, 0, 0}, 2),
                               t.sphere(0.25, {0, 0, 3}, 2), t.sphere(0.25, {0, 0, -9}, 2)};
  t.box(PLUMB_STATIC, {1, 1, 0.1}, {0, 0, 1.5});
  t.step(1e-4);
  Explosion blast;
  blast.line_of_sight = true;
  EXPECT_EQ(explode(*t.world, bodies, blast), 2u);
  EXPECT_NEAR(t.velocity(bodies[0]).linear.x, 100 * (1 - 2.0 / 5) / 2, 1e-4);
  EXPECT_NEAR(t.velocity(bodies[1]).linear.x, -30, 1e-4);
  EXPECT_EQ(t.velocity(bodies[2]).linear.z, 0);
  blast.line_of_sight = false;
  EXPECT_EQ(explode(*t.world, bodies, blast), 3u);
  EXPECT_NEAR(t.velocity(bodies[2]).linear.z, 20, 1e-4);
}

TEST(ForceFields, SayWhatTheWorldDidNotDeclare) {
  TestWorld t({0, 0, 0}, PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION);
  const PlumbBody body = t.sphere(0.5, {0, 0, 0}, 1);
  try {
    ForceFields fields(*t.world, std::span(&body, 1));
    FAIL() << "forces were not declared";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), PLUMB_E_NOT_DECLARED);
  }
}

}  // namespace
}  // namespace plumb::helpers::test
