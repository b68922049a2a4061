// Scene files: reading, checking, and giving parameters their values.
#include <fmt/format.h>

#include "plumb/nearest.hpp"
#include "scene/build.hpp"
#include "scene/json_file.hpp"
#include "scene/parameters.hpp"
#include "scene/units.hpp"

namespace plumb::harness {
namespace {

/// FNV-1a, 64 bits (Fowler, Noll, Vo).
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

std::string read_unit(const Node& node) {
  std::string unit = node.text();
  try {
    static_cast<void>(conversion(unit, unit));
  } catch (const std::invalid_argument& error) {
    node.fail(error.what());
  }
  return unit;
}

ParameterSpec read_parameter(const std::string& name, const Node& node) {
  node.only(scene_keys().at("parameter"));
  ParameterSpec spec;
  spec.name = name;
  spec.doc = node.at("doc").text();
  if (const auto unit = node.find("unit")) spec.unit = read_unit(*unit);
  if (const auto choices = node.find("choices")) {
    for (const Node& choice : choices->elements()) spec.choices.push_back(choice.text());
    for (const char* key : {"minimum", "maximum", "integer", "unit"})
      if (const auto stray = node.find(key)) stray->fail(fmt::format("a word has no {}", key));
    spec.default_value = node.at("default").text();
  } else {
    if (const auto minimum = node.find("minimum")) spec.minimum = minimum->number();
    if (const auto maximum = node.find("maximum")) spec.maximum = maximum->number();
    if (const auto integer = node.find("integer")) spec.integer = integer->boolean();
    if (spec.unit.empty()) spec.unit = "1";
    spec.default_value = node.at("default").number();
  }
  try {
    check_parameter(spec, spec.default_value);
  } catch (const UsageError& error) {
    node.at("default").fail(error.what());
  }
  return spec;
}

const ParameterSpec& known_parameter(const SceneFile& file, const Node& place, const std::string& name) {
  try {
    return find_parameter(file, name);
  } catch (const UsageError& error) {
    place.fail(error.what());
  }
}

ParameterValue read_override(const ParameterSpec& spec, const Node& node) {
  ParameterValue value;
  if (spec.choices.empty())
    value = node.number();
  else
    value = node.text();
  try {
    check_parameter(spec, value);
  } catch (const UsageError& error) {
    node.fail(error.what());
  }
  return value;
}

/// One entry of variants: an override each, or all combinations of a sweep.
void read_variant(const SceneFile& file, const Node& node, std::vector<Parameters>& variants) {
  const auto sweep = node.find("sweep");
  std::vector<Parameters> combinations{{}};
  if (sweep) {
    node.only({"sweep"});
    for (const auto& [name, values] : sweep->members()) {
      const ParameterSpec& spec = known_parameter(file, values, name);
      std::vector<Parameters> grown;
      for (const Parameters& combination : combinations) {
        for (const Node& value : values.elements()) {
          grown.push_back(combination);
          grown.back()[name] = read_override(spec, value);
        }
      }
      combinations = std::move(grown);
      if (combinations.empty() || combinations.size() > 10000) values.fail("a sweep makes 1 to 10000 cells");
    }
  } else {
    for (const auto& [name, value] : node.members())
      combinations[0][name] = read_override(known_parameter(file, value, name), value);
  }
  variants.insert(variants.end(), combinations.begin(), combinations.end());
}

std::vector<MetricSpec> read_metrics(const Node& metrics) {
  std::vector<MetricSpec> specs;
  for (const auto& [name, node] : metrics.members()) {
    node.only(scene_keys().at("metric"));
    if (const auto when = node.find("when"); when && when->number() == 0) continue;
    MetricSpec spec;
    spec.name = name;
    spec.unit = read_unit(node.at("unit"));
    spec.doc = node.at("doc").text();
    if (const auto optional = node.find("optional")) spec.optional = optional->boolean();
    if (const auto threshold = node.find("threshold")) spec.threshold = threshold->number();
    if (const auto gold = node.find("gold")) {
      spec.gold = gold->number();
      if (!spec.threshold || *spec.threshold < *spec.gold) gold->fail("gold needs a threshold that is not below it");
    }
    specs.push_back(std::move(spec));
  }
  return specs;
}

/// Names for expressions, each of which may use those before it.
void read_definitions(const Node& definitions, Expressions& expressions) {
  for (const Node& node : definitions.elements()) {
    node.only(scene_keys().at("definition"));
    const std::string name = node.at("name").text();
    if (expressions.has(name)) node.fail(fmt::format("\"{}\" is the name of something else already", name));
    expressions.set(name, node.at("value").number());
  }
}

/// Whether an expression waits for the time t, which measures give it.
bool waits_for_time(const Node& node, const std::string& expression) {
  return !node.expressions().has("t") && Expressions::uses(expression, "t");
}

/// Arguments of a measure: strings that start with = become numbers, those of the time t {"expression", "names"} with
/// all that it may use besides t; {} in others is replaced.
nlohmann::json resolve(const Node& node) {
  nlohmann::json out = node.json();
  if (node.json().is_object()) {
    for (const auto& [key, member] : node.members()) out[key] = resolve(member);
  } else if (node.json().is_array()) {
    std::size_t i = 0;
    for (const Node& element : node.elements()) out[i++] = resolve(element);
  } else if (node.json().is_string() && node.text().starts_with("=")) {
    try {
      const std::string expression = node.text().substr(1);
      if (waits_for_time(node, expression))
        out = {{"expression", expression}, {"names", node.expressions().values()}};
      else
        out = node.expressions().evaluate(expression);
    } catch (const std::invalid_argument& error) {
      node.fail(error.what());
    }
  } else if (node.json().is_string()) {
    out = node.name();
  }
  return out;
}

}  // namespace

SceneFile SceneFile::load(const std::filesystem::path& path) {
  SceneFile file;
  file.path = path;
  file.text = read_json_text(path, "scene");
  file.json = parse_json(path, file.text);
  file.hash = hash_of(file.text);
  file.group = std::filesystem::absolute(path).parent_path().filename().string();
  Expressions expressions;
  const Node root(file, file.json, expressions);
  root.only(scene_keys().at(""));
  file.id = root.at("id").text();
  file.slug = root.at("slug").text();
  file.title = root.at("title").text();
  file.doc = root.at("doc").text();
  if (const auto core = root.find("core")) file.core = core->boolean();
  file.needs = root.at("needs").bits("need", need_words());
  if (const auto parameters = root.find("parameters"))
    for (const auto& [name, node] : parameters->members()) file.parameters.push_back(read_parameter(name, node));
  if (const auto variants = root.find("variants")) {
    for (const Node& node : variants->elements()) read_variant(file, node, file.variants);
    if (file.variants.empty()) variants->fail("variants has at least one entry, or is left out");
  } else {
    file.variants.emplace_back();
  }
  file.metrics = file.instantiate({}).metrics;
  return file;
}

Scene SceneFile::instantiate(const Parameters& given) const {
  Expressions expressions;
  SceneBuilder builder;
  Scene& scene = builder.scene;
  for (const auto& [name, value] : given) check_parameter(find_parameter(*this, name), value);
  for (const ParameterSpec& spec : parameters) {
    const auto found = given.find(spec.name);
    const ParameterValue& value = found != given.end() ? found->second : spec.default_value;
    scene.parameters[spec.name] = value;
    for (const std::string& choice : spec.choices) expressions.add_word(choice);
    if (const auto* word = std::get_if<std::string>(&value))
      expressions.set_word(spec.name, *word);
    else
      expressions.set(spec.name, std::get<double>(value));
  }
  const Node root(*this, json, expressions);
  if (const auto definitions = root.find("let")) read_definitions(*definitions, expressions);
  scene.id = id;
  scene.slug = slug;
  scene.group = group;
  scene.needs = needs;
  scene.gravity = root.vector_or("gravity", scene.gravity);
  scene.dt = root.number_or("dt", scene.dt);
  scene.seconds = root.at("seconds").number();
  if (!(scene.dt > 0)) root.at("dt").fail(fmt::format("dt must be above 0, not {}", scene.dt));
  if (!(scene.seconds > 0)) root.at("seconds").fail(fmt::format("seconds must be above 0, not {}", scene.seconds));
  if (const auto shapes = root.find("shapes")) read_shapes(*shapes, builder);
  read_bodies(root.at("bodies"), builder);
  if (const auto joints = root.find("joints")) read_joints(*joints, builder);
  const Node measure_node = root.at("measure");
  scene.measure = measure_node.at("kind").text();
  expressions.set("dt", scene.dt);
  expressions.set("seconds", scene.seconds);
  scene.measure_args = resolve(measure_node);
  scene.measure_args.erase("kind");
  scene.metrics = read_metrics(root.at("metrics"));
  return scene;
}

}  // namespace plumb::harness
