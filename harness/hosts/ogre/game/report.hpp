// What a run came to, as one line of JSON.
#pragma once

#include <string>

#include "hosts/ogre/game/game.hpp"

namespace plumb::ogre {

[[nodiscard]] std::string report(Game& game, int frames);

}  // namespace plumb::ogre
