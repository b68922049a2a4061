// Facts that are known of Bullet from programs in plain Bullet: if they did not come out, the adapter would hide them.
#include <gtest/gtest.h>

#include <cmath>

#include "plumb_scene.hpp"

namespace {

double kinetic(const std::array<double, 6>& velocity, const std::array<double, 7>& pose, PlumbVec3 inertia) {
  // Angular velocity in the body's axes: v + 2 q x (q x v + w v) with the conjugate.
  const double qx = -pose[3], qy = -pose[4], qz = -pose[5], qw = pose[6];
  const double vx = velocity[3], vy = velocity[4], vz = velocity[5];
  const double cx = qy * vz - qz * vy + qw * vx, cy = qz * vx - qx * vz + qw * vy, cz = qx * vy - qy * vx + qw * vz;
  const double x = vx + 2 * (qy * cz - qz * cy), y = vy + 2 * (qz * cx - qx * cz), z = vz + 2 * (qx * cy - qy * cx);
  return (inertia.x * x * x + inertia.y * y * y + inertia.z * z * z) / 2;
}

/// Share of the rotation energy of a free box (half sides .5 .25 .1, 100 kg, spun about its middle axis) that is left
/// after 60 s.
double energy_left(const char* gyroscopic_mode) {
  auto world = scenes::make_world(PLUMB_NEED_ROTATION | PLUMB_NEED_GYROSCOPIC | PLUMB_NEED_COLLISION,
                                  {scenes::word_setting("gyroscopic_mode", gyroscopic_mode)});
  plumb::check(*world, world->set_gravity({0, 0, 0}));
  PlumbBodyDesc box = scenes::frictionless(PLUMB_DYNAMIC, scenes::add_box(*world, {0.5, 0.25, 0.1}), {0, 0, 0});
  box.mass_mode = PLUMB_MASS_FROM_TOTAL;
  box.mass = 100;
  box.angular_velocity = {0.5, 5, 0};
  const PlumbBody body = scenes::add_body(*world, box);
  const auto energy = [&] {
    return kinetic(scenes::read_row<6>(*world, PLUMB_FIELD_VELOCITY, body),
                   scenes::read_row<7>(*world, PLUMB_FIELD_POSE, body), {2.41666667, 8.66666667, 10.41666667});
  };
  const double before = energy();
  for (int i = 0; i < 3600; ++i) scenes::advance(*world);
  return energy() / before;
}

TEST(Facts, TheImplicitGyroscopicTermLosesMostOfTheEnergy) {
  const double left = energy_left("implicit_body");
  EXPECT_GT(left, 0.05);
  EXPECT_LT(left, 0.3);
}

TEST(Facts, GyroscopicModesDiffer) { EXPECT_NEAR(energy_left("none"), 1, 0.35); }

TEST(Facts, TheDirectSolverFallsBackOnStacksAndTheReportSaysSo) {
  scenes::PlumbScene tower(scenes::tower(10), scenes::kNeeds, {scenes::word_setting("solver", "mlcp_dantzig")});
  int fell_back = 0;
  for (int i = 0; i < 120; ++i)
    fell_back += (scenes::advance(*tower.world).remarks & PLUMB_REMARK_SOLVER_FELL_BACK) != 0;
  EXPECT_GT(fell_back, 0);
  scenes::PlumbScene usual(scenes::tower(10));
  EXPECT_EQ(scenes::advance(*usual.world).remarks, 0u);
}

TEST(Facts, TowersOfHullsAreAsTallAsTheirHulls) {
  auto world = scenes::make_world(scenes::kNeeds);
  PlumbShapeDesc hull = plumb::shape_desc(PLUMB_CONVEX_HULL);
  std::vector<double> corners;
  for (int i = 0; i < 8; ++i)
    for (int axis = 0; axis < 3; ++axis) corners.push_back((i >> axis & 1) != 0 ? 0.5 : -0.5);
  hull.vertices = corners.data();
  hull.vertex_count = 8;
  const PlumbShape shape = scenes::add_shape(*world, hull);
  PlumbBodyDesc floor = plumb::body_desc(PLUMB_STATIC);
  floor.shape = scenes::add_box(*world, {50, 5, 50});
  floor.pose.position = {0, -5, 0};
  scenes::add_body(*world, floor);
  PlumbBody top = 0;
  for (int i = 0; i < 5; ++i) {
    PlumbBodyDesc box = plumb::body_desc();
    box.shape = shape;
    box.pose.position = {0, 0.5 + i, 0};
    top = scenes::add_body(*world, box);
  }
  for (int i = 0; i < 120; ++i) scenes::advance(*world);
  EXPECT_NEAR(scenes::read_row<7>(*world, PLUMB_FIELD_POSE, top)[1], 4.5, 0.05);
}

TEST(Facts, SlowImpactsDoNotBounce) {
  for (const double threshold : {0.2, 0.0}) {
    auto world = scenes::make_world(PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_RESTITUTION,
                                    {scenes::number_setting("restitution_threshold", threshold)});
    plumb::check(*world, world->set_gravity({0, 0, 0}));
    PlumbBodyDesc floor = scenes::frictionless(PLUMB_STATIC, scenes::add_box(*world, {5, 5, 5}), {0, -5, 0});
    scenes::add_body(*world, floor);
    PlumbBodyDesc ball = scenes::frictionless(PLUMB_DYNAMIC, scenes::add_sphere(*world, 0.5), {0, 0.5, 0});
    ball.material.restitution = 1;
    ball.linear_velocity = {0, -0.15, 0};
    const PlumbBody body = scenes::add_body(*world, ball);
    for (int i = 0; i < 120; ++i) scenes::advance(*world);
    const double speed = scenes::read_row<6>(*world, PLUMB_FIELD_VELOCITY, body)[1];
    if (threshold > 0)
      EXPECT_LT(speed, 0.01);
    else
      EXPECT_NEAR(speed, 0.15, 0.01);
  }
}

TEST(Facts, MoreSubStepsLoseLessHeight) {
  const auto sink = [](double substeps) {
    scenes::PlumbScene tower(scenes::tower(10), scenes::kNeeds,
                             {scenes::number_setting("substeps", substeps, PLUMB_SETTING_INT)});
    for (int i = 0; i < 120; ++i) scenes::advance(*tower.world);
    return 9.5 - scenes::read_row<7>(*tower.world, PLUMB_FIELD_POSE, tower.bodies.back())[1];
  };
  EXPECT_LT(sink(8), sink(1));
}

/// What steals restitution in short steps is that contacts are met before they touch and are pushed out of.
TEST(Facts, BouncesAreExactWithoutForeseenContactsAndPush) {
  auto world =
      scenes::make_world(PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_RESTITUTION,
                         {scenes::number_setting("substeps", 8, PLUMB_SETTING_INT), scenes::number_setting("erp2", 0),
                          scenes::number_setting("contact_breaking_threshold", 0)});
  scenes::add_body(*world, scenes::frictionless(PLUMB_STATIC, scenes::add_box(*world, {5, 5, 5}), {0, -5, 0}));
  PlumbBodyDesc ball = scenes::frictionless(PLUMB_DYNAMIC, scenes::add_sphere(*world, 0.5), {0, 5.5, 0});
  ball.material.restitution = 1;
  const PlumbBody body = scenes::add_body(*world, ball);
  double apex = 0;
  for (int i = 0; i < 120; ++i) {
    scenes::advance(*world);
    if (i >= 70) apex = std::max(apex, scenes::read_row<7>(*world, PLUMB_FIELD_POSE, body)[1]);
  }
  EXPECT_NEAR(apex, 5.5, 0.02);
}

}  // namespace
