#include "measure/registry/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "measure/collision/collision.hpp"
#include "measure/friction/friction.hpp"
#include "measure/geometry/geometry.hpp"
#include "measure/instruments/args.hpp"
#include "measure/integrator/integrator.hpp"
#include "measure/joints/joints.hpp"
#include "measure/quantities/quantities.hpp"
#include "measure/robustness/robustness.hpp"
#include "measure/scale/scale.hpp"
#include "measure/stacking/stacking.hpp"
#include "plumb/nearest.hpp"

namespace plumb::harness {
namespace {

JsonPath argument_path(const std::string& key) { return {std::string("measure"), key}; }

std::vector<std::string> names_of(std::span<const MeasureEntry> measures) {
  std::vector<std::string> names;
  for (const MeasureEntry& entry : measures) names.emplace_back(entry.name);
  return names;
}

const MeasureEntry* find(const std::string& name) {
  const auto measures = all_measures();
  const auto found = std::find_if(measures.begin(), measures.end(), [&](const auto& m) { return name == m.name; });
  return found == measures.end() ? nullptr : &*found;
}

bool is_expression(const nlohmann::json& value) {
  return value.is_string() && value.get_ref<const std::string&>().starts_with("=");
}
bool is_number(const nlohmann::json& value) { return value.is_number() || is_expression(value); }

/// Whether a value, as the file has it, can become an argument of the type.
bool fits(const nlohmann::json& value, ArgumentType type) {
  switch (type) {
    case ArgumentType::number: return is_number(value);
    case ArgumentType::numbers: return value.is_array() && std::all_of(value.begin(), value.end(), is_number);
    case ArgumentType::object: return value.is_object();
    default: return value.is_string() && !is_expression(value);
  }
}

/// A value of the file, cut where it is long.
std::string excerpt(const nlohmann::json& value) {
  constexpr std::size_t most = 60;
  const std::string text = value.dump();
  return text.size() <= most ? text : text.substr(0, most) + "...";
}

const char* sentence_of(ArgumentType type) {
  switch (type) {
    case ArgumentType::number: return "a number, or an expression that starts with =";
    case ArgumentType::numbers: return "an array of numbers, or of expressions that start with =";
    case ArgumentType::word: return "a word";
    case ArgumentType::body: return "the name of a body";
    case ArgumentType::bodies: return "what comes before the number in the names of several bodies";
    case ArgumentType::joint: return "the name of a joint";
    default: return "an object";
  }
}

}  // namespace

std::span<const MeasureEntry> all_measures() {
  static const std::vector<MeasureEntry> all = [] {
    std::vector<MeasureEntry> joined;
    for (const auto group :
         {quantity_measures(), integrator_measures(), collision_measures(), friction_measures(), stacking_measures(),
          joint_measures(), robustness_measures(), scale_measures(), geometry_measures()})
      joined.insert(joined.end(), group.begin(), group.end());
    return joined;
  }();
  return all;
}

const MeasureEntry& find_measure(const std::string& name) {
  const MeasureEntry* found = find(name);
  if (found == nullptr)
    throw UsageError(fmt::format("there is no measure \"{}\"{}", name, suggestion(name, names_of(all_measures()))));
  return *found;
}

const MeasureEntry& find_measure(const SceneFile& file) {
  const nlohmann::json& measure = file.json.at("measure");
  const std::string kind = measure.at("kind").get<std::string>();
  const MeasureEntry* found = find(kind);
  if (found == nullptr)
    fail_at(file, argument_path("kind"),
            fmt::format("unknown measure \"{}\"{}", kind, suggestion(kind, names_of(all_measures()))));
  std::vector<std::string> known;
  for (const MeasureArgument& argument : found->args) known.emplace_back(argument.name);
  for (const auto& [key, value] : measure.items())
    if (key != "kind" && std::find(known.begin(), known.end(), key) == known.end())
      fail_at(file, argument_path(key),
              fmt::format("unknown argument of measure {} \"{}\"{}", kind, key, suggestion(key, known)));
  for (const MeasureArgument& argument : found->args) {
    const auto given = measure.find(argument.name);
    if (given == measure.end()) {
      if (argument.optional) continue;
      fail_at(file, {std::string("measure")},
              fmt::format("measure {} needs the argument \"{}\": {}", kind, argument.name, sentence_of(argument.type)));
    }
    if (!fits(*given, argument.type))
      fail_at(file, argument_path(argument.name),
              fmt::format("argument \"{}\" of measure {} must be {}, not {}", argument.name, kind,
                          sentence_of(argument.type), excerpt(*given)));
  }
  return *found;
}

void check_measure(const SceneFile& file, const Scene& scene) {
  const MeasureEntry& measure = find_measure(file);
  for (const MeasureArgument& argument : measure.args) {
    // What may be left out may also name what only other variants of the scene have.
    if (argument.optional || !scene.measure_args.contains(argument.name)) continue;
    try {
      if (argument.type == ArgumentType::body) static_cast<void>(arg_body(scene, argument.name));
      if (argument.type == ArgumentType::bodies) static_cast<void>(arg_bodies(scene, argument.name));
      if (argument.type == ArgumentType::joint) static_cast<void>(arg_joint(scene, argument.name));
    } catch (const UsageError& error) {
      fail_at(file, argument_path(argument.name), error.what());
    }
  }
  if (measure.check != nullptr) measure.check(file, scene);
}

}  // namespace plumb::harness
