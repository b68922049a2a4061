// plumb-ogre: a small game in OGRE over any backend.
#include <chrono>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>
#include <utility>

#include "hosts/ogre/game/report.hpp"
#include "hosts/ogre/options.hpp"
#include "hosts/ogre/view/window.hpp"

namespace plumb::ogre {
namespace {

/// s since it was asked last; by script every frame is one step long, however long it took.
class Clock {
 public:
  explicit Clock(bool scripted) : scripted_(scripted) {}
  double frame_time() {
    const auto now = std::chrono::steady_clock::now();
    const std::chrono::duration<double> passed = now - std::exchange(last_, now);
    return scripted_ ? Stage::dt : passed.count();
  }

 private:
  bool scripted_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

void play(Game& game, const Options& options) {
  Camera camera;
  const bool by_script = options.frames > 0;
  Window window(game, camera, !by_script);
  Script script(options.actions);
  Clock clock(by_script);
  int frames = 0;
  for (; !window.is_closed() && (!by_script || frames < options.frames); ++frames) {
    for (const Action& action : script.due(game.stage().time())) perform(action, game, camera);
    for (const Action& action : window.take_actions()) perform(action, game, camera);
    game.advance(clock.frame_time());
    window.show(game);
  }
  if (!options.screenshot.empty()) window.save_picture(options.screenshot);
  std::printf("%s\n", report(game, frames).c_str());
}

std::string installed() {
  std::string names;
  for (const FoundBackend& found : find_backends()) names += (names.empty() ? "; there are " : ", ") + found.name;
  return names.empty() ? "; none is installed: set PLUMB_BACKEND_PATH to a folder with plumb-*.so" : names;
}

int run(int count, char** words) {
  Options options;
  if (const auto status = parse_options(count, words, options)) return *status;
  std::optional<Game> game;
  try {
    game.emplace(options.backend);
  } catch (const Error& error) {
    std::fprintf(stderr, "plumb-ogre: --backend %s: %s%s\n", options.backend.c_str(), error.what(),
                 installed().c_str());
    return kWrongQuestion;
  }
  play(*game, options);
  return 0;
}

}  // namespace
}  // namespace plumb::ogre

int main(int count, char** words) {
  try {
    return plumb::ogre::run(count, words);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "plumb-ogre: %s\n", error.what());
    return 1;
  }
}
