// What stands in the game, before any engine knows of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "plumb/physics_world.hpp"

namespace plumb::ogre {

struct Thing {
  std::string name;
  PlumbShapeDesc shape;
  PlumbBodyDesc body;    ///< without its shape, which a world gives
  std::uint32_t colour;  ///< 0xrrggbb
};

struct Scene {
  std::vector<Thing> things;
  std::size_t platform = 0;  ///< which of them
  PlumbVec3 character{};     ///< middle of its capsule, m
};

constexpr PlumbVec3 kGravity{0, -9.81, 0};

/// What falls from the sky, all of one colour.
constexpr std::uint32_t kFalling = 0xff8c1a;
constexpr PlumbVec3 kPlatformHalfExtents{1.3, 0.07, 1.3};

/// Ground, a ramp, a pyramid of boxes, a platform with boxes on it, a ball, and shapes that fall.
[[nodiscard]] Scene make_scene();

/// Where the platform's middle is: it waits, rises, crosses, comes back and sinks, over and over.
[[nodiscard]] PlumbVec3 platform_at(double seconds);

}  // namespace plumb::ogre
