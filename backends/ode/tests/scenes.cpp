#include "scenes.hpp"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace plumb::ode_test {
namespace {

constexpr double density = 1000;

BoxBody box(const PlumbVec3& half, const PlumbPose& pose) {
  const double x = 2 * half.x, y = 2 * half.y, z = 2 * half.z, mass = density * x * y * z;
  return {half, pose, mass, {mass / 12 * (y * y + z * z), mass / 12 * (x * x + z * z), mass / 12 * (x * x + y * y)}};
}

BoxBody still(const PlumbVec3& half, const PlumbVec3& at) { return {half, {at, {0, 0, 0, 1}}, 0, {}}; }

BoxBody ground() { return still({100, 1, 100}, {0, -1, 0}); }

/// splitmix64 (Steele, Lea, Flood 2014), mapped to 0..1.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  double next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

 private:
  std::uint64_t state_;
};

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
  const int side = static_cast<int>(std::nearbyint(std::cbrt(count / 2.0)));
  const double half = (1.3 * side + 2) / 2, height = 1.5 * ((count + side * side - 1) / (side * side)) + 20;
  Scene scene{"pile", {ground()}, {}};
  for (const double sign : {-1.0, 1.0}) {
    scene.bodies.push_back(still({.5, height / 2, half + 1}, {sign * (half + .5), height / 2, 0}));
    scene.bodies.push_back(still({half + 1, height / 2, .5}, {0, height / 2, sign * (half + .5)}));
  }
  for (int i = 0; i < count; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    double u[6];
    for (double& value : u) value = random.next();
    const double middle = (side - 1) / 2.0;
    const PlumbVec3 at{1.3 * (i % side - middle) + .2 * u[0] - .1, 1 + 1.5 * (i / (side * side)) + .2 * u[1] - .1,
                       1.3 * (i / side % side - middle) + .2 * u[2] - .1};
    // Shoemake, "Uniform random rotations", Graphics Gems III (1992).
    const double a = std::sqrt(1 - u[3]), b = std::sqrt(u[3]), turn = 2 * std::numbers::pi;
    const PlumbQuat q{a * std::sin(turn * u[4]), a * std::cos(turn * u[4]), b * std::sin(turn * u[5]),
                      b * std::cos(turn * u[5])};
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
