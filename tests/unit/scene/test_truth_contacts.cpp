// Truths of impacts and friction against digits that were worked out by other means.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "../truth_units.hpp"
#include "truth/contacts.hpp"

namespace plumb::truth {
namespace {

TEST(Impact, LadderOfBounces) {
  const double half[] = {1.75, .8125, .578125, .51953125, .50488281};
  const double most[] = {3.3125, 2.08203125, 1.38989258, 1.00056458, .78156757};
  for (int n = 1; n <= 5; ++n) {
    EXPECT_NEAR(.5 + bounce_apex(5, .5, n), half[n - 1], digits);
    EXPECT_NEAR(.5 + bounce_apex(5, .75, n), most[n - 1], digits);
  }
  EXPECT_NEAR(bounce_impact(g, 5, .5, 1), 1.00963755, digits);
  EXPECT_NEAR(bounce_impact(g, 5, .5, 60), 3.02891266, digits);
  EXPECT_NEAR(bounce_impact(g, 5, .75, 100), 7.06746288, digits);
}

TEST(Impact, HeadOnPairs) {
  EXPECT_NEAR(head_on(1, 2, 3, 0, 1).a, -1, digits);
  EXPECT_NEAR(head_on(1, 2, 3, 0, 1).b, 1, digits);
  EXPECT_NEAR(head_on(1, 2, 3, 0, .5).a, -.25, digits);
  EXPECT_NEAR(head_on(1, 2, 3, 0, .5).b, .75, digits);
  EXPECT_NEAR(head_on(100, 20, 1, 0, 0).a, 19.80198020, digits);
  EXPECT_NEAR(head_on(1, 20, 100, 0, 0).b, .19801980, digits);
  EXPECT_NEAR(head_on(1e4, 1, 1, 0, 1).a, .99980002, digits);
  EXPECT_NEAR(head_on(1e4, 1, 1, 0, 1).b, 1.99980002, digits);
}

TEST(Impact, RowOfSpheresAtOnceAndOneAfterTheOther) {
  const std::vector<double> once = simultaneous_row(5, 1), turns = sequential_row(5);
  EXPECT_EQ(turns, (std::vector<double>{0, 0, 0, 0, 1}));
  double energy = 0, momentum = 0;
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(once[i], i == 0 ? -.6 : .4, digits);
    energy += once[i] * once[i];
    momentum += once[i];
  }
  EXPECT_NEAR(energy, 1, 1e-15);
  EXPECT_NEAR(momentum, 1, 1e-15);
  // The same from the impulses p of the contacts: the change of their relative speeds is A p, A = 2 on the diagonal
  // and -1 beside it; and by a chain of single impacts.
  for (const double e : {1.0, .5}) {
    Eigen::Matrix4d a = 2 * Eigen::Matrix4d::Identity();
    for (int i = 0; i < 3; ++i) a(i, i + 1) = a(i + 1, i) = -1;
    const Eigen::Vector4d p = a.inverse() * Eigen::Vector4d(1 + e, 0, 0, 0);
    const std::vector<double> row = simultaneous_row(5, e);
    EXPECT_NEAR(row[0], 1 - p[0], 1e-14);
    EXPECT_NEAR(row[2], p[1] - p[2], 1e-14);
    EXPECT_NEAR(row[4], p[3], 1e-14);
  }
  std::vector<double> chain{1, 0, 0, 0, 0};
  for (std::size_t i = 0; i + 1 < 5; ++i) {
    const HeadOn after = head_on(1, chain[i], 1, chain[i + 1], 1);
    chain[i] = after.a, chain[i + 1] = after.b;
  }
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(chain[i], turns[i], 1e-15);
}

TEST(Impact, GlancingPair) {
  const GlancingImpact after = glancing_impact(30 * degree, 1);
  EXPECT_NEAR((after.runner - Eigen::Vector3d(.25, -.43301270, 0)).norm(), 0, digits);
  EXPECT_NEAR((after.target - Eigen::Vector3d(.75, .43301270, 0)).norm(), 0, digits);
  EXPECT_NEAR(after.runner.squaredNorm() + after.target.squaredNorm(), 1, 1e-15);
  EXPECT_NEAR(after.runner.dot(after.target), 0, 1e-15);  // equal masses part at right angles
  EXPECT_NEAR(glancing_impact(0, .5).target.x(), head_on(1, 1, 1, 0, .5).b, 1e-15);
}

TEST(Impact, ObliqueSphere) {
  const ObliqueImpact slips = oblique_impact(.1, 5, 5, .1, .5);
  EXPECT_NEAR(slips.tangential, 4.25, digits);
  EXPECT_NEAR(slips.normal, 2.5, digits);
  EXPECT_NEAR(slips.spin, 18.75, digits);
  const ObliqueImpact grips = oblique_impact(.1, 5, 5, .5, .5);
  EXPECT_NEAR(grips.tangential, 3.57142857, digits);
  EXPECT_NEAR(grips.spin, 35.71428571, digits);
  const double change = 2.0 / 7 / 1.5;
  EXPECT_NEAR(change, .19047619, digits);
  EXPECT_NEAR(oblique_impact(.1, 5, 5, change, .5).tangential, grips.tangential, 1e-12);
}

TEST(Impact, CubeOnEdgeAndVertex) {
  const double edge = std::sqrt(.5) * std::sin(15 * degree);
  EXPECT_NEAR(edge, .18301270, digits);
  EXPECT_NEAR(lever_impact(1, 1.0 / 6, edge, 5, 0).velocity, -.83667057, digits);
  EXPECT_NEAR(lever_impact(1, 1.0 / 6, edge, 5, 0).spin, 4.57165301, digits);
  EXPECT_NEAR(lever_impact(1, 1.0 / 6, edge, 5, .5).velocity, 1.24499415, digits);
  EXPECT_NEAR(lever_impact(1, 1.0 / 6, edge, 5, .5).spin, 6.85747951, digits);
  const Eigen::AngleAxisd tilt(40 * degree, Eigen::Vector3d(1, 0, 1).normalized());
  Eigen::Vector3d lowest = Eigen::Vector3d::Zero();
  for (int corner = 0; corner < 8; ++corner) {
    const Eigen::Vector3d at =
        tilt * Eigen::Vector3d(corner & 1 ? .5 : -.5, corner & 2 ? .5 : -.5, corner & 4 ? .5 : -.5);
    if (at.y() < lowest.y()) lowest = at;
  }
  const double vertex = std::hypot(lowest.x(), lowest.z());
  EXPECT_NEAR(vertex, .22028142, digits);
  EXPECT_NEAR(lever_impact(1, 1.0 / 6, vertex, 5, 0).velocity, -1.12746349, digits);
  EXPECT_NEAR(lever_impact(1, 1.0 / 6, vertex, 5, 0).spin / std::sqrt(2.0), 3.61917540, digits);
  EXPECT_NEAR(lever_impact(1, 1.0 / 6, vertex, 5, .5).velocity, .80880476, digits);
}

TEST(Impact, CubeOnAStickingEdge) {
  const StickingImpact stuck = sticking_impact(1, 1.0 / 6, .18301270, std::sqrt(.5) * std::cos(15 * degree), 5);
  EXPECT_NEAR(stuck.spin, 1.37259526, 3e-8);
  EXPECT_NEAR(stuck.sideways, .9375, 3e-8);
  EXPECT_NEAR(stuck.vertical, -.25120237, 3e-8);
}

TEST(Impact, SphereOnEdgeAndCorner) {
  const Eigen::Vector3d edge = reflect({0, -5, 0}, {std::sin(30 * degree), std::cos(30 * degree), 0}, 1);
  EXPECT_NEAR(edge.x(), 4.33012702, digits);
  EXPECT_NEAR(edge.y(), 2.5, digits);
  const Eigen::Vector3d corner = reflect({0, -5, 0}, {.4, std::sqrt(1 - .32), .4}, 1);
  EXPECT_NEAR(corner.x(), 3.29848450, digits);
  EXPECT_NEAR(corner.y(), 1.8, digits);
  EXPECT_NEAR(corner.z(), 3.29848450, digits);
}

TEST(Friction, Inclines) {
  EXPECT_EQ(incline_slide(g, 26 * degree, .5, 2), 0);
  EXPECT_NEAR(incline_slide(g, 26.6 * degree, .5, 2), .01338024, digits);
  EXPECT_NEAR(incline_slide(g, 27 * degree, .5, 2), .16651960, digits);
  EXPECT_NEAR(incline_slide(g, 30 * degree, .5, 2), 1.31429079, digits);
  EXPECT_NEAR(incline_slide(g, 45 * degree, .5, 2), 6.93671752, digits);
}

TEST(Friction, SlideToRoll) {
  const SlideToRoll sphere = slide_to_roll(g, .3, .4, 3);
  EXPECT_NEAR(sphere.speed, 2.14285714, digits);
  EXPECT_NEAR(sphere.time, .29124800, digits);
  EXPECT_NEAR(sphere.distance, .74892342, digits);
  const SlideToRoll cylinder = slide_to_roll(g, .3, .5, 3);
  EXPECT_NEAR(cylinder.speed, 2, digits);
  EXPECT_NEAR(cylinder.time, .33978933, digits);
  EXPECT_NEAR(cylinder.distance, .84947333, digits);
  EXPECT_NEAR(slide_to_roll(g, .3, 2.0 / 3, 3).speed, 1.8, digits);
  EXPECT_NEAR(slide_to_roll(g, .3, 2.0 / 3, 3).time, .40774720, digits);
  EXPECT_NEAR(slide_to_roll(g, .3, .4, 3, -4.5).speed, .85714286, digits);
}

TEST(Friction, RollDown) {
  EXPECT_NEAR(roll_down(g, 20 * degree, .5, .4).acceleration, 2.39658400, digits);
  EXPECT_NEAR(roll_down(g, 20 * degree, .5, .5).acceleration, 2.23681174, digits);
  EXPECT_NEAR(roll_down(g, 20 * degree, .05, .4).acceleration, 2.89429838, digits);
  EXPECT_NEAR(roll_down(g, 20 * degree, .05, .4).turning, 1.15229808, digits);
  // The least friction that keeps a sphere rolling is 2/7 tan.
  EXPECT_NEAR(roll_down(g, 20 * degree, .10399151, .4).acceleration, 2.39658400, digits);
  EXPECT_GT(roll_down(g, 20 * degree, .10399149, .4).acceleration, 2.39658400);
}

TEST(Friction, SpinningCube) {
  EXPECT_NEAR(corner_lever(1), .70710678, digits);
  EXPECT_NEAR(uniform_lever(1), .38259786, digits);
  EXPECT_NEAR(spin_stop(g, .5, 1, corner_lever(1), 10).time, .48053468, digits);
  EXPECT_NEAR(spin_stop(g, .5, 1, corner_lever(1), 10).angle, 2.40267340, digits);
  EXPECT_NEAR(spin_stop(g, .5, 1, uniform_lever(1), 10).time, .88811091, digits);
  EXPECT_NEAR(spin_stop(g, .5, 1, uniform_lever(1), 10).angle, 4.44055453, digits);
}

TEST(Friction, BeltThatPicksUpABlock) {
  const BeltSlip slip = belt_slip(g, .3, 2);
  EXPECT_NEAR(slip.time, .67957866, digits);
  EXPECT_NEAR(slip.slip, .67957866, digits);
  // The same by small steps, at another speed.
  double v = 0, t = 0, under = 0;
  for (constexpr double dt = 1e-6; v < 5; t += dt) {
    v += .3 * g * dt;
    under += (5 - v) * dt;
  }
  EXPECT_NEAR(belt_slip(g, .3, 5).time, t, 2e-6);
  EXPECT_NEAR(belt_slip(g, .3, 5).slip, under, 1e-5);
}

TEST(Friction, PushedBoxWithBalls) {
  const LoadedBox moves = pushed_box(g, 10, 25, .4, 150);
  EXPECT_NEAR(moves.box, .7385, 5e-5);
  EXPECT_NEAR(moves.ball, .211, 5e-5);
  EXPECT_EQ(pushed_box(g, 10, 25, .4, 137).box, 0);
}

}  // namespace
}  // namespace plumb::truth
