#include "reduce/plain_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <set>

#include "base/format.hpp"
#include "convert/scene_text.hpp"

namespace plumb::harness {
namespace {

using Pointer = Json::json_pointer;

Json json_of(const MetricSpec& metric) {
  Json json{{"unit", metric.unit}, {"doc", metric.doc}};
  if (metric.optional) json["optional"] = true;
  if (metric.threshold) json["threshold"] = *metric.threshold;
  if (metric.gold) json["gold"] = *metric.gold;
  return json;
}

std::set<std::string> names_of(const Json& things) {
  std::set<std::string> names;
  for (const Json& thing : things) names.insert(thing.at("name").get<std::string>());
  return names;
}

/// Drops those of a list, or of an object's members, for which `goes` holds.
void drop(Json& things, const std::function<bool(const Json&)>& goes) {
  for (auto at = things.begin(); at != things.end();) at = goes(*at) ? things.erase(at) : std::next(at);
}

bool names_one_outside(const Json& thing, const char* key, const std::set<std::string>& known) {
  const auto name = thing.find(key);
  return name != thing.end() && name->is_string() && !known.contains(name->get<std::string>());
}

void drop_shapes_of_nobody(Json& scene) {
  if (!scene.contains("shapes")) return;
  std::set<std::string> used;
  for (const Json& body : scene["bodies"])
    if (body.contains("shape")) used.insert(body["shape"].get<std::string>());
  for (const auto& [name, shape] : scene["shapes"].items())
    if (used.contains(name) && shape.contains("children"))
      for (const Json& child : shape["children"]) used.insert(child["shape"].get<std::string>());
  Json kept = Json::object();
  for (const auto& [name, shape] : scene["shapes"].items())
    if (used.contains(name)) kept[name] = shape;
  scene["shapes"] = kept;
  if (kept.empty()) scene.erase("shapes");
}

void drop_quantities_of_the_gone(Json& scene, const std::set<std::string>& bodies,
                                 const std::set<std::string>& joints) {
  if (!scene["measure"].contains("quantities")) return;
  Json& quantities = scene["measure"]["quantities"];
  drop(quantities, [&](const Json& one) {
    if (names_one_outside(one, "body", bodies) || names_one_outside(one, "joint", joints)) return true;
    return one.contains("pair") && std::any_of(one["pair"].begin(), one["pair"].end(), [&](const Json& name) {
             return !bodies.contains(name.get<std::string>());
           });
  });
  Json metrics = Json::object();
  for (const auto& [name, metric] : scene["metrics"].items())
    if (quantities.contains(name)) metrics[name] = metric;
  scene["metrics"] = metrics;
}

}  // namespace

Json plain_scene(const Scene& scene, const SceneFile& file) {
  std::string id = file.id;
  if (std::isalpha(static_cast<unsigned char>(id.back())) != 0) id.pop_back();
  Json json = scene_json(scene, {id + "r", file.slug, file.title, file.doc});
  json["metrics"] = Json::object();
  for (const MetricSpec& metric : scene.metrics) json["metrics"][metric.name] = json_of(metric);
  json["measure"] = {{"kind", scene.measure}};
  for (const auto& [name, argument] : scene.measure_args.items()) json["measure"][name] = argument;
  if (json["measure"].contains("quantities")) {
    Json measured = Json::object();
    for (const auto& [name, quantity] : json["measure"]["quantities"].items())
      if (json["metrics"].contains(name)) measured[name] = quantity;
    json["measure"]["quantities"] = measured;
  }
  return json;
}

std::vector<std::vector<Pointer>> parts_of(const Json& scene) {
  // Without these a body or a joint would be none, or another.
  static const std::set<std::string> essential{"name",
                                               "type",
                                               "body",
                                               "body_a",
                                               "body_b",
                                               "frame_a",
                                               "frame_b",
                                               "shape",
                                               "position",
                                               "orientation",
                                               "motion",
                                               "mass",
                                               "inertia",
                                               "density",
                                               "axis_modes",
                                               "rest_length",
                                               "ratio",
                                               "centre_of_mass",
                                               "inertia_orientation"};
  static const std::set<std::string> by_axis{"limits", "motors", "springs", "targets"};
  std::vector<Pointer> quantities, bodies, joints, rest;
  const auto add_rest = [&](const Pointer& place, const Json& thing) {
    for (const auto& [key, value] : thing.items()) {
      if (key == "limits" && thing.value("type", "") == "generic") continue;  // its modes ask for them
      if (by_axis.contains(key))
        for (const auto& axis : value.items()) rest.push_back(place / key / axis.key());
      else if (!essential.contains(key))
        rest.push_back(place / key);
    }
  };
  const auto each = [&](const char* list, const std::function<void(const Pointer&, const Json&)>& take) {
    if (!scene.contains(list)) return;
    for (std::size_t i = 0; i < scene[list].size(); ++i) take(Pointer() / list / i, scene[list][i]);
  };
  if (scene["measure"].contains("quantities"))
    for (const auto& quantity : scene["measure"]["quantities"].items())
      quantities.push_back(Pointer() / "measure" / "quantities" / quantity.key());
  each("host", [&](const Pointer& place, const Json&) { rest.push_back(place); });
  each("bodies", [&](const Pointer& place, const Json& body) {
    bodies.push_back(place);
    add_rest(place, body);
  });
  each("joints", [&](const Pointer& place, const Json& joint) {
    joints.push_back(place);
    add_rest(place, joint);
  });
  return {quantities, bodies, joints, rest};
}

Json without(const Json& scene, const std::vector<Pointer>& parts) {
  Json less = scene;
  static const Json gone = "gone";  // places in lists stay what they are until all are known
  for (const Pointer& part : parts) {
    const Pointer parent = part.parent_pointer();
    if (less.at(parent).is_array()) {
      less[part] = gone;
      continue;
    }
    less.at(parent).erase(part.back());
    if (less.at(parent).empty()) less.at(parent.parent_pointer()).erase(parent.back());
  }
  for (const char* list : {"bodies", "joints", "host"})
    if (less.contains(list)) drop(less[list], [](const Json& thing) { return thing == gone; });
  const std::set<std::string> bodies = names_of(less["bodies"]);
  if (less.contains("joints"))
    drop(less["joints"], [&](const Json& joint) {
      return names_one_outside(joint, "body_a", bodies) || names_one_outside(joint, "body_b", bodies);
    });
  const std::set<std::string> joints = less.contains("joints") ? names_of(less["joints"]) : std::set<std::string>();
  if (less.contains("host"))
    drop(less["host"], [&](const Json& action) {
      return names_one_outside(action, "body", bodies) || names_one_outside(action, "joint", joints);
    });
  for (const char* list : {"joints", "host"})
    if (less.contains(list) && less[list].empty()) less.erase(list);
  drop_shapes_of_nobody(less);
  drop_quantities_of_the_gone(less, bodies, joints);
  return less;
}

std::string size_text(const Json& scene) {
  const auto count = [&](const char* list, const char* one, const char* many) {
    const std::size_t number = scene.contains(list) ? scene[list].size() : 0;
    return fmt::format("{} {}", number, number == 1 ? one : many);
  };
  return fmt::format("{}, {}, {} s", count("bodies", "body", "bodies"), count("joints", "joint", "joints"),
                     short_number(scene.at("seconds").get<double>()));
}

}  // namespace plumb::harness
