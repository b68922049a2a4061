#include "cli/duel/duel_engine.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "base/format.hpp"
#include "base/shown.hpp"
#include "base/usage_error.hpp"
#include "cell/settings.hpp"
#include "plumb/nearest.hpp"
#include "report/ordered/machine_rows.hpp"
#include "report/ordered/ordered_rows.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness {
namespace {

/// One word behind the colon.
void take_word(DuelEngine& engine, const std::string& word) {
  if (word.find('=') != std::string::npos) {
    (void)parse_setting_request(word);
    engine.settings.push_back(word);
    return;
  }
  const std::vector<std::string>& known = profile_words();
  if (std::find(known.begin(), known.end(), word) == known.end())
    throw UsageError(fmt::format("{}: \"{}\" is neither a profile nor a setting's name=value{}",
                                 shortened(engine.typed), shortened(word), suggestion(word, known)));
  if (engine.profile != "default") throw UsageError(fmt::format("{}: there are two profiles", shortened(engine.typed)));
  engine.profile = word;
}

/// A setting's value in a row is what was typed, be it as a number or as a word.
bool has_setting(const Row& row, const std::string& request) {
  const SettingRequest asked = parse_setting_request(request);
  const auto found = row.settings.find(asked.name);
  if (found == row.settings.end()) return false;
  const Json typed = Json::parse(asked.text, nullptr, false);
  return (!typed.is_discarded() && *found == typed) || value_text(*found) == asked.text;
}

/// Step at which the backend runs the scene by default, where it did.
std::optional<double> default_dt(const OrderedRows& ordered, const Row& like) {
  for (const Row& row : ordered.rows) {
    if (row.backend == like.backend && row.scene == like.scene && ordered.is_default(row)) return row.dt;
  }
  return like.dt;
}

bool is_of_engine(const OrderedRows& ordered, const Row& row, const DuelEngine& engine) {
  if (row.backend != engine.backend_name() || !row.own_needs()) return false;
  if (engine.profile == "default" && engine.settings.empty()) return ordered.is_default(row);
  if ((row.profile.empty() ? "default" : row.profile) != engine.profile || row.dt != default_dt(ordered, row))
    return false;
  const bool asked = std::all_of(engine.settings.begin(), engine.settings.end(),
                                 [&](const std::string& setting) { return has_setting(row, setting); });
  // A profile changes settings by itself; without one, nothing else may have been turned.
  return asked && (engine.profile != "default" || ordered.changed_settings(row).size() <= engine.settings.size());
}

bool called(const Row& row, const std::string& word) {
  return word == "all" || word == row.scene || word == row.slug || word == row.group ||
         word == row.group + "/" + row.slug;
}

/// Ids of the scenes that the word stands for.
std::set<std::string> scene_ids(const std::vector<Row>& rows, const std::string& word) {
  std::set<std::string> ids;
  for (const Row& row : rows) {
    if (called(row, word)) ids.insert(row.scene);
  }
  if (ids.empty()) {
    for (const SceneFile& file : find_scenes(word)) ids.insert(file.id);
  }
  return ids;
}

}  // namespace

std::string DuelEngine::backend_name() const {
  if (backend.find('/') == std::string::npos && !backend.ends_with(".so")) return backend;
  std::string name = std::filesystem::path(backend).stem().string();
  if (name.starts_with("plumb-")) name.erase(0, 6);
  return name;
}

DuelEngine parse_duel_engine(const std::string& typed) {
  DuelEngine engine;
  engine.typed = typed;
  const auto slash = typed.rfind('/');
  const auto colon = typed.find(':', slash == std::string::npos ? 0 : slash);
  engine.backend = typed.substr(0, colon);
  if (engine.backend.empty())
    throw UsageError(fmt::format("\"{}\" names no engine: write BACKEND, or BACKEND:PROFILE", shortened(typed)));
  if (colon == std::string::npos) return engine;
  std::istringstream words(typed.substr(colon + 1));
  for (std::string word; std::getline(words, word, ',');) take_word(engine, word);
  return engine;
}

std::array<std::string, 2> duel_names(const std::array<DuelEngine, 2>& engines) {
  std::array<std::string, 2> names;
  for (std::size_t side = 0; side < 2; ++side) {
    const DuelEngine& engine = engines[side];
    std::vector<std::string> asked = engine.settings;
    if (engine.profile != "default") asked.insert(asked.begin(), engine.profile);
    names[side] = engine.backend_name() + (asked.empty() ? "" : fmt::format(":{}", fmt::join(asked, ",")));
  }
  if (names[0] == names[1]) names = {engines[0].typed, engines[1].typed};
  return names;
}

std::vector<Row> rows_of_engine(const std::vector<Row>& rows, const DuelEngine& engine, const std::string& where) {
  std::vector<Row> mine;
  std::vector<std::string> known;
  for (MachineRows& machine : rows_by_machine(rows)) {
    const OrderedRows ordered(std::move(machine.rows));
    known.insert(known.end(), ordered.backends.begin(), ordered.backends.end());
    for (const Row& row : ordered.rows) {
      if (is_of_engine(ordered, row, engine)) mine.push_back(row);
    }
  }
  if (!mine.empty()) return mine;
  if (std::find(known.begin(), known.end(), engine.backend_name()) == known.end())
    throw UsageError(fmt::format("the results in {} have no backend \"{}\"{}", where, shortened(engine.backend_name()),
                                 suggestion(engine.backend_name(), known)));
  throw UsageError(fmt::format("the results in {} have no run of {} with what {} asks for; without --from it is run",
                               where, engine.backend_name(), shortened(engine.typed)));
}

std::vector<Row> rows_of_scenes(const std::vector<Row>& rows, const std::vector<std::string>& words,
                                const std::string& where) {
  if (words.empty()) return rows;
  std::set<std::string> ids;
  for (const std::string& word : words) {
    const std::set<std::string> named = scene_ids(rows, word);
    const bool there = std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return named.contains(row.scene); });
    if (!there)
      throw UsageError(
          fmt::format("the results in {} have no run of {}; without --from it is run", where, shortened(word)));
    ids.insert(named.begin(), named.end());
  }
  std::vector<Row> chosen;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(chosen),
               [&](const Row& row) { return ids.contains(row.scene); });
  return chosen;
}

}  // namespace plumb::harness
