#include "study/cost.hpp"

#include <algorithm>

namespace plumb::harness {

namespace {

std::string scene_key(const std::string& scene, const Json& params) { return scene + params.dump(); }

Json without_seed(Json params) {
  params.erase("seed");
  return params;
}

double member(const Json& json, const std::string& name) {
  const auto found = json.find(name);
  return found != json.end() && found->is_number() ? found->get<double>() : 0;
}

/// How many times the work of the defaults the settings ask for, by the knobs that count passes.
double effort(const Json& settings, const Json& defaults, const std::vector<std::string>& knobs) {
  double factor = 1;
  for (const std::string& knob : knobs) {
    const double value = member(settings, knob), standard = member(defaults, knob);
    if (value > 0 && standard > 0 && settings[knob].is_number_integer()) factor *= std::max(1.0, value / standard);
  }
  return factor;
}

}  // namespace

void CostModel::learn(const Row& row) {
  const double wall = row.time.wall_s.value_or(0), repeats = row.time.repeats.value_or(0);
  if (!(wall > 0) || !(repeats > 0)) return;
  sum_ += wall / repeats;
  count_ += 1;
  const double steps = row.seconds.value_or(0) / std::max(1e-9, row.dt.value_or(0));
  Json defaults = row.settings;
  defaults.update(row.engine.defaults);
  const double unit = wall / repeats / std::max(1.0, steps) / effort(row.settings, defaults, row.engine.knobs);
  const std::string scene = scene_key(row.scene, without_seed(row.params));
  for (const std::string& key : {scene, scene + row.backend}) {
    steps_[key].sum += unit;
    steps_[key].count += 1;
  }
}

std::optional<double> CostModel::seconds(const Cell& cell) const {
  const std::string scene = scene_key(cell.scene->id, without_seed(json_of(cell.shown)));
  auto found = steps_.find(scene + cell.backend->name);
  if (found == steps_.end()) found = steps_.find(scene);
  if (found == steps_.end()) return std::nullopt;
  Json defaults = Json::object();
  std::vector<std::string> knobs;
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
