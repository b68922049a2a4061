// All measures, joined from the groups' lists.
#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "measure/groups.hpp"
#include "plumb/nearest.hpp"
#include "scene/locate.hpp"

namespace plumb::harness {
namespace {

[[noreturn]] void fail(const SceneFile& file, const JsonPath& path, const std::string& what, const std::string& word,
                       const std::vector<std::string>& known) {
  throw UsageError(fmt::format("{}:{}: unknown {} \"{}\"{}", file.path.string(), line_of(file.text, path), what, word,
                               suggestion(word, known)));
}

}  // namespace

std::span<const MeasureEntry> all_measures() {
  static const std::vector<MeasureEntry> all = [] {
    std::vector<MeasureEntry> joined;
    for (const auto group : {integrator_measures(), collision_measures(), friction_measures(), stacking_measures(),
                             joint_measures(), robustness_measures(), scale_measures(), geometry_measures()})
      joined.insert(joined.end(), group.begin(), group.end());
    return joined;
  }();
  return all;
}

const MeasureEntry& find_measure(const SceneFile& file) {
  const nlohmann::json& measure = file.json.at("measure");
  const std::string kind = measure.at("kind").get<std::string>();
  const auto measures = all_measures();
  const auto found = std::find_if(measures.begin(), measures.end(), [&](const auto& m) { return kind == m.name; });
  if (found == measures.end()) {
    std::vector<std::string> known;
    for (const MeasureEntry& entry : measures) known.emplace_back(entry.name);
    fail(file, {std::string("measure"), std::string("kind")}, "measure", kind, known);
  }
  const std::vector<std::string> known(found->args.begin(), found->args.end());
  for (const auto& [key, value] : measure.items())
    if (key != "kind" && std::find(known.begin(), known.end(), key) == known.end())
      fail(file, {std::string("measure"), key}, "argument of measure " + kind, key, known);
  return *found;
}

}  // namespace plumb::harness
