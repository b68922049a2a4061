#include "measure/instruments/args.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace plumb::harness {
namespace {

const nlohmann::json& find(const Scene& scene, std::string_view name, bool right_kind(const nlohmann::json&),
                           const char* kind) {
  const auto found = scene.measure_args.find(name);
  if (found == scene.measure_args.end())
    throw UsageError(fmt::format("scene {}: measure {} needs the argument \"{}\"", scene.id, scene.measure, name));
  if (!right_kind(*found))
    throw UsageError(fmt::format("scene {}: argument \"{}\" of measure {} must be {}, not {}", scene.id, name,
                                 scene.measure, kind, found->dump()));
  return *found;
}

}  // namespace

void fail_at(const SceneFile& file, const JsonPath& path, const std::string& sentence) {
  throw UsageError(fmt::format("{}:{}: {}", file.path.string(), line_of(file.text, path), sentence));
}

double arg_number(const Scene& scene, std::string_view name) {
  const auto is_number = [](const nlohmann::json& value) { return value.is_number(); };
  return find(scene, name, is_number, "a number (an expression starts with =)").get<double>();
}

const std::string& arg_text(const Scene& scene, std::string_view name) {
  const auto is_text = [](const nlohmann::json& value) { return value.is_string(); };
  return find(scene, name, is_text, "a string").get_ref<const std::string&>();
}

std::vector<double> arg_numbers(const Scene& scene, std::string_view name) {
  const auto is_list = [](const nlohmann::json& value) {
    return value.is_array() && std::all_of(value.begin(), value.end(), [](const auto& e) { return e.is_number(); });
  };
  return find(scene, name, is_list, "an array of numbers").get<std::vector<double>>();
}

std::size_t arg_body(const Scene& scene, std::string_view name) { return scene.body(arg_text(scene, name)); }
std::size_t arg_joint(const Scene& scene, std::string_view name) { return scene.joint(arg_text(scene, name)); }

std::vector<std::size_t> arg_bodies(const Scene& scene, std::string_view name) {
  const std::string& prefix = arg_text(scene, name);
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
    const std::string& body = scene.bodies[i].name;
    if (body.size() > prefix.size() && body.starts_with(prefix) &&
        body.find_first_not_of("0123456789", prefix.size()) == std::string::npos)
      indices.push_back(i);
  }
  if (indices.empty())
    throw UsageError(fmt::format("scene {}: no bodies are named {}0, {}1 ...", scene.id, prefix, prefix));
  return indices;
}

}  // namespace plumb::harness
