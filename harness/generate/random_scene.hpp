// A scene of chance: machines of joined bodies, heaps, loads, grounds. What it is depends on the seed alone. Nothing
// overlaps at its start and no joint is open, so what goes wrong later the engine has done.
#pragma once

#include <string>

#include "base/json.hpp"
#include "generate/features.hpp"

namespace plumb::harness {

struct RandomSceneRequest {
  std::uint32_t seed = 1;
  std::size_t most_bodies = 12;  ///< that move; at least 2
  double mass_ratio = 100;       ///< of the heaviest part's mass to the lightest's
  double seconds = 10, dt = 1.0 / 60;
  std::vector<Feature> without;
};

/// As a scene file says it, with truths that hold for all: no joint opens, nothing sinks in, limits are kept, and where
/// nobody drives it no energy is made. Its id is R and the seed.
[[nodiscard]] Json random_scene(const RandomSceneRequest& request);

}  // namespace plumb::harness
