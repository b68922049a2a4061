#include "cli/output/backend_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "cli/output/layout.hpp"
#include "simulation/names.hpp"

namespace plumb::harness {

namespace {

std::string listed(const std::vector<std::string>& words) { return fmt::format("{}", fmt::join(words, ", ")); }

/// "float from 0 to 0.1 m, default 0.005 m; role quality; only when a world is made".
std::string facts_of(const SettingDescription& setting) {
  const std::string unit = setting.unit.empty() || setting.unit == "1" ? "" : " " + setting.unit;
  std::string facts = setting.type;
  if (!setting.choices.empty()) facts += " of " + listed(setting.choices);
  if (std::isfinite(setting.minimum) && std::isfinite(setting.maximum))
    facts += fmt::format(" from {} to {}{}", setting.minimum, setting.maximum, unit);
  else if (std::isfinite(setting.minimum))
    facts += fmt::format(" from {}{} on", setting.minimum, unit);
  else if (std::isfinite(setting.maximum))
    facts += fmt::format(" up to {}{}", setting.maximum, unit);
  facts += fmt::format(", default {}{}; role {}", typed_text(setting.default_value), unit, setting.role);
  return setting.creation_only ? facts + "; only when a world is made" : facts;
}

std::string settings_of(const BackendDescription& backend, std::size_t width) {
  if (backend.settings.empty()) return "\nNo settings.\n";
  std::string text = "\nSettings, for --set name=value:\n";
  for (const SettingDescription& setting : backend.settings)
    text += entry(setting.name, setting.doc, name_columns, width) + entry("", facts_of(setting), name_columns, width);
  return text;
}

/// "native: a, b; emulated: c; none: d", the best first; where all are alike the degree alone.
std::string degrees_of(const Json& words) {
  std::vector<std::string> parts;
  for (auto degree = degree_words().rbegin(); degree != degree_words().rend(); ++degree) {
    std::vector<std::string> of_it;
    for (const auto& [word, its] : words.items())
      if (its == *degree) of_it.push_back(word);
    if (of_it.size() == words.size()) return *degree;
    if (!of_it.empty()) parts.push_back(*degree + ": " + listed(of_it));
  }
  return fmt::format("{}", fmt::join(parts, "; "));
}

/// A table's rows with those that say the same on one line: "sphere, box: native".
std::string table_of(const Json& rows) {
  std::vector<std::pair<std::string, std::vector<std::string>>> lines;
  for (const auto& [row, columns] : rows.items()) {
    const std::string degrees = degrees_of(columns);
    const auto same = std::find_if(lines.begin(), lines.end(), [&](const auto& line) { return line.first == degrees; });
    if (same == lines.end())
      lines.push_back({degrees, {row}});
    else
      same->second.push_back(row);
  }
  if (lines.size() == 1) return lines.front().first;
  std::string text;
  for (const auto& [degrees, words] : lines)
    text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", listed(words), degrees);
  return text;
}

std::string spaced(std::string title) {
  std::replace(title.begin(), title.end(), '_', ' ');
  return title;
}

/// Notes by their text, each with what it is said of: places by name, or by number where they are many.
std::string notes_of(const Json& notes, std::size_t width) {
  std::vector<std::pair<std::string, std::vector<std::string>>> by_text;
  for (const auto& [place, note] : notes.items()) {
    const auto said = note.get<std::string>();
    const auto same = std::find_if(by_text.begin(), by_text.end(), [&](const auto& t) { return t.first == said; });
    if (same == by_text.end())
      by_text.push_back({said, {place}});
    else
      same->second.push_back(place);
  }
  constexpr std::size_t most_named = 6;
  std::string text;
  for (const auto& [note, places] : by_text) {
    std::vector<std::string> named = places;
    if (places.size() > most_named) {
      std::vector<std::pair<std::string, int>> counts;
      for (const std::string& place : places) {
        const std::string title = place.substr(0, place.find('.'));
        if (counts.empty() || counts.back().first != title) counts.push_back({title, 0});
        ++counts.back().second;
      }
      named.clear();
      for (const auto& [title, count] : counts) named.push_back(fmt::format("{} of {}", count, spaced(title)));
    }
    text += wrapped(note, 2, width) + "\n" + wrapped("(" + listed(named) + ")", 6, width) + "\n";
  }
  return text.empty() ? "" : "\nNotes on capabilities:\n" + text;
}

std::string capabilities_of(const Json& capabilities, std::size_t width) {
  std::string text = "\nCapabilities:\n";
  for (const auto& [title, what] : capabilities.items()) {
    if (title == "notes") continue;
    const bool is_table = what.is_object() && !what.empty() && what.begin()->is_object();
    const std::string degrees = what.is_string() ? what.get<std::string>()
                                : is_table       ? table_of(what)
                                                 : degrees_of(what);
    text += entry(spaced(title), degrees, name_columns, width);
  }
  const auto notes = capabilities.find("notes");
  return notes == capabilities.end() ? text : text + notes_of(*notes, width);
}

}  // namespace

std::string backend_sheet(const BackendDescription& backend, std::size_t width) {
  const Json& json = backend.json;
  const auto line = [&](const char* name, const std::string& text) {
    return text.empty() ? "" : entry(name, text, name_columns, width);
  };
  std::string text = fmt::format("{} {}\n", backend.name, backend.version);
  const std::string about = json.value("description", "");
  if (!about.empty()) text += wrapped(about, 2, width) + "\n";
  text += line("file", backend.file) + line("build", backend.build) + line("device", backend.device);
  text += line("precision", json.value("precision", ""));
  text +=
      line("threads", fmt::format("up to {}; the same bits: {}", backend.max_threads, json.value("determinism", "")));
  text += line("extensions", listed(json.value("extensions", std::vector<std::string>{})));
  text += line("beside it in a process", json.value("exclusion_group", ""));
  text += settings_of(backend, width);
  text += capabilities_of(json.value("capabilities", Json::object()), width);
  return text + fmt::format("\nExample:\n  plumb run A1 --backend {}{}\n", backend.name,
                            backend.settings.empty() ? ""
                                                     : fmt::format(" --set {}={}", backend.settings.front().name,
                                                                   typed_text(backend.settings.front().default_value)));
}

}  // namespace plumb::harness
