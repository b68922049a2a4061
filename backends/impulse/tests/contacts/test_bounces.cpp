// Impacts against closed forms: how high a ball comes back, how it leaves a rough ground, that what falls flat does not
// turn, and what many bodies do that strike each other at once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "math/angle.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kBounceNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_RESTITUTION;

struct Speed {
  PlumbVec3 linear, angular;
};
Speed speed(Scene& scene, PlumbBody body) {
  const std::vector<double> v = scene.velocity(body);
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}

/// With e = 1 a ball comes back to where it fell from, wherever in a sub-step it touches.
TEST(Bounces, ABallComesBackToItsHeight) {
  for (const double fall : {4.9, 5.0, 5.05, 5.1}) {
    Scene scene(engine(), kBounceNeeds, {0, -9.81, 0}, 1);
    scene.body.material.friction = 0;
    scene.body.material.restitution = 1;
    scene.ground();
    const PlumbBody ball = scene.add(scene.sphere(0.5), {0, fall + 0.5, 0});
    double highest = 0;
    for (int step = 0, bounces = 0; bounces < 5 && step < 1000; ++step) {
      const double before = speed(scene, ball).linear.y;
      scene.run(1);
      const double after = speed(scene, ball).linear.y;
      if (after > before + 1) {
        ++bounces;
        // Velocities are half a sub-step behind positions.
        const double v = after - 9.81 / 960;
        highest = scene.poses().back().position.y - 0.5 + v * v / (2 * 9.81);
        EXPECT_NEAR(highest / fall, 1, 1e-4) << "bounce " << bounces << " after a fall of " << fall;
      }
    }
    EXPECT_GT(highest, 0);
  }
}

/// What bounces looks ahead by its own size, not by that of the ground: nothing is touched from afar.
TEST(Bounces, ALargeGroundIsNotTouchedFromAfar) {
  Scene scene(engine(), kBounceNeeds | PLUMB_NEED_CONTACTS, {0, 0, 0}, 1);
  scene.body.material.restitution = 0.6;
  scene.add_static(scene.box({500, 1, 500}), {0, -1, 0});
  for (int i = 0; i < 10; ++i) scene.add(scene.box({0.5, 0.5, 0.5}), {2.0 * i, 0.55 + 0.05 * i, 0});
  scene.run(1);
  EXPECT_EQ(scene.world().contacts().size(), 0U);
}

/// A ball that strikes at 45 degrees slips where mu (1 + e) < 2 / 7 of the normal speed, and rolls off where not.
TEST(Bounces, ABallThatIsThrownBackRubsAsMuchMore) {
  for (const double mu : {0.1, 0.5}) {
    Scene scene(engine(), kBounceNeeds, {0, 0, 0}, 1);
    scene.body.material.friction = mu;
    scene.body.material.restitution = 0.5;
    scene.ground();
    scene.body.linear_velocity = {5, -5, 0};
    const PlumbBody ball = scene.add(scene.sphere(0.5), {0, 0.5 + 5.0 / 60 * 3.5, 0});
    scene.run(10);
    const Speed after = speed(scene, ball);
    const double lost = std::min(2.0 / 7 * 5, mu * 1.5 * 5);
    EXPECT_NEAR(after.linear.y, 2.5, 1e-5) << mu;
    EXPECT_NEAR(after.linear.x, 5 - lost, 1e-5) << mu;
    EXPECT_NEAR(after.angular.z, -2.5 * lost / 0.5, 1e-4) << mu;
  }
}

TEST(Bounces, ABoxThatFallsFlatDoesNotTurn) {
  Scene scene(engine(), kBounceNeeds, {0, -9.81, 0}, 1);
  scene.body.material.restitution = 1;
  scene.ground();
  const PlumbBody box = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 10.5, 0});
  int rising = 0;
  for (int step = 0; step < 600; ++step) {
    scene.run(1);
    const Speed v = speed(scene, box);
    rising += v.linear.y > 10 ? 1 : 0;
    ASSERT_NEAR(std::hypot(v.angular.x, v.angular.y, v.angular.z), 0, 1e-4) << "step " << step;
    ASSERT_LT(scene.poses().back().position.y, 10.5 * 1.001);
  }
  EXPECT_GT(rising, 20) << "it does bounce";
}

/// Balls in a row, in free space, the first with 5 m/s: the speeds of all in the end.
std::vector<double> cradle(double gap, const std::vector<double>& masses, double restitution) {
  Scene scene(engine(), kBounceNeeds, {0, 0, 0}, 1);
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.material.friction = 0;
  scene.body.material.restitution = restitution;
  const PlumbShape ball = scene.sphere(0.1);
  std::vector<PlumbBody> balls;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    scene.body.mass = masses[i];
    scene.body.linear_velocity = {i == 0 ? 5.0 : 0.0, 0, 0};
    balls.push_back(scene.add(ball, {static_cast<double>(i) * (0.2 + gap) - (i == 0 ? 0.53 : 0.0), 0, 0}));
  }
  scene.run(60);
  std::vector<double> speeds;
  for (const PlumbBody each : balls) speeds.push_back(speed(scene, each).linear.x);
  return speeds;
}

/// However many are struck in a step or a sub-step, of balls that are alike the last leaves alone.
TEST(Impacts, PassABlowOnAlongARow) {
  for (const double gap : {0.0, 1e-4, 0.001, 0.01, 0.05}) {
    const std::vector<double> speeds = cradle(gap, {1, 1, 1, 1, 1, 1, 1}, 1);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(speeds[i], i == 6 ? 5 : 0, 1e-5) << i << " with gaps of " << gap;
  }
}

/// Each pair by itself: v and the share 2 m / (m + M) of it, again and again.
TEST(Impacts, PassSpeedOnByMasses) {
  const std::vector<double> masses = {8, 4, 2, 1}, speeds = cradle(0.01, masses, 1);
  EXPECT_NEAR(speeds[3], 5 * 4.0 / 3 * 4.0 / 3 * 4.0 / 3, 1e-4);
  double momentum = 0, energy = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    momentum += masses[i] * speeds[i];
    energy += masses[i] * speeds[i] * speeds[i] / 2;
  }
  EXPECT_NEAR(momentum, 40, 1e-4);
  EXPECT_NEAR(energy, 100, 1e-3);
  EXPECT_NEAR(cradle(0.01, {1, 1}, 0.5)[1], 3.75, 1e-5);
}

/// Of a box of 1 kg, or of a ball where it does not turn, J.
double energy_of(Scene& scene, PlumbBody body, const PlumbQuat& orientation, const PlumbVec3& half_extents) {
  const Speed v = speed(scene, body);
  const Quat q = {static_cast<Real>(orientation.x), static_cast<Real>(orientation.y), static_cast<Real>(orientation.z),
                  static_cast<Real>(orientation.w)};
  const Vec turn =
      rotate_back(q, {static_cast<Real>(v.angular.x), static_cast<Real>(v.angular.y), static_cast<Real>(v.angular.z)});
  const double x = half_extents.x * half_extents.x, y = half_extents.y * half_extents.y,
               z = half_extents.z * half_extents.z;
  const double moves = v.linear.x * v.linear.x + v.linear.y * v.linear.y + v.linear.z * v.linear.z;
  return (moves + ((y + z) * turn.x * turn.x + (z + x) * turn.y * turn.y + (x + y) * turn.z * turn.z) / 3) / 2;
}

/// A room full of what flies about and bounces: how its energy has grown after 20 s, as a share.
double energy_made_by_gas(const PlumbVec3& half_extents, double friction, const char* solver = "tgs_soft") {
  Scene scene(engine(), kBounceNeeds | PLUMB_NEED_GYROSCOPIC, {0, 0, 0}, 1, {"solver", solver});
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = 1;
  scene.body.material.friction = friction;
  scene.body.material.restitution = 1;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-4.0, 4.0}) {
      const PlumbVec3 wall = {axis == 0 ? 1.0 : 5.0, axis == 1 ? 1.0 : 5.0, axis == 2 ? 1.0 : 5.0};
      scene.add_static(scene.box(wall), {axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0});
    }
  const bool round = half_extents.y == 0;
  const PlumbShape shape = round ? scene.sphere(half_extents.x) : scene.box(half_extents);
  std::vector<PlumbBody> bodies;
  for (int i = 0; i < 64; ++i) {
    const double k = i;
    scene.body.linear_velocity = {5 * std::sin(7 * k), 5 * std::sin(11 * k), 5 * std::sin(13 * k)};
    if (!round) scene.body.angular_velocity = {3 * std::sin(17 * k), 3 * std::sin(19 * k), 3 * std::sin(23 * k)};
    const PlumbVec3 place = {1.3 * (i % 4) - 1.95, 1.3 * (i / 4 % 4) - 1.95, 1.3 * (i / 16) - 1.95};
    bodies.push_back(scene.add(shape, place));
  }
  const auto energy = [&] {
    const auto poses = scene.poses();
    double sum = 0;
    for (std::size_t i = 0; i < bodies.size(); ++i)
      sum += energy_of(scene, bodies[i], poses[poses.size() - bodies.size() + i].orientation, half_extents);
    return sum;
  };
  const double before = energy();
  scene.run(1200);
  return energy() / before - 1;
}

TEST(Impacts, OfAGasOfBallsKeepItsEnergy) {
  for (const char* solver : {"tgs_soft", "si", "xpbd"})
    EXPECT_NEAR(energy_made_by_gas({0.25, 0, 0}, 0, solver), 0, 1e-4) << solver;
}
TEST(Impacts, OfAGasOfRodsKeepItsEnergy) { EXPECT_NEAR(energy_made_by_gas({0.5, 0.05, 0.05}, 0), 0, 0.01); }
TEST(Impacts, ThatRubTakeEnergyOff) {
  const double made = energy_made_by_gas({0.25, 0.15, 0.2}, 0.5);
  EXPECT_LT(made, -0.5);
  EXPECT_GT(made, -1);
}

/// The normal is that of the touch, wherever in a step that comes: e = 1, alike, by half of a diameter off centre.
TEST(Impacts, OfBallsThatGlanceGoAlongTheLineOfTheirCentres) {
  for (const double start : {-0.5, -0.51, -0.52, -0.53, -0.54, -0.55, -0.56, -0.57}) {
    Scene scene(engine(), kBounceNeeds, {0, 0, 0}, 1);
    scene.body.material.friction = 0;
    scene.body.material.restitution = 1;
    const PlumbShape ball = scene.sphere(0.1);
    const PlumbBody target = scene.add(ball, {0, 0, 0});
    scene.body.linear_velocity = {5, 0, 0};
    scene.add(ball, {start, 0.1, 0});
    scene.run(30);
    const PlumbVec3 v = speed(scene, target).linear;  // 5 cos 30, 30 degrees downward
    EXPECT_NEAR(v.x, 3.75, 2e-3) << start;
    EXPECT_NEAR(v.y, -3.75 / std::sqrt(3.0), 2e-3) << start;
  }
}
TEST(Impacts, OfABallOnAnEdgeMirrorItAtTheLineFromTheEdge) {
  for (const double start : {0.8, 0.82, 0.84, 0.86, 0.88}) {
    Scene scene(engine(), kBounceNeeds, {0, 0, 0}, 1);
    scene.body.material.friction = 0;
    scene.body.material.restitution = 1;
    scene.add_static(scene.box({1, 1, 5}), {-1, -1, 0});
    scene.body.linear_velocity = {0, -5, 0};
    const PlumbBody ball = scene.add(scene.sphere(0.5), {0.3, start, 0});
    scene.run(30);
    const PlumbVec3 v = speed(scene, ball).linear;  // of the normal (3, 4) / 5
    EXPECT_NEAR(v.x, 5 * 2 * 0.6 * 0.8, 2e-3) << start;
    EXPECT_NEAR(v.y, 5 * (2 * 0.8 * 0.8 - 1), 2e-3) << start;
  }
}

/// Five bobs on rods that just don't touch: the last rises as high as the first was, and so on for half a minute.
TEST(Impacts, OfACradleOnRodsKeepItsEnergy) {
  Scene scene(engine(), kBounceNeeds | PLUMB_NEED_JOINTS, {0, -9.81, 0}, 1);
  scene.body.mass_mode = PLUMB_MASS_FROM_TOTAL;
  scene.body.mass = 1;
  scene.body.material.friction = 0;
  scene.body.material.restitution = 1;
  const PlumbShape ball = scene.sphere(0.1);
  std::vector<PlumbBody> bobs;
  for (int i = 0; i < 5; ++i) {
    const double hook = 0.201 * i;
    const PlumbVec3 place = i == 0 ? PlumbVec3{-0.5, 1 - std::sqrt(0.75), 0} : PlumbVec3{hook, 0, 0};
    bobs.push_back(scene.add(ball, place));
    scene.rod({hook, 1, 0}, bobs.back(), 1);
  }
  const auto drop = 1 - std::sqrt(0.75);
  double highest_of_last = 0;
  for (int step = 0; step < 1800; ++step) {
    scene.run(1);
    const auto poses = scene.poses();
    double energy = 0;
    for (int i = 0; i < 5; ++i) {
      const Speed v = speed(scene, bobs[static_cast<std::size_t>(i)]);
      energy += (v.linear.x * v.linear.x + v.linear.y * v.linear.y) / 2 +
                9.81 * poses[poses.size() - 5 + static_cast<std::size_t>(i)].position.y;
    }
    ASSERT_NEAR(energy / (9.81 * drop), 1, 0.02) << "step " << step;
    if (step < 84) highest_of_last = std::max(highest_of_last, poses.back().position.y);
  }
  EXPECT_NEAR(highest_of_last / drop, 1, 0.01);
}

}  // namespace
}  // namespace plumb::impulse::test
