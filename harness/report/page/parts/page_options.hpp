// What a page is to show beside its rows, and what stands on it in words.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "report/ordered/against.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

/// What a scene file says of itself.
struct SceneText {
  std::string title, doc;
};

/// One replay that the page plays.
struct PageReplay {
  std::string scene;    ///< with its parameters, "D1 H=10": replays of the same scene are shown side by side
  std::string backend;  ///< by name
  std::string bundle;   ///< packed (replay/container.hpp)
  std::optional<std::size_t> colour = {};  ///< of the style; none: that of the engine's name
};

/// A scene that the page can run itself.
struct PageWorld {
  std::string scene;  ///< as of a replay
  std::string json;   ///< replay/live_world.hpp
};

/// Scenes that the page can run, and with what; nothing of either where it cannot.
struct PageWorlds {
  std::string engine;  ///< the bytes of plumb-impulse.wasm
  std::vector<PageWorld> list;
};

/// A baseline to hold the results against.
struct AgainstPart {
  std::string name;  ///< its folder
  std::vector<Row> rows;
  AgainstLimits limits;
};

/// What DIR/study.json says of a study that made rows.
struct StudyText {
  std::string name, command;
};

struct PageOptions {
  std::string written;  ///< when, as it shall stand on the page
  std::string source;   ///< where the results came from
  std::map<std::string, SceneText>
      scenes;  ///< by scene id as rows have it; scenes without an entry show their id alone
  std::vector<StudyText> studies = {};
  std::optional<AgainstPart> against = std::nullopt;
  std::vector<PageReplay> replays = {};  ///< scenes in the order in which they shall stand
  PageWorlds worlds = {};                ///< of those that are among the replays
  std::string replays_note = {};         ///< what was recorded and is not among them, in words; or ""
};

}  // namespace plumb::harness
