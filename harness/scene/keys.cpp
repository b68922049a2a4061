// The words of scene files. scene.schema.json lists the same ones, which a test compares.
#include <fmt/format.h>

#include <algorithm>

#include "plumb/nearest.hpp"
#include "scene/build.hpp"

namespace plumb::harness {

const std::map<std::string, std::vector<std::string>>& scene_keys() {
  static const std::map<std::string, std::vector<std::string>> keys{
      {"",
       {"$schema", "id", "slug", "title", "doc", "core", "parameters", "variants", "let", "needs", "gravity", "dt",
        "seconds", "shapes", "bodies", "joints", "host", "measure", "metrics"}},
      {"parameter", {"default", "unit", "doc", "minimum", "maximum", "integer", "choices"}},
      {"definition", {"name", "value"}},
      {"metric", {"unit", "doc", "when", "optional", "threshold", "gold"}},
      {"shape",
       {"type", "radius", "half_height", "half_extents", "vertices", "indices", "grid", "height", "model", "heights",
        "spacing", "materials", "triangle_materials", "children", "user_data"}},
      {"triangle_material", {"friction", "restitution"}},
      {"model", {"file", "package", "licence", "size", "orientation", "corners"}},
      {"child", {"repeat", "when", "shape", "position", "orientation", "friction", "restitution", "surface_velocity"}},
      {"filter", {"category", "mask", "group"}},
      {"body",
       {"name",
        "repeat",
        "when",
        "motion",
        "shape",
        "position",
        "orientation",
        "linear_velocity",
        "angular_velocity",
        "flags",
        "locks",
        "density",
        "mass",
        "inertia",
        "centre_of_mass",
        "inertia_orientation",
        "friction",
        "restitution",
        "surface_velocity",
        "gravity_scale",
        "linear_damping",
        "angular_damping",
        "rolling_friction",
        "spinning_friction",
        "filter",
        "user_data"}},
      {"generator", {"generate", "count", "seed", "friction"}},
      {"frame", {"position", "orientation"}},
      {"limit", {"lower", "upper"}},
      {"motor", {"target_velocity", "max_force"}},
      {"spring", {"rest", "frequency", "damping_ratio", "stiffness", "damping"}},
      {"joint",
       {"name",
        "repeat",
        "when",
        "type",
        "body_a",
        "body_b",
        "anchor",
        "anchor_orientation",
        "frame_a",
        "frame_b",
        "collide_connected",
        "axis_modes",
        "limits",
        "motors",
        "springs",
        "rest_length",
        "ratio",
        "break_force",
        "break_torque",
        "cut",
        "user_data"}},
      {"action",
       {"body", "joint", "repeat", "when", "at", "over", "position", "turn", "force", "torque", "impulse",
        "angular_impulse", "motors", "targets"}},
      {"turn", {"axis", "radians"}},
      {"motor_over_time", {"target_velocity", "max_force"}},
  };
  return keys;
}

const std::vector<std::string>& need_words() {
  static const std::vector<std::string> words{
      "rotation",         "collision",       "friction", "restitution",          "joints",          "ccd",
      "sleeping",         "events",          "contacts", "contact_impulses",     "sensors",         "kinematic",
      "gyroscopic",       "damping",         "forces",   "axis_locks",           "filters",         "queries",
      "surface_velocity", "joint_reactions", "snapshot", "contact_modification", "rolling_friction"};
  static_assert(PLUMB_NEED_COUNT == 23);
  return words;
}

const std::vector<std::string>& shape_words() {
  static const std::vector<std::string> words{"sphere",        "box",          "capsule", "cylinder", "convex_hull",
                                              "triangle_mesh", "height_field", "plane",   "compound"};
  static_assert(PLUMB_SHAPE_TYPE_COUNT == 9);
  return words;
}

const std::vector<std::string>& joint_words() {
  static const std::vector<std::string> words{"ball",      "hinge",   "slider",      "distance", "fixed",
                                              "universal", "generic", "swing_twist", "gear",     "rack_and_pinion"};
  static_assert(PLUMB_JOINT_TYPE_COUNT == 10);
  return words;
}

void add_name(const Node& place, const std::string& what, const std::string& name,
              std::unordered_map<std::string, std::size_t>& index, std::size_t value) {
  if (name.empty()) place.fail(fmt::format("a {} needs a name", what));
  if (!index.emplace(name, value).second) place.fail(fmt::format("a second {} is named \"{}\"", what, name));
}

std::size_t find_name(const Node& place, const std::string& what,
                      const std::unordered_map<std::string, std::size_t>& index) {
  const std::string name = place.name();
  const auto found = index.find(name);
  if (found != index.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [other, ignored] : index) known.push_back(other);
  std::sort(known.begin(), known.end());
  place.fail_unknown(what, name, known);
}

}  // namespace plumb::harness
