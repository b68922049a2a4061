// Actions at times, as text: a line each, "SECONDS WORD NUMBER...", "#" begins a comment.
#pragma once

#include <string>
#include <vector>

#include "hosts/ogre/game/actions.hpp"

namespace plumb::ogre {

struct TimedAction {
  double time = 0;  ///< s
  Action action;
};

/// name: of the file, for errors. Throws std::invalid_argument with a sentence that names file, line, word and remedy.
[[nodiscard]] std::vector<TimedAction> parse_script(const std::string& text, const std::string& name);

/// Hands out each action once, when its time has come.
class Script {
 public:
  explicit Script(std::vector<TimedAction> actions);

  /// Those due by then, in the order of their times; of one time in the order in which they were given.
  [[nodiscard]] std::vector<Action> due(double time);

 private:
  std::vector<TimedAction> actions_;
  std::size_t next_ = 0;
};

}  // namespace plumb::ogre
