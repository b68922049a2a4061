// A study file: which scenes, backends, settings, steps and seeds make the cells of a study, and what may be spent on
// them. JSON as study.schema.json says.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"

namespace plumb::harness {

/// How often a cell is repeated. Adaptive studies go on from `at_least` until the time's interval is narrow enough;
/// fixed ones stop there.
struct Repetitions {
  std::uint32_t at_least = 1, at_most = 1;
  double within = 60;  ///< wall time in s after which a cell is not repeated again
};

/// Settings that are turned: one by its name, or all of a role and type (words of plumb.settings/1).
struct StudyAxis {
  std::string name, role, type, backend;  ///< backend "": all of the study that have it
  std::vector<std::string> values;        ///< as typed; empty: from the setting's description
  bool optional = false;                  ///< a name that no backend has is no error
};

/// One part of a study: everything in it is combined with its scenes' base cells.
struct StudySet {
  std::string title;
  std::vector<std::string> scenes, except;
  std::vector<std::vector<std::string>> params;  ///< each a scene's variant: "H=10"; empty: the scene's own variants
  std::vector<std::string> backends;             ///< empty: all of the study
  std::vector<std::string> settings;             ///< "[backend:]name=value", held still
  std::vector<StudyAxis> over, along;
  bool cross = false;  ///< ladders at each dt, and all combinations of `over`
  std::vector<double> dt;
  std::optional<double> seconds;
  std::vector<double> seeds;  ///< values of the parameter `seed` of scenes that have it
  std::vector<std::string> needs{"scene"}, profiles{"default"};
  std::vector<std::uint32_t> threads{1};
  Repetitions repetitions;
  bool refine = true, record = false;
};

struct StudyFile {
  std::string name, doc;
  std::vector<std::string> backends;  ///< empty: all that load
  std::optional<double> budget;       ///< wall time of one start, s
  double confidence = 0.05;           ///< half of the interval of the median time over the median
  std::uint32_t shuffle = 1;          ///< seed of the order
  double timeout = 300;               ///< wall time of a repetition, s
  std::vector<StudySet> sets;
  nlohmann::json json;  ///< the whole file
};

/// Keys by the definition of study.schema.json ("" for the file itself).
[[nodiscard]] const std::map<std::string, std::vector<std::string>>& study_keys();

/// Throws UsageError with path, line, value and remedy. Scenes, backends and settings are not looked up here.
[[nodiscard]] StudyFile read_study(const std::filesystem::path& path, const std::string& text);

/// The study of a preset's name or of a file. Throws UsageError, with the nearest preset for a word that is neither.
[[nodiscard]] StudyFile find_study(const std::string& what);

/// "90", "90 s", "20min", "2 h" in s. Throws UsageError "<option> <text>: ...".
[[nodiscard]] double parse_duration(const std::string& option, const std::string& text);

/// Names and texts of the studies that are part of the program.
[[nodiscard]] const std::map<std::string, std::string>& study_presets();

}  // namespace plumb::harness
