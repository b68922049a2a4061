// Stacks that stand as they were built: nothing in a step may lean them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kStackNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION;

/// The largest way sideways of a cube of a tower, after so many steps, m.
double drift_of_tower(int cubes, int steps) {
  Scene scene(engine(), kStackNeeds, {0, -9.81, 0}, 1);
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  for (int i = 0; i < cubes; ++i) scene.add(cube, {0, i + 0.5, 0});
  scene.run(steps);
  double drift = 0;
  for (const PlumbPose& pose : scene.poses()) drift = std::max(drift, std::hypot(pose.position.x, pose.position.z));
  return drift;
}

/// Rounding is no slope: every point of a level face is as deep as the others, to the last digit but one.
TEST(Stacks, OfBoxesAreNotLeantByRounding) { EXPECT_LT(drift_of_tower(20, 300), 1e-5); }

/// A motion of all of its cubes at once swings up where contacts are stiffer than one sweep a sub-step bears.
TEST(Stacks, OfManyRowsComeToRest) {
  Scene scene(engine(), kStackNeeds, {0, -9.81, 0}, 1);
  scene.ground();
  const PlumbShape cube = scene.box({0.5, 0.5, 0.5});
  constexpr int base = 10;
  std::vector<PlumbBody> cubes;
  for (int row = 0; row < base; ++row)
    for (int i = 0; i < base - row; ++i)
      cubes.push_back(scene.add(cube, {1.02 * (i - (base - row - 1) / 2.0), row + 0.5, 0}));
  scene.run(2400);
  double fastest = 0;
  for (const PlumbBody body : cubes) {
    const std::vector<double> v = scene.velocity(body);
    fastest = std::max(fastest, std::hypot(v[0], v[1], v[2]));
  }
  EXPECT_LT(fastest, 1e-4);
}

}  // namespace
}  // namespace plumb::impulse::test
