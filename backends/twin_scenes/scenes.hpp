// Scenes as lists of boxes, spheres and joints, from which the tests of an engine make a world of Plumb and a program
// that is written straight against the engine.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <ostream>
#include <string>
#include <vector>

#include "plumb/physics_world.hpp"

namespace scenes {

struct Item {
  bool is_static = false;
  bool is_sphere = false;
  PlumbVec3 half{};  ///< of a box; x is the radius of a sphere
  PlumbPose pose{};
  double mass = 1;
  PlumbVec3 velocity{}, spin{};
};

inline bool same_shape(const Item& a, const Item& b) {
  return a.is_sphere == b.is_sphere && a.half.x == b.half.x && a.half.y == b.half.y && a.half.z == b.half.z;
}

struct Joint {
  bool is_hinge = false;  ///< about z, else a ball
  int a = -1;             ///< -1: the world
  int b = 0;
  PlumbVec3 in_a{}, in_b{};
};

struct Scene {
  std::string name;
  std::vector<Item> items;
  std::vector<Joint> joints;
};

/// For the name of a test.
inline void PrintTo(const Scene& scene, std::ostream* out) { *out << scene.name; }

/// Of every body, and so of every pair. Its root is exact, for engines that multiply.
inline constexpr double kPlumbFriction = 0.25;

inline PlumbVec3 box_inertia(const Item& item) {
  const PlumbVec3 h = item.half;
  return {item.mass / 3 * (h.y * h.y + h.z * h.z), item.mass / 3 * (h.x * h.x + h.z * h.z),
          item.mass / 3 * (h.x * h.x + h.y * h.y)};
}
inline PlumbVec3 inertia(const Item& item) {
  const double sphere = 0.4 * item.mass * item.half.x * item.half.x;
  return item.is_sphere ? PlumbVec3{sphere, sphere, sphere} : box_inertia(item);
}

inline Item box(PlumbVec3 at, PlumbVec3 half, double mass = 1000) {
  Item item;
  item.half = half;
  item.pose = {at, {0, 0, 0, 1}};
  item.mass = mass;
  return item;
}

inline Item wall(PlumbVec3 at, PlumbVec3 half) {
  Item item = box(at, half);
  item.is_static = true;
  return item;
}

inline Item ground() { return wall({0, -5, 0}, {200, 5, 200}); }

inline Scene tower(int height) {
  Scene scene{"tower", {ground()}, {}};
  for (int i = 0; i < height; ++i) scene.items.push_back(box({0, 0.5 + i, 0}, {0.5, 0.5, 0.5}));
  return scene;
}

inline Scene pyramid(int base) {
  Scene scene{"pyramid", {ground()}, {}};
  for (int row = 0; row < base; ++row)
    for (int i = 0; i < base - row; ++i)
      scene.items.push_back(box({(i - (base - row - 1) / 2.0) * 1.02, 0.5 + row, 0}, {0.5, 0.5, 0.5}));
  return scene;
}

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

/// Cubes of random orientation that fall into an open container, first overlapping a little: scenes/throughput's pile.
inline Scene pile(int count) {
  const int k = static_cast<int>(std::nearbyint(std::cbrt(count / 2.0)));
  const double half = (1.3 * k + 2) / 2, height = 1.5 * ((count + k * k - 1) / (k * k)) + 20;
  Scene scene{"pile", {ground()}, {}};
  for (const double side : {-1.0, 1.0}) {
    scene.items.push_back(wall({side * (half + 0.5), height / 2, 0}, {0.5, height / 2, half + 1}));
    scene.items.push_back(wall({0, height / 2, side * (half + 0.5)}, {half + 1, height / 2, 0.5}));
  }
  for (int i = 0; i < count; ++i) {
    Random random(static_cast<std::uint64_t>(i));
    double u[6];
    for (double& value : u) value = random.next();
    const double x = 1.3 * (i % k - (k - 1) / 2.0), y = 1 + 1.5 * (i / (k * k)), z = 1.3 * (i / k % k - (k - 1) / 2.0);
    Item item = box({x + 0.2 * u[0] - 0.1, y + 0.2 * u[1] - 0.1, z + 0.2 * u[2] - 0.1}, {0.5, 0.5, 0.5});
    // Shoemake, "Uniform random rotations", Graphics Gems III (1992).
    const double a = std::sqrt(1 - u[3]), b = std::sqrt(u[3]), turn = 2 * std::numbers::pi;
    item.pose.orientation = {a * std::sin(turn * u[4]), a * std::cos(turn * u[4]), b * std::sin(turn * u[5]),
                             b * std::cos(turn * u[5])};
    scene.items.push_back(item);
  }
  return scene;
}

/// Links on ball joints, the first on the world, with a heavy sphere at the end.
inline Scene chain(int links) {
  Scene scene{"chain", {}, {}};
  for (int i = 0; i < links; ++i) {
    scene.items.push_back(box({0.5 + i, 0, 0}, {0.5, 0.1, 0.1}, 1));
    scene.joints.push_back({false, i - 1, i, i == 0 ? PlumbVec3{0, 0, 0} : PlumbVec3{0.5, 0, 0}, {-0.5, 0, 0}});
  }
  Item weight;
  weight.is_sphere = true;
  weight.half = {0.5, 0, 0};
  weight.pose = {{links + 0.5, 0, 0}, {0, 0, 0, 1}};
  weight.mass = 100;
  scene.items.push_back(weight);
  scene.joints.push_back({false, links - 1, links, {0.5, 0, 0}, {-0.5, 0, 0}});
  return scene;
}

inline Scene pendulum() {
  Scene scene{"pendulum", {box({1, 0, 0}, {0.1, 0.1, 0.1}, 1)}, {}};
  scene.joints.push_back({true, -1, 0, {0, 0, 0}, {-1, 0, 0}});
  return scene;
}

/// Frame of a hinge about z: the interface turns about x.
inline PlumbQuat x_to_z() { return {0, -std::sqrt(0.5), 0, std::sqrt(0.5)}; }

}  // namespace scenes
