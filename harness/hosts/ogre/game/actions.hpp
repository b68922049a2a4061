// What a player does, whoever that is: keys and a mouse, or a script.
#pragma once

#include <string>
#include <variant>

#include "hosts/ogre/game/camera.hpp"
#include "hosts/ogre/game/game.hpp"

namespace plumb::ogre {

struct Walk {
  double x = 0, z = 0;  ///< m/s, world; until the next one
};
struct Jump {};
// The pointer is told as 0..1 from the window's left and top.
struct Press {
  double x = 0, y = 0;
};
struct Point {
  double x = 0, y = 0;
};
struct Release {};
struct SwitchTo {
  std::string engine;  ///< "": the next one
};
struct Turn {
  double yaw = 0, pitch = 0;  ///< rad
};
struct Zoom {
  double factor = 1;
};
using Action = std::variant<Walk, Jump, Press, Point, Release, SwitchTo, Turn, Zoom>;

void perform(const Action& action, Game& game, Camera& camera);

}  // namespace plumb::ogre
