#include "cli/output/scene_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "cli/output/layout.hpp"
#include "measure/registry/registry.hpp"
#include "scene/build.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness {

namespace {

constexpr std::size_t name_width = 20;

std::string text_of(const ParameterValue& value) {
  if (const auto* word = std::get_if<std::string>(&value)) return *word;
  return fmt::format("{}", std::get<double>(value));
}

std::string unit_of(const std::string& unit) { return unit.empty() || unit == "1" ? "" : " " + unit; }

/// "default 10 m; whole, from 1 to 1000 m".
std::string facts_of(const ParameterSpec& spec) {
  const std::string unit = unit_of(spec.unit);
  std::string facts = "default " + text_of(spec.default_value) + unit;
  if (!spec.choices.empty()) return facts + fmt::format("; one of {}", fmt::join(spec.choices, ", "));
  if (spec.minimum && spec.maximum)
    facts += fmt::format("; from {} to {}{}", *spec.minimum, *spec.maximum, unit);
  else if (spec.minimum)
    facts += fmt::format("; from {}{} on", *spec.minimum, unit);
  else if (spec.maximum)
    facts += fmt::format("; up to {}{}", *spec.maximum, unit);
  return spec.integer ? facts + "; a whole number" : facts;
}

std::string text_of(const Parameters& variant) {
  std::string text;
  for (const auto& [name, value] : variant) text += (text.empty() ? "" : " ") + name + "=" + text_of(value);
  return text.empty() ? "the defaults" : text;
}

/// A number of the file: as it stands there, and what it comes to where that is an expression.
std::string formula(const nlohmann::json& given, double value) {
  if (!given.is_string()) return fmt::format("{}", value);
  return fmt::format("{} = {:.4g}", given.get_ref<const std::string&>(), value);
}

/// Where the truth of a metric stands in the file itself: "truth speed / g".
std::string truth_of(const SceneFile& file, const std::string& metric) {
  const nlohmann::json& measure = file.json.at("measure");
  const auto quantities = measure.find("quantities");
  if (quantities == measure.end() || !quantities->contains(metric)) return "";
  const nlohmann::json& quantity = quantities->at(metric);
  if (!quantity.is_object() || !quantity.contains("truth")) return "";
  const nlohmann::json& truth = quantity.at("truth");
  if (!truth.is_string()) return "truth " + truth.dump();
  const std::string text = truth.get<std::string>();
  return "truth " + (text.starts_with("=") ? text.substr(1) : text);
}

/// "truth ...; in m; passes up to an error of 0.01, gold up to 1e-4".
std::string facts_of(const SceneFile& file, const MetricSpec& spec) {
  const nlohmann::json& metric = file.json.at("metrics").at(spec.name);
  std::vector<std::string> facts;
  if (const std::string truth = truth_of(file, spec.name); !truth.empty()) facts.push_back(truth);
  facts.push_back(spec.unit == "1" ? "a number" : "in " + spec.unit);
  if (spec.threshold) {
    std::string judged = "passes up to an error of " + formula(metric.at("threshold"), *spec.threshold);
    if (spec.gold) judged += ", gold up to " + formula(metric.at("gold"), *spec.gold);
    facts.push_back(judged);
  } else {
    facts.emplace_back("shown, not judged");
  }
  if (spec.optional) facts.emplace_back("left out where the engine cannot tell it");
  return fmt::format("{}", fmt::join(facts, "; "));
}

std::string measure_of(const SceneFile& file, std::size_t width) {
  const MeasureEntry& measure = find_measure(file);
  std::string text = "\nMeasure:\n" + entry(measure.name, measure.doc, name_width, width);
  std::vector<std::string> arguments;
  for (const auto& [key, value] : file.json.at("measure").items())
    if (key != "kind" && !value.is_object())
      arguments.push_back(key + " " + (value.is_string() ? value.get<std::string>() : value.dump()));
  if (!arguments.empty()) text += entry("", fmt::format("{}", fmt::join(arguments, ", ")), name_width, width);
  return text;
}

std::string needs_of(const SceneFile& file) {
  std::vector<std::string> needs;
  for (std::size_t bit = 0; bit < need_words().size(); ++bit)
    if ((file.needs >> bit & 1) != 0) needs.push_back(need_words()[bit]);
  return needs.empty() ? "nothing" : fmt::format("{}", fmt::join(needs, ", "));
}

std::string size_of(const Scene& scene) {
  return fmt::format("{:.0f} of {:g} s, {:g} s in all", std::ceil(scene.seconds / scene.dt - 1e-6), scene.dt,
                     scene.seconds);
}

/// By its id where that names it, else by its file.
std::string example_of(const SceneFile& file) {
  const std::vector<std::string> known = scene_words();
  const bool is_known = std::find(known.begin(), known.end(), file.id) != known.end();
  std::string line = "plumb run " + (is_known ? file.id : file.path.string());
  if (!file.parameters.empty())
    line += " --param " + file.parameters.front().name + "=" + text_of(file.parameters.front().default_value);
  return line;
}

}  // namespace

std::string scene_sheet(const SceneFile& file, std::size_t width) {
  const Scene scene = file.instantiate(file.variants.front());
  std::string text =
      fmt::format("{} {}/{}: {}{}\n", file.id, file.group, file.slug, file.title, file.core ? " (core)" : "");
  const std::size_t truth = std::min(file.doc.find("Truth"), file.doc.size());
  text += wrapped(file.doc.substr(0, truth), 2, width) + "\n";
  if (truth < file.doc.size()) text += wrapped(file.doc.substr(truth), 2, width) + "\n";
  text += "\n" + entry("file", file.path.string(), name_width, width);
  text += entry("needs", needs_of(file), name_width, width);
  text += entry("steps", size_of(scene), name_width, width);
  text += entry("bodies, joints", fmt::format("{}, {}", scene.bodies.size(), scene.joints.size()), name_width, width);
  if (!file.parameters.empty()) text += "\nParameters, for --param name=value:\n";
  for (const ParameterSpec& spec : file.parameters)
    text += entry(spec.name, spec.doc, name_width, width) + entry("", facts_of(spec), name_width, width);
  if (file.variants.size() > 1) {
    text += "\nVariants, which run when no parameter is given:\n";
    for (const Parameters& variant : file.variants) text += wrapped(text_of(variant), 2, width) + "\n";
  }
  text += measure_of(file, width);
  text += "\nMetrics:\n";
  for (const MetricSpec& spec : file.metrics)
    text += entry(spec.name, spec.doc, name_width, width) + entry("", facts_of(file, spec), name_width, width);
  return text + "\nExample:\n  " + example_of(file) + "\n";
}

}  // namespace plumb::harness
