// What chance draws, the same from the same seed on every platform: of the standard library the engine's numbers are
// laid down to the bit, those of its distributions are not.
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "referee/pose.hpp"

namespace plumb::harness {

class Chance {
 public:
  explicit Chance(std::uint64_t seed) : engine_(seed) {}

  /// From 0 up to and without 1.
  double share() { return static_cast<double>(engine_() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * share(); }
  /// As often within any two numbers of one ratio; both above 0.
  double by_ratio(double low, double high) { return low * std::pow(high / low, share()); }
  /// From 0 to count - 1.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(share() * static_cast<double>(count)); }
  bool happens(double probability) { return share() < probability; }
  /// A unit vector, none likelier than others.
  referee::Vec3 direction() {
    const double up = between(-1, 1), turn = between(0, 2 * std::numbers::pi), flat = std::sqrt(1 - up * up);
    return {flat * std::cos(turn), up, flat * std::sin(turn)};
  }
  referee::Mat3 rotation() {
    const referee::Vec3 axis = direction();
    return Eigen::AngleAxisd(between(0, 2 * std::numbers::pi), axis).toRotationMatrix();
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace plumb::harness
