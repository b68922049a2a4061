// The command line.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "hosts/ogre/game/script.hpp"

namespace plumb::ogre {

struct Options {
  std::string backend = "impulse";
  int frames = 0;  ///< 0: until the window is closed
  std::string screenshot;
  std::vector<TimedAction> actions;
};

/// What was wrong with the question; the program then ends with this status.
constexpr int kWrongQuestion = 2;

/// A status when the program ends here: help was asked for, or the line is wrong, which is told on standard error.
[[nodiscard]] std::optional<int> parse_options(int count, char** words, Options& options);

}  // namespace plumb::ogre
