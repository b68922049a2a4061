#include "hosts/ogre/game/script.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <sstream>
#include <stdexcept>
#include <string_view>

#include "plumb/nearest.hpp"

namespace plumb::ogre {
namespace {

using Numbers = std::vector<double>;

struct Word {
  std::string name;
  std::string usage;
  std::size_t numbers;
  std::function<Action(const Numbers&)> make;
};

const std::vector<Word>& words() {
  static const std::vector<Word> known{
      {"walk", "walk X Z (m/s)", 2,
       [](const Numbers& n) {
         return Walk{n[0], n[1]};
       }},
      {"jump", "jump", 0, [](const Numbers&) { return Jump{}; }},
      {"press", "press X Y (0..1 from the window's left and top)", 2,
       [](const Numbers& n) {
         return Press{n[0], n[1]};
       }},
      {"point", "point X Y (0..1 from the window's left and top)", 2,
       [](const Numbers& n) {
         return Point{n[0], n[1]};
       }},
      {"release", "release", 0, [](const Numbers&) { return Release{}; }},
      {"turn", "turn YAW PITCH (rad)", 2,
       [](const Numbers& n) {
         return Turn{n[0], n[1]};
       }},
      {"zoom", "zoom FACTOR", 1, [](const Numbers& n) { return Zoom{n[0]}; }},
  };
  return known;
}

std::vector<std::string> known_names() {
  std::vector<std::string> names{"switch"};
  for (const Word& word : words()) names.push_back(word.name);
  return names;
}

double number_of(const std::string& text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(value))
    throw std::invalid_argument("\"" + text + "\" is no number");
  return value;
}

Action action_of(const std::vector<std::string>& tokens) {
  const std::string& name = tokens[1];
  if (name == "switch") {
    if (tokens.size() > 3) throw std::invalid_argument("switch takes one engine: switch [ENGINE]");
    return SwitchTo{tokens.size() == 3 ? tokens[2] : ""};
  }
  const auto word = std::find_if(words().begin(), words().end(), [&](const Word& one) { return one.name == name; });
  if (word == words().end())
    throw std::invalid_argument("there is no action \"" + name + "\"" + suggestion(name, known_names()));
  Numbers numbers;
  for (std::size_t i = 2; i < tokens.size(); ++i) numbers.push_back(number_of(tokens[i]));
  if (numbers.size() != word->numbers)
    throw std::invalid_argument(name + " got " + std::to_string(numbers.size()) + " numbers: write " + word->usage);
  if (name == "zoom" && numbers[0] <= 0) throw std::invalid_argument("zoom got a factor of 0 or less: write 0.5 or 2");
  return word->make(numbers);
}

TimedAction timed_action_of(const std::vector<std::string>& tokens) {
  const double time = number_of(tokens[0]);
  if (time < 0) throw std::invalid_argument("time " + tokens[0] + " is before the game: write 0 or more");
  if (tokens.size() == 1) throw std::invalid_argument("there is a time without an action: write SECONDS ACTION");
  return {time, action_of(tokens)};
}

}  // namespace

std::vector<TimedAction> parse_script(const std::string& text, const std::string& name) {
  std::vector<TimedAction> actions;
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    std::istringstream words_of_line(line.substr(0, line.find('#')));
    std::vector<std::string> tokens;
    for (std::string token; words_of_line >> token;) tokens.push_back(token);
    if (tokens.empty()) continue;
    try {
      actions.push_back(timed_action_of(tokens));
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(name + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return actions;
}

Script::Script(std::vector<TimedAction> actions) : actions_(std::move(actions)) {
  std::stable_sort(actions_.begin(), actions_.end(),
                   [](const TimedAction& a, const TimedAction& b) { return a.time < b.time; });
}

std::vector<Action> Script::due(double time) {
  std::vector<Action> actions;
  for (; next_ < actions_.size() && actions_[next_].time <= time; ++next_) actions.push_back(actions_[next_].action);
  return actions;
}

}  // namespace plumb::ogre
