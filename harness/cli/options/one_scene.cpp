#include "cli/options/one_scene.hpp"

#include "scene/catalogue.hpp"
#include "scene/parameters.hpp"

namespace plumb::harness {

SceneFile one_scene_file(const std::string& name) {
  std::vector<SceneFile> files = find_scenes(name);
  if (files.size() != 1) throw UsageError("\"" + name + "\" names several scenes: name one, as in D7");
  return std::move(files.front());
}

Scene one_scene(const SceneFile& file, const std::vector<std::string>& parameters, const Times& times) {
  Parameters values = file.variants.front();
  for (const std::string& given : parameters) {
    const std::size_t equals = given.find('=');
    if (equals == std::string::npos) throw UsageError("--param \"" + given + "\" is not name=value");
    const ParameterSpec& spec = find_parameter(file, given.substr(0, equals));
    values[spec.name] = parse_parameter(spec, given.substr(equals + 1));
  }
  return file.instantiate(values, times);
}

}  // namespace plumb::harness
