#include "study/cost.hpp"

#include <algorithm>

namespace plumb::harness {

namespace {

std::string scene_key(const Json& scene, const Json& params) { return scene.dump() + params.dump(); }

Json without_seed(Json params) {
  if (params.is_object()) params.erase("seed");
  return params;
}

double member(const Json& json, const char* name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_number() ? found->get<double>() : 0;
}

/// How many times the work of the defaults the settings ask for, by the knobs that count passes.
double effort(const Json& settings, const Json& defaults, const Json& knobs) {
  double factor = 1;
  for (const Json& knob : knobs) {
    const double value = member(settings, knob.get_ref<const std::string&>().c_str());
    const double standard = member(defaults, knob.get_ref<const std::string&>().c_str());
    if (value > 0 && standard > 0 && settings[knob.get<std::string>()].is_number_integer())
      factor *= std::max(1.0, value / standard);
  }
  return factor;
}

}  // namespace

void CostModel::learn(const Json& row) {
  const auto time = row.find("time");
  const double wall = time == row.end() ? 0 : member(*time, "wall_s"), repeats = member(row, "repeats");
  if (!(wall > 0) || !(repeats > 0)) return;
  sum_ += wall / repeats;
  count_ += 1;
  const double steps = member(row, "seconds") / std::max(1e-9, member(row, "dt"));
  Json defaults = row.value("settings", Json::object());
  defaults.update(row.value("defaults", Json::object()));
  const double unit = wall / repeats / std::max(1.0, steps) /
                      effort(row.value("settings", Json::object()), defaults, row.value("knobs", Json::array()));
  const std::string scene = scene_key(row["scene"], without_seed(row.value("params", Json::object())));
  for (const std::string& key : {scene, scene + row.value("backend", "")}) {
    steps_[key].sum += unit;
    steps_[key].count += 1;
  }
}

std::optional<double> CostModel::seconds(const Cell& cell) const {
  const std::string scene = scene_key(cell.scene->id, without_seed(json_of(cell.shown)));
  auto found = steps_.find(scene + cell.backend->name);
  if (found == steps_.end()) found = steps_.find(scene);
  if (found == steps_.end()) return std::nullopt;
  Json defaults = Json::object(), knobs = Json::array();
  for (const SettingDescription& setting : cell.backend->settings) {
    defaults[setting.name] = setting.default_value;
    if (setting.role == "quality") knobs.push_back(setting.name);
  }
  Json settings = defaults;
  settings.update(cell.settings);
  const double steps = std::max(1.0, cell.seconds / cell.dt);
  return found->second.sum / found->second.count * steps * effort(settings, defaults, knobs);
}

}  // namespace plumb::harness
