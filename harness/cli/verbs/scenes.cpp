// plumb scenes: what can be run, and of one scene all that its file says.
#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "cell/cell.hpp"
#include "cli/manual/examples.hpp"
#include "cli/output/layout.hpp"
#include "cli/output/output.hpp"
#include "cli/output/scene_sheet.hpp"
#include "cli/verbs/verbs.hpp"
#include "scene/build.hpp"
#include "scene/catalogue.hpp"
#include "simulation/names.hpp"

namespace plumb::harness {

namespace {

Json json_of(const ParameterSpec& spec) {
  Json json{{"name", spec.name}, {"unit", spec.unit}, {"doc", spec.doc}};
  std::visit([&](const auto& value) { json["default"] = value; }, spec.default_value);
  if (!spec.choices.empty()) json["choices"] = spec.choices;
  if (spec.minimum) json["minimum"] = *spec.minimum;
  if (spec.maximum) json["maximum"] = *spec.maximum;
  if (spec.choices.empty()) json["integer"] = spec.integer;
  return json;
}

Json json_of(const MetricSpec& spec) {
  return {{"name", spec.name},
          {"unit", spec.unit},
          {"doc", spec.doc},
          {"threshold", spec.threshold ? Json(*spec.threshold) : Json(nullptr)},
          {"gold", spec.gold ? Json(*spec.gold) : Json(nullptr)}};
}

Json json_of(const SceneFile& file) {
  Json json{{"name", file.id},
            {"slug", file.slug},
            {"group", file.group},
            {"title", file.title},
            {"doc", file.doc},
            {"core", file.core},
            {"path", file.path.string()},
            {"hash", fmt::format("{:016x}", file.hash)}};
  for (const char* list : {"needs", "parameters", "variants", "truths"}) json[list] = Json::array();
  for (std::size_t bit = 0; bit < need_words().size(); ++bit) {
    if ((file.needs >> bit & 1) != 0) json["needs"].push_back(need_words()[bit]);
  }
  for (const ParameterSpec& spec : file.parameters) json["parameters"].push_back(json_of(spec));
  for (const Parameters& variant : file.variants) json["variants"].push_back(harness::json_of(variant));
  for (const MetricSpec& spec : file.metrics) json["truths"].push_back(json_of(spec));
  json["measure"] = Json::parse(file.json.at("measure").dump());
  return json;
}

std::string line_for(const SceneFile& file) {
  std::string names;
  for (const ParameterSpec& spec : file.parameters) names += " " + spec.name;
  return fmt::format("{} {} {} {}{}", column(file.id, 5), column(file.group + "/" + file.slug, 36),
                     column(std::to_string(file.variants.size()), 3), file.title,
                     names.empty() ? "" : "  [" + names.substr(1) + "]");
}

}  // namespace

void add_scenes(CLI::App& program, int& status) {
  const auto json = std::make_shared<bool>(false);
  const auto asked = std::make_shared<std::vector<std::string>>();
  CLI::App* verb =
      program.add_subcommand("scenes", "List the scenes, their parameters, and what they are held against");
  verb->add_option("SCENE", *asked,
                   "Ids, slugs or files, of which all is told, or groups; none: a line for each of all");
  verb->add_flag("--json", *json, "One object a scene, one a line");
  add_examples(*verb, {{"plumb scenes", "the scenes, a line each"},
                       {"plumb scenes D1", "its parameters, truths and thresholds"},
                       {"plumb scenes stacking --json", "a group, an object a scene"}});
  verb->callback([json, asked, &status] {
    bool first = true;
    const auto print_list = [&](const std::vector<SceneFile>& files) {
      for (const SceneFile& file : files) std::cout << (*json ? line_of(json_of(file)) : line_for(file)) << "\n";
    };
    if (asked->empty()) print_list(all_scenes());
    for (const std::string& what : *asked) {
      const std::vector<SceneFile> files = find_scenes(what);
      if (*json || files.size() != 1)
        print_list(files);
      else
        std::cout << (first ? "" : "\n") << scene_sheet(files.front(), text_width());
      first = false;
    }
    status = 0;
  });
}

}  // namespace plumb::harness
