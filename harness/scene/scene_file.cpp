// Scene files: reading, checking, and giving parameters their values.
#include <fmt/format.h>

#include <algorithm>
#include <regex>

#include "base/shown.hpp"
#include "base/units.hpp"
#include "plumb/nearest.hpp"
#include "scene/build.hpp"
#include "scene/json_file.hpp"
#include "scene/limits.hpp"
#include "scene/parameters.hpp"

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

bool is_id(const std::string& text) {
  static const std::regex pattern("[A-Z][0-9]{1,6}[a-z]?");
  return std::regex_match(text, pattern);
}
bool is_slug(const std::string& text) {
  static const std::regex pattern("[a-z][a-z0-9-]{0,63}");
  return std::regex_match(text, pattern);
}

std::string read_id(const Node& node) {
  std::string id = node.text();
  if (!is_id(id))
    node.fail(fmt::format("\"{}\" is no id: it takes a capital, digits, and perhaps a small letter, as D1 or A5b",
                          shortened(id)));
  return id;
}
std::string read_slug(const Node& node) {
  std::string slug = node.text();
  if (!is_slug(slug))
    node.fail(
        fmt::format("\"{}\" is no slug: it takes small letters, digits and -, as in four-spheres", shortened(slug)));
  return slug;
}

/// Parameters and words may not take each other's names, nor those that expressions know by themselves.
void check_parameter_names(const Node& parameters) {
  Expressions& names = parameters.expressions();
  for (const auto& [name, node] : parameters.members()) {
    node.check_new_name(name);
    names.set(name, 0);
  }
  for (const auto& [name, node] : parameters.members()) {
    const auto choices = node.find("choices");
    if (!choices) continue;
    for (const Node& choice : choices->elements()) choice.check_new_word(choice.text());
  }
  for (const auto& parameter : parameters.members()) names.erase(parameter.first);
}

ParameterSpec read_parameter(const std::string& name, const Node& node) {
  node.only(scene_keys().at("parameter"));
  ParameterSpec spec;
  spec.name = name;
  spec.doc = node.at("doc").title();
  if (const auto unit = node.find("unit")) spec.unit = read_unit(*unit);
  if (const auto choices = node.find("choices")) {
    for (const Node& choice : choices->elements()) {
      spec.choices.push_back(choice.text());
      if (std::count(spec.choices.begin(), spec.choices.end(), spec.choices.back()) > 1)
        choice.fail(fmt::format("\"{}\" is a choice already", shortened(spec.choices.back())));
    }
    if (spec.choices.empty()) choices->fail("a word has one choice or more");
    for (const char* key : {"minimum", "maximum", "integer", "unit"})
      if (const auto stray = node.find(key)) stray->fail(fmt::format("a word has no {}", key));
    spec.default_value = node.at("default").text();
  } else {
    if (const auto minimum = node.find("minimum")) spec.minimum = minimum->number();
    if (const auto maximum = node.find("maximum")) spec.maximum = maximum->number();
    if (spec.minimum && spec.maximum && *spec.minimum > *spec.maximum)
      node.at("minimum").fail(fmt::format("{:g} is above the maximum, {:g}", *spec.minimum, *spec.maximum));
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
      const std::size_t cells = combinations.size() * values.elements().size();
      if (cells == 0 || variants.size() + cells > most_cells)
        values.fail(
            fmt::format("with this the sweep makes {} cells, of 1 to {} that the variants may", cells, most_cells));
      for (const Parameters& combination : combinations) {
        for (const Node& value : values.elements()) {
          grown.push_back(combination);
          grown.back()[name] = read_override(spec, value);
        }
      }
      combinations = std::move(grown);
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
    node.check_shown_name(name);
    if (const auto when = node.find("when"); when && when->number() == 0) continue;
    MetricSpec spec;
    spec.name = name;
    spec.unit = read_unit(node.at("unit"));
    spec.doc = node.at("doc").title();
    if (const auto optional = node.find("optional")) spec.optional = optional->boolean();
    if (const auto threshold = node.find("threshold")) spec.threshold = threshold->number();
    if (spec.threshold && *spec.threshold < 0)
      node.at("threshold").fail(fmt::format("an error is never below 0, so that none is below {:g}", *spec.threshold));
    if (const auto gold = node.find("gold")) {
      spec.gold = gold->number();
      if (!spec.threshold || *spec.threshold < *spec.gold)
        gold->fail(fmt::format("gold is {:g} and needs a threshold that is not below it", *spec.gold));
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
    node.at("name").check_new_name(name);
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

/// Gives a scene file's parameters their values and reads it, part by part.
class SceneMaker {
 public:
  SceneMaker(const SceneFile& file, const Parameters& given, const Times& times)
      : file_(file), times_(times), root_(file, file.json, expressions_) {
    Scene& scene = builder_.scene;
    scene.id = file.id;
    scene.slug = file.slug;
    scene.group = file.group;
    scene.needs = file.needs;
    set_parameters(given);
    if (const auto definitions = root_.find("let")) read_definitions(*definitions, expressions_);
    scene.gravity = root_.vector_or("gravity", scene.gravity);
    set_times();
    objects_ = count_objects(root_);
  }

  /// Before take, which does without.
  void make_contents() {
    if (const auto shapes = root_.find("shapes")) read_shapes(*shapes, builder_);
    read_bodies(root_.at("bodies"), builder_);
    if (const auto joints = root_.find("joints")) read_joints(*joints, builder_);
    if (const auto host = root_.find("host")) read_host(*host, builder_);
  }

  [[nodiscard]] Scene take() {
    Scene& scene = builder_.scene;
    const Node measure = root_.at("measure");
    scene.measure = measure.at("kind").text();
    expressions_.set("dt", scene.dt);
    expressions_.set("seconds", scene.seconds);
    scene.measure_args = resolve(measure);
    scene.measure_args.erase("kind");
    scene.metrics = read_metrics(root_.at("metrics"));
    return std::move(scene);
  }

  [[nodiscard]] std::size_t objects() const { return objects_; }

 private:
  void set_parameters(const Parameters& given) {
    for (const auto& [name, value] : given) check_parameter(find_parameter(file_, name), value);
    for (const ParameterSpec& spec : file_.parameters) {
      const auto found = given.find(spec.name);
      const ParameterValue& value = found != given.end() ? found->second : spec.default_value;
      builder_.scene.parameters[spec.name] = value;
      for (const std::string& choice : spec.choices) expressions_.add_word(choice);
      if (const auto* word = std::get_if<std::string>(&value))
        expressions_.set_word(spec.name, *word);
      else
        expressions_.set(spec.name, std::get<double>(value));
    }
  }

  /// The file's time, or the one in its place; a wrong one is the file's fault or that of who asked.
  void set_times() {
    Scene& scene = builder_.scene;
    scene.dt = times_.dt ? *times_.dt : root_.number_or("dt", scene.dt);
    scene.seconds = times_.seconds ? *times_.seconds : root_.at("seconds").number();
    const auto refuse = [&](const char* key, bool asked, const std::string& sentence) {
      if (asked || !root_.find(key)) throw UsageError(fmt::format("scene {}: {}: {}", file_.id, key, sentence));
      root_.at(key).fail(sentence);
    };
    if (!(scene.dt >= least_dt && scene.dt <= most_dt))
      refuse("dt", times_.dt.has_value(),
             fmt::format("must be from {:g} to {:g} s, not {:g}", least_dt, most_dt, scene.dt));
    if (!(scene.seconds > 0))
      refuse("seconds", times_.seconds.has_value(), fmt::format("must be above 0, not {:g}", scene.seconds));
    const double steps = steps_of(scene.seconds, scene.dt);
    const bool dt_asked = times_.dt && !times_.seconds;
    const char* key = dt_asked ? "dt" : "seconds";
    const bool asked = dt_asked || times_.seconds;
    if (scene.seconds < scene.dt * (1 - 1e-6))
      refuse(key, asked,
             fmt::format("{:g} s are less than one step of {:g} s; nothing would run", scene.seconds, scene.dt));
    if (!(steps <= most_steps))
      refuse(
          key, asked,
          fmt::format(
              "{:g} s in steps of {:g} s are {:g} steps, and {:g} are the most; ask for fewer seconds or a longer dt",
              scene.seconds, scene.dt, steps, most_steps));
  }

  const SceneFile& file_;
  Times times_;
  Expressions expressions_;
  Node root_;
  SceneBuilder builder_;
  std::size_t objects_ = 0;
};

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
  file.id = read_id(root.at("id"));
  file.slug = read_slug(root.at("slug"));
  file.title = root.at("title").title();
  file.doc = root.at("doc").title();
  if (const auto core = root.find("core")) file.core = core->boolean();
  file.needs = root.at("needs").bits("need", need_words());
  if (const auto parameters = root.find("parameters")) {
    check_parameter_names(*parameters);
    for (const auto& [name, node] : parameters->members()) file.parameters.push_back(read_parameter(name, node));
  }
  if (const auto variants = root.find("variants")) {
    for (const Node& node : variants->elements()) read_variant(file, node, file.variants);
    if (file.variants.empty()) variants->fail("variants has at least one entry, or is left out");
  } else {
    file.variants.emplace_back();
  }
  file.metrics = file.outline({}).metrics;
  return file;
}

Scene SceneFile::instantiate(const Parameters& given, const Times& times) const {
  SceneMaker maker(*this, given, times);
  maker.make_contents();
  return maker.take();
}

std::size_t count_objects(const SceneFile& file, const Parameters& given, const Times& times) {
  return SceneMaker(file, given, times).objects();
}

Scene SceneFile::outline(const Parameters& given, const Times& times) const {
  SceneMaker maker(*this, given, times);
  if (maker.objects() < many_objects) maker.make_contents();
  Scene scene = maker.take();
  scene.shapes.clear();
  scene.bodies.clear();
  scene.joints.clear();
  scene.host.clear();
  return scene;
}

}  // namespace plumb::harness
