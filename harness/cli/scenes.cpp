#include <fmt/format.h>

#include <iostream>
#include <memory>

#include "cli/output.hpp"
#include "cli/verbs.hpp"
#include "run/cell.hpp"
#include "run/names.hpp"
#include "scene/build.hpp"
#include "scene/catalogue.hpp"

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
  verb->add_option("SCENE", *asked, "Ids, slugs, groups or files; none: all");
  verb->add_flag("--json", *json, "One object a scene, one a line");
  verb->callback([json, asked, &status] {
    std::vector<SceneFile> files;
    if (asked->empty()) files = all_scenes();
    for (const std::string& what : *asked) {
      for (SceneFile& file : find_scenes(what)) files.push_back(std::move(file));
    }
    for (const SceneFile& file : files) std::cout << (*json ? line_of(json_of(file)) : line_for(file)) << "\n";
    status = 0;
  });
}

}  // namespace plumb::harness
