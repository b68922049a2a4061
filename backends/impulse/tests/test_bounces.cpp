// Impacts against closed forms: how high a ball comes back, how it leaves a rough ground, and that what falls flat does
// not turn.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_RESTITUTION;

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
    Scene scene(engine(), kNeeds, {0, -9.81, 0}, 1);
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

/// A ball that strikes at 45 degrees slips where mu (1 + e) < 2 / 7 of the normal speed, and rolls off where not.
TEST(Bounces, ABallThatIsThrownBackRubsAsMuchMore) {
  for (const double mu : {0.1, 0.5}) {
    Scene scene(engine(), kNeeds, {0, 0, 0}, 1);
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
  Scene scene(engine(), kNeeds, {0, -9.81, 0}, 1);
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

}  // namespace
}  // namespace plumb::impulse::test
