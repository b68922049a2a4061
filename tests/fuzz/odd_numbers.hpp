// Numbers, vectors and poses of which most make sense and some do not.
#pragma once

#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>

#include "plumb/physics_world.hpp"

namespace plumb::fuzz {

class OddNumbers {
 protected:
  explicit OddNumbers(std::uint64_t seed) : random_(seed) {}

  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random_() % n); }
  bool chance(std::uint32_t one_in) { return below(one_in) == 0; }

  double number() {
    constexpr double odd[] = {0, -1, 1e-9, 1e9, 1e30, 1e300, -1e300, 5e-324};
    if (chance(60)) return std::numeric_limits<double>::quiet_NaN();
    if (chance(60)) return -std::numeric_limits<double>::infinity();
    if (chance(40)) return odd[below(std::size(odd))];
    return std::uniform_real_distribution<double>(-5, 5)(random_);
  }
  double positive() { return chance(30) ? number() : std::uniform_real_distribution<double>(0.2, 1)(random_); }
  PlumbVec3 vector() { return {number(), number(), number()}; }
  PlumbQuat unit() {
    std::normal_distribution<double> normal;
    PlumbQuat q{normal(random_), normal(random_), normal(random_), normal(random_)};
    const double length = chance(50) ? 1 : std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    return {q.x / length, q.y / length, q.z / length, q.w / length};
  }
  PlumbPose pose() { return {vector(), unit()}; }

  std::mt19937_64 random_;
};

}  // namespace plumb::fuzz
