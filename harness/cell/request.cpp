#include "cell/request.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>

#include "base/locate.hpp"
#include "cell/cell.hpp"
#include "cell/description.hpp"
#include "measure/registry/registry.hpp"
#include "scene/build.hpp"
#include "simulation/names.hpp"
#include "simulation/part_refused.hpp"

namespace plumb::harness {

namespace {

// "scene+sleeping+ccd": the scene's needs and these.
PlumbNeeds needs_beside(const std::string& asked) {
  PlumbNeeds needs = 0;
  for (std::size_t at = asked.find('+'); at != std::string::npos;) {
    const std::size_t next = asked.find('+', at + 1);
    const std::string word = asked.substr(at + 1, next == std::string::npos ? next : next - at - 1);
    const auto found = std::find(need_words().begin(), need_words().end(), word);
    if (found == need_words().end()) throw Error(PLUMB_E_INVALID_ARGUMENT, "there is no need " + word);
    needs |= PlumbNeeds{1} << (found - need_words().begin());
    at = next;
  }
  return needs;
}

/// Whether an entry of a scene file, by its "name", is where the name comes from: "ball{i}" is where "ball7" does.
bool gives_name(const std::string& entry, const std::string& name) {
  const auto open = entry.find('{'), close = entry.rfind('}');
  if (open == std::string::npos || close == std::string::npos) return entry == name;
  return name.starts_with(entry.substr(0, open)) && name.ends_with(entry.substr(close + 1));
}

/// "FILE:LINE: " of a part of the scene, of its list where it was generated.
std::string place_of(const SceneFile& file, const PartRefused& refused) {
  JsonPath path{refused.list()};
  const auto list = file.json.find(refused.list());
  if (list != file.json.end() && list->is_object()) path.emplace_back(refused.name());
  if (list != file.json.end() && list->is_array()) {
    for (std::size_t i = 0; i < list->size(); ++i) {
      if (!gives_name((*list)[i].value("name", ""), refused.name())) continue;
      path.emplace_back(i);
      break;
    }
  }
  return fmt::format("{}:{}: ", file.path.string(), line_of(file.text, path));
}

Outcome outcome_of(const Error& error, const std::string& said) {
  if (error.code() == PLUMB_E_UNSUPPORTED) return {"unsupported", said};
  if (error.code() == PLUMB_E_OUT_OF_MEMORY) return {"out_of_memory", said};
  return {"error", result_word(error.code()) + ": " + said};
}

}  // namespace

SceneFile scene_file_of(const Json& request) {
  SceneFile file = SceneFile::load(request.at("scene").get<std::string>());
  if (fmt::format("{:016x}", file.hash) != request.at("scene_hash").get<std::string>())
    throw UsageError(file.path.string() + ":1: this scene file has changed since the program was started; start again");
  return file;
}

Scene scene_of(const SceneFile& file, const Json& request) {
  Parameters parameters;
  for (const auto& [name, value] : request.at("parameters").items()) {
    if (value.is_string()) {
      parameters[name] = value.get<std::string>();
    } else {
      parameters[name] = value.get<double>();
    }
  }
  Scene scene = instantiate_with(file, parameters, request.at("dt").get<double>(), request.at("seconds").get<double>());
  check_measure(file, scene);
  if (!scene.lacks.empty()) throw Error(PLUMB_E_UNSUPPORTED, scene.lacks);
  scene.needs |= needs_beside(request.at("needs").get<std::string>());
  return scene;
}

SimulationOptions options_of(const Backend& backend, const Json& request) {
  SimulationOptions options;
  options.threads = request.at("threads");
  options.needs_all = request.at("needs") == "all";
  for (const PlumbSettingInfo* info : backend.settings()) {
    const auto asked = request.at("settings").find(info->name);
    if (asked != request.at("settings").end()) options.settings.emplace_back(info->name, setting_value(*info, *asked));
  }
  return options;
}

Outcome outcome_of(const std::optional<SceneFile>& file, const std::function<void()>& work) {
  try {
    work();
    return {};
  } catch (const UsageError& error) {
    return {wrong_scene, error.what()};
  } catch (const PartRefused& refused) {
    return outcome_of(refused, place_of(*file, refused) + refused.what());
  } catch (const Error& error) {
    return outcome_of(error, error.what());
  } catch (const std::bad_alloc&) {
    return {"out_of_memory", "the process could not allocate memory"};
  } catch (const std::exception& error) {
    return {"error", error.what()};
  }
}

}  // namespace plumb::harness
