#include "scenes.hpp"

#include <cmath>
#include <random>

namespace plumb::ode_test {
namespace {

constexpr double density = 1000;

BoxBody box(const PlumbVec3& half, const PlumbPose& pose) {
  const double x = 2 * half.x, y = 2 * half.y, z = 2 * half.z, mass = density * x * y * z;
  return {half, pose, mass, {mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y)}};
}

BoxBody still(const PlumbVec3& half, const PlumbVec3& at) { return {half, {at, {0, 0, 0, 1}}, 0, {}}; }

BoxBody ground() { return still({100, 1, 100}, {0, -1, 0}); }

}  // namespace

Scene tower(int height) {
  Scene scene{"tower", {ground()}, {}};
  for (int i = 0; i < height; ++i) scene.bodies.push_back(box({.5, .5, .5}, {{0, .5 + i, 0}, {0, 0, 0, 1}}));
  return scene;
}

Scene pyramid(int base) {
  Scene scene{"pyramid", {ground()}, {}};
  for (int row = 0; row < base; ++row)
    for (int i = 0; i < base - row; ++i)
      scene.bodies.push_back(box({.5, .5, .5}, {{(i - (base - row - 1) / 2.0) * 1.02, .5 + row, 0}, {0, 0, 0, 1}}));
  return scene;
}

Scene pile(int count) {
  const int side = static_cast<int>(std::lround(std::cbrt(count / 2.0)));
  const double inner = 1.3 * side + 2;
  Scene scene{"pile", {ground()}, {}};
  for (const double sign : {-1.0, 1.0}) {
    scene.bodies.push_back(still({.5, 10, inner}, {sign * (inner / 2 + .5), 10, 0}));
    scene.bodies.push_back(still({inner, 10, .5}, {0, 10, sign * (inner / 2 + .5)}));
  }
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  for (int i = 0; i < count; ++i) {
    const int layer = i / (side * side), row = i / side % side, column = i % side;
    PlumbQuat q{normal(random), normal(random), normal(random), normal(random)};
    const double n = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    q = {n * q.x, n * q.y, n * q.z, n * q.w};
    const PlumbVec3 at{1.3 * (column - (side - 1) / 2.0), 1 + 1.5 * layer, 1.3 * (row - (side - 1) / 2.0)};
    scene.bodies.push_back(box({.5, .5, .5}, {at, q}));
  }
  return scene;
}

Scene chain(int links) {
  Scene scene{"chain", {}, {}};
  for (int i = 0; i < links; ++i) {
    scene.bodies.push_back(box({.5, .125, .125}, {{.5 + i, 0, 0}, {0, 0, 0, 1}}));
    scene.links.push_back({PLUMB_JOINT_BALL, i - 1, i, {static_cast<double>(i), 0, 0}});
  }
  return scene;
}

Scene pendulum() {
  Scene scene{"pendulum", {box({.125, .125, .5}, {{0, 0, .5}, {0, 0, 0, 1}})}, {}};
  scene.links.push_back({PLUMB_JOINT_HINGE, -1, 0, {0, 0, 0}});
  return scene;
}

}  // namespace plumb::ode_test
