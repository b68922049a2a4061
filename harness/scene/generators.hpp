// Large scenes by rule: their initial states are fixed to the last digit, so that figures from elsewhere compare.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scene/scene.hpp"

namespace plumb::harness {

/// The greatest seed, and the greatest number of a thing under it.
inline constexpr std::int64_t largest_seed = 0xffffffff;

/// SplitMix64 (Steele, Lea & Flood 2014), the random numbers of scenes.
class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : state_(seed) {}
  /// The numbers of the i-th thing under a seed: others for every pair, and for seed 0 those of SplitMix64(i).
  SplitMix64(std::uint32_t seed, std::uint32_t i) : SplitMix64((std::uint64_t{seed} << 32) + i) {}
  std::uint64_t next();
  double uniform();  ///< in [0, 1): the top 53 bits

 private:
  std::uint64_t state_;
};

/// Names of the generators, as scene files say them.
[[nodiscard]] const std::vector<std::string>& generator_words();

/// The largest count of a generator whose bodies are still no more than most_objects.
[[nodiscard]] std::int64_t largest_count(std::size_t generator);
/// How many bodies it makes, statics aside.
[[nodiscard]] std::size_t generated_bodies(std::size_t generator, std::int64_t count);

/// Appends the shapes and bodies of a generator: statics (ground, wall0 ...) first, then cubes box0, box1 ...
/// generator: an index into generator_words(). seed: of the piles' random numbers; that of the published figures is 0.
/// Bodies refer to shapes by their index in `shapes`.
void generate(std::size_t generator, std::int64_t count, std::uint32_t seed, double friction,
              std::vector<SceneShape>& shapes, std::vector<SceneBody>& bodies);

}  // namespace plumb::harness
