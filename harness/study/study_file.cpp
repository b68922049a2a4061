#include "study/study_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "cell/settings.hpp"
#include "plumb/nearest.hpp"
#include "scene/json_file.hpp"
#include "scene/node.hpp"
#include "schedule/plan.hpp"
#include "simulation/names.hpp"

namespace plumb::harness {

namespace {

/// One or several: a value that stands alone is a list of one.
std::vector<Node> one_or_more(const Node& node) {
  std::vector<Node> list = node.json().is_array() ? node.elements() : std::vector<Node>{node};
  if (list.empty()) node.fail("an empty list chooses nothing; leave the key out or name something");
  return list;
}

std::vector<std::string> texts(const Node& node) {
  std::vector<std::string> list;
  for (const Node& element : one_or_more(node)) list.push_back(element.text());
  return list;
}

double positive(const Node& node) {
  const double value = node.number();
  if (!(value > 0) || !std::isfinite(value)) node.fail(fmt::format("it must be above 0, not {}", node.json().dump()));
  return value;
}

double duration(const Node& node, const char* key) {
  if (node.json().is_number()) return positive(node);
  try {
    return parse_duration(key, node.text());
  } catch (const UsageError& error) {
    node.fail(error.what());
  }
}

/// A value as somebody would type it: parameters and settings are checked where their description is known.
std::string typed(const Node& node) {
  if (node.json().is_string()) return node.text();
  if (node.json().is_number() || node.json().is_boolean()) return node.json().dump();
  node.fail(fmt::format("expected a number, a word, true or false, found {}", node.json().type_name()));
}

/// {"H": [10, 20], "mu": 0.5}: all combinations, each as "name=value".
std::vector<std::vector<std::string>> combinations(const Node& node) {
  std::vector<std::vector<std::string>> all{{}};
  for (const auto& [name, values] : node.members()) {
    std::vector<std::vector<std::string>> grown;
    for (const auto& given : all) {
      for (const Node& value : one_or_more(values)) {
        grown.push_back(given);
        grown.back().push_back(name + "=" + typed(value));
      }
    }
    all = std::move(grown);
    if (all.size() > 10000) node.fail("more than 10000 combinations");
  }
  return all;
}

Repetitions read_repetitions(const Node& node) {
  Repetitions repetitions;
  const auto count = [](const Node& n) { return static_cast<std::uint32_t>(n.integer(1, 100000)); };
  if (!node.json().is_object()) {
    repetitions.at_least = repetitions.at_most = count(node);
    return repetitions;
  }
  node.only(study_keys().at("repetitions"));
  if (const auto least = node.find("at_least")) repetitions.at_least = count(*least);
  repetitions.at_most = std::max(repetitions.at_most, repetitions.at_least);
  if (const auto most = node.find("at_most")) {
    repetitions.at_most = count(*most);
    if (repetitions.at_most < repetitions.at_least)
      most->fail(fmt::format("at_most {} is below at_least {}", repetitions.at_most, repetitions.at_least));
  }
  if (const auto within = node.find("within")) repetitions.within = duration(*within, "within");
  return repetitions;
}

StudyAxis read_axis(const Node& node) {
  StudyAxis axis;
  if (node.json().is_string()) {
    axis.name = node.text();
    return axis;
  }
  node.only(study_keys().at("axis"));
  const auto role = node.find("role"), name = node.find("name"), type = node.find("type");
  if (role.has_value() == name.has_value()) node.fail("an axis has either a name or a role");
  if (name) axis.name = name->text();
  if (role) axis.role = role_words()[role->word("role", role_words())];
  if (type) axis.type = setting_type_words()[type->word("type", setting_type_words())];
  if (type && !role) type->fail("a type goes with a role; a name says enough");
  if (const auto backend = node.find("backend")) axis.backend = backend->text();
  if (const auto optional = node.find("optional")) axis.optional = optional->boolean();
  if (const auto values = node.find("values")) {
    if (role) values->fail("values go with a name: other settings of the role take others");
    for (const Node& value : one_or_more(*values)) axis.values.push_back(typed(value));
  }
  return axis;
}

StudySet read_set(const Node& node) {
  StudySet set;
  node.only(study_keys().at("set"));
  if (const auto title = node.find("title")) set.title = title->text();
  set.scenes = texts(node.at("scenes"));
  if (const auto except = node.find("except")) set.except = texts(*except);
  if (const auto params = node.find("params")) {
    for (const Node& element : one_or_more(*params)) {
      for (auto& variant : combinations(element)) set.params.push_back(std::move(variant));
    }
  }
  if (const auto backends = node.find("backends")) set.backends = texts(*backends);
  if (const auto settings = node.find("settings")) {
    for (const auto& [name, value] : settings->members()) set.settings.push_back(name + "=" + typed(value));
  }
  if (const auto over = node.find("over")) {
    for (const Node& element : one_or_more(*over)) set.over.push_back(read_axis(element));
  }
  if (const auto along = node.find("along")) {
    for (const Node& element : one_or_more(*along)) set.along.push_back(read_axis(element));
  }
  if (const auto cross = node.find("cross")) set.cross = cross->boolean();
  if (const auto dt = node.find("dt")) {
    for (const Node& element : one_or_more(*dt)) set.dt.push_back(positive(element));
  }
  if (const auto seconds = node.find("seconds")) set.seconds = positive(*seconds);
  if (const auto seeds = node.find("seeds")) {
    for (const Node& element : one_or_more(*seeds))
      set.seeds.push_back(static_cast<double>(element.integer(0, std::int64_t{1} << 53)));
  }
  if (const auto needs = node.find("needs")) {
    set.needs = texts(*needs);
    for (const Node& element : one_or_more(*needs)) {
      try {
        check_needs("needs", element.text());
      } catch (const UsageError& error) {
        element.fail(error.what());
      }
    }
  }
  if (const auto profiles = node.find("profiles")) {
    set.profiles.clear();
    for (const Node& element : one_or_more(*profiles))
      set.profiles.push_back(profile_words()[element.word("profile", profile_words())]);
  }
  if (const auto threads = node.find("threads")) {
    set.threads.clear();
    for (const Node& element : one_or_more(*threads))
      set.threads.push_back(static_cast<std::uint32_t>(element.integer(1, 4096)));
  }
  if (const auto repetitions = node.find("repetitions")) set.repetitions = read_repetitions(*repetitions);
  if (const auto refine = node.find("refine")) set.refine = refine->boolean();
  if (const auto record = node.find("record")) set.record = record->boolean();
  return set;
}

}  // namespace

const std::map<std::string, std::vector<std::string>>& study_keys() {
  static const std::map<std::string, std::vector<std::string>> keys{
      {"", {"$schema", "name", "doc", "backends", "budget", "confidence", "shuffle", "timeout", "sets"}},
      {"set",
       {"title", "scenes", "except", "params", "backends", "settings", "over", "along", "cross", "dt", "seconds",
        "seeds", "needs", "profiles", "threads", "repetitions", "refine", "record"}},
      {"axis", {"name", "role", "type", "backend", "values", "optional"}},
      {"repetitions", {"at_least", "at_most", "within"}},
  };
  return keys;
}

StudyFile read_study(const std::filesystem::path& path, const std::string& text) {
  SceneFile file;  // what a Node tells places by
  file.path = path;
  file.text = text;
  file.json = parse_json(path, text);
  Expressions expressions;
  const Node root(file, file.json, expressions);
  root.only(study_keys().at(""));
  StudyFile study;
  study.name = root.at("name").text();
  if (const auto doc = root.find("doc")) study.doc = doc->text();
  if (const auto backends = root.find("backends"); backends && backends->json() != "all")
    study.backends = texts(*backends);
  if (const auto budget = root.find("budget")) study.budget = duration(*budget, "budget");
  if (const auto confidence = root.find("confidence")) {
    study.confidence = positive(*confidence);
    if (study.confidence >= 1) confidence->fail("a share of the median, below 1: 0.05 is 5 %");
  }
  if (const auto shuffle = root.find("shuffle"))
    study.shuffle = static_cast<std::uint32_t>(shuffle->integer(0, 0xffffffff));
  if (const auto timeout = root.find("timeout")) study.timeout = duration(*timeout, "timeout");
  for (const Node& set : one_or_more(root.at("sets"))) study.sets.push_back(read_set(set));
  study.json = file.json;
  return study;
}

StudyFile find_study(const std::string& what) {
  const auto preset = study_presets().find(what);
  if (preset != study_presets().end()) return read_study("the preset " + what, preset->second);
  if (!what.ends_with(".json") && !std::filesystem::exists(what)) {
    std::vector<std::string> names;
    for (const auto& [name, text] : study_presets()) names.push_back(name);
    throw UsageError(fmt::format("\"{}\" is neither a preset nor a study file{}", what, suggestion(what, names)));
  }
  return read_study(what, read_json_text(what, "study"));
}

double parse_duration(const std::string& option, const std::string& text) {
  static const std::map<std::string, double> units{{"", 1},   {"s", 1},        {"sec", 1},  {"seconds", 1}, {"min", 60},
                                                   {"m", 60}, {"minutes", 60}, {"h", 3600}, {"hours", 3600}};
  double number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  std::string unit(end, static_cast<std::size_t>(text.data() + text.size() - end));
  unit.erase(std::remove(unit.begin(), unit.end(), ' '), unit.end());
  const auto factor = units.find(unit);
  if (failure != std::errc{} || factor == units.end() || !(number > 0) || !std::isfinite(number))
    throw UsageError(fmt::format("{} {}: a time is a number above 0 and s, min or h: 90s, 20min, 2h", option, text));
  return number * factor->second;
}

}  // namespace plumb::harness
