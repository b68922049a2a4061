// A game over the tested backend.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "hosts/ogre/game/game.hpp"
#include "hosts/ogre/game/vectors.hpp"
#include "hosts/ogre/tests/tested_backend.hpp"

namespace plumb::ogre::tests {

constexpr double kFoot = kCharacter.half_height + kCharacter.radius;  // m below the character's middle

class Playing : public testing::Test {
 protected:
  void play(double seconds) {
    for (double end = game.stage().time() + seconds - Stage::dt / 2; game.stage().time() < end;)
      game.advance(Stage::dt);
  }
  std::size_t thing(const std::string& name) {
    const std::vector<Thing>& things = game.scene().things;
    const auto found = std::find_if(things.begin(), things.end(), [&](const Thing& one) { return one.name == name; });
    EXPECT_NE(found, things.end()) << name;
    return static_cast<std::size_t>(found - things.begin());
  }
  PlumbPose pose(const std::string& name) { return game.stage().moment().poses[thing(name)]; }
  PlumbVec3 place(const std::string& name) { return pose(name).position; }
  double platform_top() { return place("platform").y + kPlatformHalfExtents.y; }

  /// From the scene's start onto the middle of the platform, which takes until 1.6 s.
  void step_onto_platform() {
    const PlumbVec3 way = sub(platform_at(0), game.scene().character);
    const double far = std::hypot(way.x, way.z);
    game.walk({Game::kWalk * way.x / far, 0, Game::kWalk * way.z / far});
    play(far / Game::kWalk);
    game.walk({});
    play(1.6 - game.stage().time());
  }
  /// From two metres beside it.
  Ray ray_at(const std::string& name) {
    const PlumbVec3 from = add(place(name), {0, 0, 2});
    return {from, {0, 0, -1}};
  }

  Game game{tested_backend()};
};

}  // namespace plumb::ogre::tests
