#include "cli/live/page_worlds.hpp"

#include <optional>

#include "cell/cell.hpp"
#include "cli/live/engine_file.hpp"
#include "replay/live_world.hpp"
#include "replay/title.hpp"
#include "scene/catalogue.hpp"

namespace plumb::harness {

namespace {

Parameters parameters_of(const Json& params) {
  Parameters parameters;
  for (const auto& [name, value] : params.items()) {
    if (value.is_string())
      parameters[name] = value.get<std::string>();
    else
      parameters[name] = value.get<double>();
  }
  return parameters;
}

std::optional<PageWorld> world_of_recording(const Json& header) {
  try {
    const std::vector<SceneFile> files = find_scenes(header.at("scene").get<std::string>());
    const Json params = header.value("params", Json::object());
    const Scene scene = instantiate_with(files.at(0), parameters_of(params), header.at("dt").get<double>(),
                                         header.at("seconds").get<double>());
    if (scene.bodies.size() != header.at("bodies").size()) return std::nullopt;
    return page_world(scene, {{"title", header.value("title", "")}, {"params", params}}, Json::object());
  } catch (const UsageError&) {
    return std::nullopt;
  }
}

}  // namespace

PageWorld page_world(const Scene& scene, const Json& about, const Json& settings) {
  if (!scene.lacks.empty()) throw UsageError(scene.lacks);
  Json world = live_world(scene);
  world["header"].update(about);
  world["settings"] = settings;
  return {replay_title(world["header"]), line_of(world)};
}

PageWorlds worlds_of_recordings(const std::vector<Json>& headers) {
  PageWorlds worlds;
  const std::filesystem::path engine = find_engine_file();
  if (engine.empty()) return worlds;
  for (const Json& header : headers)
    if (std::optional<PageWorld> world = world_of_recording(header)) worlds.list.push_back(std::move(*world));
  if (!worlds.list.empty()) worlds.engine = read_engine(engine);
  return worlds;
}

}  // namespace plumb::harness
