#include "cell/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "plumb/nearest.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

namespace {

constexpr std::size_t rungs_below = 2, rungs_in_all = 5;

bool is_number(const SettingDescription& setting) { return setting.type == "int" || setting.type == "float"; }
bool is_knob(const SettingDescription& setting) { return setting.role == "quality" && is_number(setting); }

bool concerns(const std::string& named, const std::string& backend) { return named.empty() || named == backend; }

bool is_fixed(const std::string& backend, const std::string& name, const std::vector<SettingRequest>& fixed) {
  return std::any_of(fixed.begin(), fixed.end(), [&](const SettingRequest& request) {
    return request.name == name && concerns(request.backend, backend);
  });
}

[[noreturn]] void refuse(const SweepAxis& axis, const std::string& why) {
  throw UsageError(fmt::format("{} {}: {}", axis.option, axis.name, why));
}

Json value_in_force(const SettingDescription& setting, const Json& asked) {
  return asked.contains(setting.name) ? asked[setting.name] : setting.default_value;
}

// A value that is in force anyway is not asked for: the cell is then the one that every other run has, too.
Json with_value(Json asked, const SettingDescription& setting, const Json& value) {
  if (value_in_force(setting, asked) != value) asked[setting.name] = value;
  return asked;
}

// Halves and doubles about a value, within the setting's range. Fewer on one side makes more on the other.
std::vector<Json> ladder_about(const SettingDescription& setting, double value) {
  const bool whole = setting.type == "int";
  const auto allowed = [&](double v) {
    return v >= std::max(setting.minimum, whole ? 1.0 : 0.0) && v <= setting.maximum;
  };
  const auto as_json = [&](double v) { return whole ? Json(static_cast<std::int64_t>(v)) : Json(v); };
  std::vector<Json> below, above;
  if (!(value > 0)) return {as_json(value)};
  for (double v = value; below.size() < rungs_in_all - 1;) {
    v = whole ? std::floor(v / 2) : v / 2;
    if (!allowed(v)) break;
    below.push_back(as_json(v));
  }
  for (double v = 2 * value; above.size() < rungs_in_all - 1 && allowed(v); v *= 2) above.push_back(as_json(v));
  const std::size_t up = std::min(above.size(), rungs_in_all - 1 - std::min(below.size(), rungs_below));
  const std::size_t down = std::min(below.size(), rungs_in_all - 1 - up);
  std::vector<Json> rungs{as_json(value)};
  rungs.insert(rungs.begin(), below.rend() - static_cast<std::ptrdiff_t>(down), below.rend());
  rungs.insert(rungs.end(), above.begin(), above.begin() + static_cast<std::ptrdiff_t>(up));
  return rungs;
}

std::vector<Json> values_of(const BackendDescription& backend, const SettingDescription& setting,
                            const SweepAxis& axis) {
  std::vector<Json> values;
  for (const std::string& text : axis.values) values.push_back(checked_value(backend, setting, text));
  if (!values.empty()) return values;
  if (setting.type == "bool") return {false, true};
  for (const std::string& choice : setting.choices) values.emplace_back(choice);
  return values;
}

/// What goes along one knob of a backend.
struct Knob {
  const SettingDescription* setting;
  const SweepAxis* axis;  ///< null: nobody named it
};

std::vector<Knob> knobs_of(const BackendDescription& backend, const Sweep& sweep,
                           const std::vector<SettingRequest>& fixed) {
  std::vector<Knob> knobs;
  for (const SweepAxis& axis : sweep.along) {
    const SettingDescription* setting = backend.setting(axis.name);
    if (setting != nullptr && concerns(axis.backend, backend.name)) knobs.push_back({setting, &axis});
  }
  if (!sweep.along.empty() || !sweep.unnamed_knobs) return knobs;
  for (const SettingDescription& setting : backend.settings) {
    const bool turned = std::any_of(sweep.over.begin(), sweep.over.end(), [&](const SweepAxis& axis) {
      return axis.name == setting.name && concerns(axis.backend, backend.name);
    });
    if (is_knob(setting) && setting.type == "int" && !turned && !is_fixed(backend.name, setting.name, fixed))
      knobs.push_back({&setting, nullptr});
  }
  return knobs;
}

std::vector<Json> rungs_of(const BackendDescription& backend, const Knob& knob, const Json& asked) {
  const Json now = value_in_force(*knob.setting, asked);
  std::vector<Json> rungs;
  if (knob.axis != nullptr && !knob.axis->values.empty()) {
    rungs = values_of(backend, *knob.setting, *knob.axis);
    rungs.push_back(now);
    std::sort(rungs.begin(), rungs.end());
    rungs.erase(std::unique(rungs.begin(), rungs.end()), rungs.end());
  } else {
    rungs = ladder_about(*knob.setting, now.get<double>());
  }
  if (rungs.size() < 2 && knob.axis != nullptr)
    refuse(*knob.axis, fmt::format("backend {} has it at {}, which has no halves and doubles; name values: {} {}=...",
                                   backend.name, now.dump(), knob.axis->option, knob.setting->name));
  return rungs;
}

void check_axis(const SweepAxis& axis, const BackendDescription& backend, const SettingDescription& setting) {
  if (axis.option == "--over") {
    if (axis.values.empty() && is_number(setting))
      refuse(axis, fmt::format("backend {} takes any number for it; name values: --over {}={},...", backend.name,
                               setting.name, setting.default_value.dump()));
    return;
  }
  if (is_knob(setting)) return;
  refuse(
      axis,
      fmt::format("it is no knob of backend {} (role {}, type {}): more of it is not more of the same; use --over {}{}",
                  backend.name, setting.role, setting.type, setting.name, is_number(setting) ? "=value,..." : ""));
}

}  // namespace

SweepAxis parse_sweep_axis(const std::string& option, const std::string& argument) {
  const auto refuse_form = [&] {
    throw UsageError(fmt::format("{} {}: it takes [backend:]name or [backend:]name=value,value", option, argument));
  };
  SweepAxis axis{option, "", argument.substr(0, argument.find('=')), {}};
  if (const auto colon = axis.name.find(':'); colon != std::string::npos) {
    axis.backend = axis.name.substr(0, colon);
    axis.name = axis.name.substr(colon + 1);
    if (axis.backend.empty()) refuse_form();
  }
  if (axis.name.empty()) refuse_form();
  const auto equals = argument.find('=');
  for (std::size_t at = equals; at != std::string::npos;) {
    const std::size_t comma = argument.find(',', at + 1);
    axis.values.push_back(argument.substr(at + 1, comma == std::string::npos ? comma : comma - at - 1));
    if (axis.values.back().empty()) refuse_form();
    at = comma;
  }
  return axis;
}

void check_sweep(const Sweep& sweep, const std::vector<BackendDescription>& backends,
                 const std::vector<SettingRequest>& fixed) {
  std::vector<const SweepAxis*> axes;
  for (const SweepAxis& axis : sweep.over) axes.push_back(&axis);
  for (const SweepAxis& axis : sweep.along) axes.push_back(&axis);
  std::vector<std::string> backend_names;
  for (const BackendDescription& backend : backends) backend_names.push_back(backend.name);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const SweepAxis& axis = *axes[i];
    bool addressed = false, taken = false, broken = false;
    std::set<std::string> known;
    for (const BackendDescription& backend : backends) {
      if (!concerns(axis.backend, backend.name)) continue;
      addressed = true;
      broken = broken || !backend.error.empty();
      for (const std::string& name : backend.setting_names()) known.insert(name);
      const SettingDescription* setting = backend.setting(axis.name);
      if (setting == nullptr) continue;
      taken = true;
      check_axis(axis, backend, *setting);
      if (is_fixed(backend.name, axis.name, fixed))
        refuse(axis, fmt::format("--set {} holds it still; leave one of the two out", axis.name));
      for (std::size_t j = 0; j < i; ++j) {
        if (axes[j]->name == axis.name && concerns(axes[j]->backend, backend.name))
          refuse(axis, fmt::format("{} turns it already; leave one of the two out", axes[j]->option));
      }
    }
    if (!addressed)
      refuse(axis, fmt::format("no backend \"{}\" is part of this run{}", axis.backend,
                               suggestion(axis.backend, backend_names)));
    if (!taken && !broken)
      refuse(axis, (axis.backend.empty() ? "no backend of this run has such a setting"
                                         : "backend " + axis.backend + " has no such setting") +
                       suggestion(axis.name, {known.begin(), known.end()}));
  }
}

SweptSettings swept_settings(const BackendDescription& backend, const Json& asked, const Sweep& sweep,
                             const std::vector<SettingRequest>& fixed) {
  SweptSettings swept;
  std::vector<Json>& settings = swept.settings;
  std::vector<Json> methods{asked};
  for (const SweepAxis& axis : sweep.over) {
    const SettingDescription* setting = backend.setting(axis.name);
    if (setting == nullptr || !concerns(axis.backend, backend.name)) continue;
    std::vector<Json> crossed;
    for (const Json& method : methods) {
      for (const Json& value : values_of(backend, *setting, axis)) {
        Json next = with_value(method, *setting, value);
        if (std::find(crossed.begin(), crossed.end(), next) == crossed.end()) crossed.push_back(std::move(next));
      }
    }
    methods = std::move(crossed);
  }
  const std::vector<Knob> knobs = knobs_of(backend, sweep, fixed);
  for (const Json& method : methods) {
    const std::size_t base = settings.size();
    settings.push_back(method);
    for (const Knob& knob : knobs) {
      const Json now = value_in_force(*knob.setting, method);
      Ladder ladder{base, 0, {}};
      std::vector<Json> rungs = rungs_of(backend, knob, method);
      std::erase(rungs, now);
      if (rungs.empty()) continue;
      for (const Json& rung : rungs) {
        ladder.others.push_back(settings.size());
        settings.push_back(with_value(method, *knob.setting, rung));
      }
      // Below the base where there is a below: it costs least.
      const auto probe = rungs.front() < now ? ladder.others.begin() : ladder.others.end() - 1;
      ladder.probe = *probe;
      ladder.others.erase(probe);
      swept.ladders.push_back(std::move(ladder));
    }
  }
  return swept;
}

}  // namespace plumb::harness
