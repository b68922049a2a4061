// Sets of boxes on which a broad phase can go wrong, made from a seed.
#pragma once

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "math/box.hpp"

namespace plumb::impulse {

enum class Field { kUniform, kClustered, kCoincident, kPlanar, kGiant, kMixed, kTouching, kDecades };
inline constexpr Field kFields[] = {Field::kUniform, Field::kClustered, Field::kCoincident, Field::kPlanar,
                                    Field::kGiant,   Field::kMixed,     Field::kTouching,   Field::kDecades};

inline std::string name_of(Field field) {
  constexpr const char* names[] = {"uniform", "clustered", "coincident", "planar",
                                   "giant",   "mixed",     "touching",   "decades"};
  return names[static_cast<int>(field)];
}

/// splitmix64
class FieldDice {
 public:
  explicit FieldDice(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9E3779B97F4A7C15U;
    z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9U;
    z = (z ^ z >> 27) * 0x94D049BB133111EBU;
    return z ^ z >> 31;
  }
  Real unit() { return static_cast<Real>(static_cast<double>(bits() >> 40) * 0x1p-24); }
  Real between(Real low, Real high) { return low + (high - low) * unit(); }
  Vec in_cube(Real half) { return {between(-half, half), between(-half, half), between(-half, half)}; }

 private:
  std::uint64_t state_;
};

/// Cube root by basic operations only: the same bits on every machine, unlike std::cbrt.
inline double cube_root(double x) {
  double root = x > 1 ? x : 1;
  for (int i = 0; i < 100; ++i) root = (2 * root + x / (root * root)) / 3;  // Newton's method
  return root;
}

inline Box box_at(const Vec& centre, const Vec& half) { return {centre - half, centre + half}; }

/// n boxes. uniform: sides of .5 to 1.5 m, about `neighbours` others overlap each.
inline std::vector<Box> make_boxes(Field field, std::uint32_t n, std::uint64_t seed, Real neighbours = 10) {
  FieldDice dice(seed + static_cast<std::uint64_t>(field) * 1000);
  // Two boxes of mean side 1 overlap where their centres are within 1 of each other on each axis: a volume of 8.
  const Real half_scene = Real(.5) * static_cast<Real>(cube_root(8.0 * n / static_cast<double>(neighbours)));
  const auto half_size = [&] { return Vec{dice.between(.25, .75), dice.between(.25, .75), dice.between(.25, .75)}; };
  std::vector<Box> boxes(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    Box& box = boxes[i];
    switch (field) {
      case Field::kUniform: box = box_at(dice.in_cube(half_scene), half_size()); break;
      case Field::kClustered: {  // dense balls far from each other, and a stray far out
        FieldDice of_cluster(seed + i % 16);
        const Vec middle = of_cluster.in_cube(1000 * half_scene);
        box = box_at(middle + dice.in_cube(half_scene / 2), Real(.5) * half_size());
        if (i == n / 2) box = box_at({Real(1e8), 0, 0}, {1, 1, 1});
        break;
      }
      case Field::kCoincident: {  // equal centres, in groups of 24 that are all at a few places of one line
        const auto group = static_cast<Real>(i / 24);
        box = box_at({group * Real(1e-3), 0, 0}, Real(1e-4) * Vec{1, 1, 1});
        break;
      }
      case Field::kPlanar: {
        const Real side = static_cast<Real>(std::sqrt(static_cast<double>(n)));
        box = box_at({dice.between(0, side), 2, dice.between(0, side)}, half_size());
        break;
      }
      case Field::kGiant:
        box = box_at(dice.in_cube(half_scene), half_size());
        if (i == n / 3) box = box_at({0, 0, 0}, {half_scene, Real(.1), half_scene});  // as large as the ground
        break;
      case Field::kMixed: {  // sizes over three decades, points among them, few of them large
        const Real size = Real(1) / static_cast<Real>(1U << dice.bits() % 11);
        const Real large = dice.unit() < Real(.002) ? 30 : 1;
        box = box_at(dice.in_cube(half_scene), i % 7 == 0 ? Vec{0, 0, 0} : large * size * half_size());
        break;
      }
      case Field::kDecades: {  // radii from 1e-3 to 1e3, as many of each decade; the cube of two's sum is 6.4e7 on
                               // average
        constexpr Real decades[] = {Real(1e-3), Real(1e-2), Real(1e-1), 1, 10, 100};
        const Real radius = decades[dice.bits() % 6] * dice.between(1, 10);
        box = box_at(dice.in_cube(Real(400) * half_scene), {radius, radius, radius});
        break;
      }
      case Field::kTouching: {  // unit cubes on a grid: every face, edge and corner touches
        const auto edge = static_cast<std::uint32_t>(std::ceil(std::cbrt(static_cast<double>(n))));
        const Vec low{static_cast<Real>(i % edge), static_cast<Real>(i / edge % edge),
                      static_cast<Real>(i / edge / edge)};
        box = {low, low + Vec{1, 1, 1}};
        break;
      }
    }
  }
  return boxes;
}

}  // namespace plumb::impulse
