#include "scene/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "base/locate.hpp"
#include "base/shown.hpp"
#include "plumb/nearest.hpp"
#include "scene/json_file.hpp"

namespace plumb::harness {
namespace {

namespace fs = std::filesystem;

/// A scene file by its name alone, before anything is read.
struct Found {
  std::string id, slug, group;
  fs::path path, root;
};

/// "D1" -> letter D, number 1; "A5b" also a suffix b.
std::tuple<std::string, long, std::string> sort_key(const std::string& id) {
  const auto digit = std::min(id.find_first_of("0123456789"), id.size());
  const auto suffix = std::min(id.find_first_not_of("0123456789", digit), id.size());
  return {id.substr(0, digit), std::strtol(id.substr(digit, suffix - digit).c_str(), nullptr, 10), id.substr(suffix)};
}

std::vector<Found> find_files() {
  std::vector<Found> files;
  for (const fs::path& directory : scene_directories()) {
    std::error_code ignored;
    for (const fs::directory_entry& group : fs::directory_iterator(directory, ignored)) {
      for (const fs::directory_entry& entry : fs::directory_iterator(group.path(), ignored)) {
        const std::string stem = entry.path().stem().string();
        const auto dash = stem.find('-');
        if (entry.path().extension() != ".json" || dash == std::string::npos) continue;
        Found file{stem.substr(0, dash), stem.substr(dash + 1), group.path().filename().string(), entry.path(),
                   directory};
        const auto same = std::find_if(files.begin(), files.end(), [&](const Found& o) { return o.id == file.id; });
        if (same == files.end()) {
          files.push_back(std::move(file));
        } else if (same->root == directory && same->path != file.path) {  // of another folder the first one holds
          throw UsageError(
              fmt::format("{} and {} have one id; rename one of them", same->path.string(), file.path.string()));
        }
      }
    }
  }
  std::sort(files.begin(), files.end(), [](const Found& a, const Found& b) { return sort_key(a.id) < sort_key(b.id); });
  return files;
}

std::vector<SceneFile> load_all(const std::vector<Found>& files) {
  std::vector<SceneFile> scenes;
  for (const Found& found : files) {
    scenes.push_back(SceneFile::load(found.path));
    const SceneFile& file = scenes.back();
    if (file.id != found.id || file.slug != found.slug)
      throw UsageError(fmt::format("{}: its id and slug are {} and {}; name the file {}-{}.json", file.path.string(),
                                   file.id, file.slug, file.id, file.slug));
  }
  return scenes;
}

/// A file that the catalogue does not know may not go by the id of one that it knows, unless it is a copy.
SceneFile load_alone(const fs::path& path) {
  SceneFile file = SceneFile::load(path);
  std::error_code ignored;
  for (const Found& known : find_files()) {
    if (known.id != file.id || fs::equivalent(known.path, path, ignored)) continue;
    if (read_json_text(known.path, "scene") == file.text) continue;
    throw UsageError(fmt::format(
        "{}:{}: id: \"{}\" is the id of {}; give this scene one of its own, and its rows are told from that one's",
        path.string(), line_of(file.text, {std::string("id")}), file.id, known.path.string()));
  }
  return file;
}

bool same_word(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](unsigned char x, unsigned char y) { return std::tolower(x) == std::tolower(y); });
}

}  // namespace

std::vector<fs::path> scene_directories() {
  std::vector<fs::path> directories;
  if (const char* list = std::getenv("PLUMB_SCENES")) {
    std::istringstream parts(list);
    for (std::string part; std::getline(parts, part, ':');)
      if (!part.empty()) directories.emplace_back(part);
  }
  for (const char* directory : {PLUMB_SOURCE_SCENES, PLUMB_INSTALLED_SCENES})
    if (fs::is_directory(directory)) directories.emplace_back(directory);
  return directories;
}

std::vector<SceneFile> all_scenes() { return load_all(find_files()); }

std::vector<std::string> scene_words() {
  std::vector<std::string> words{"core", "all"};
  for (const Found& file : find_files()) {
    words.push_back(file.id);
    words.push_back(file.slug);
    if (std::find(words.begin(), words.end(), file.group) == words.end()) words.push_back(file.group);
  }
  return words;
}

std::vector<SceneFile> find_scenes(const std::string& what) {
  if (what.ends_with(".json")) return {load_alone(what)};
  const std::vector<Found> files = find_files();
  if (files.empty()) throw UsageError("no scenes found: set PLUMB_SCENES to the folder that holds them");
  if (what == "all") return load_all(files);
  if (what == "core") {
    std::vector<SceneFile> scenes = load_all(files);
    std::erase_if(scenes, [](const SceneFile& scene) { return !scene.core; });
    return scenes;
  }
  std::vector<Found> chosen;
  std::vector<std::string> known{"core", "all"};
  for (const Found& file : files) {
    const std::string names[] = {file.id, file.slug, file.group + "/" + file.slug, file.id + "-" + file.slug};
    known.insert(known.end(), std::begin(names), std::begin(names) + 3);
    if (std::find(known.begin(), known.end(), file.group) == known.end()) known.push_back(file.group);
    const bool named =
        std::any_of(std::begin(names), std::end(names), [&](const std::string& name) { return same_word(name, what); });
    if (named || same_word(file.group, what)) chosen.push_back(file);
  }
  if (chosen.empty())
    throw UsageError(fmt::format("unknown scene \"{}\"{}", shortened(what), suggestion(shortened(what), known)));
  return load_all(chosen);
}

}  // namespace plumb::harness
