#include "cell/settings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <set>

#include "plumb/nearest.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

namespace {

std::optional<double> number_in(const std::string& text) {
  double number = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (failure != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return std::nullopt;
  return number;
}

[[noreturn]] void refuse(const BackendDescription& backend, const SettingDescription& setting, const std::string& text,
                         const std::string& remedy) {
  throw UsageError(fmt::format("setting {} of backend {}: \"{}\" {}", setting.name, backend.name, text, remedy));
}

Json number_value(const BackendDescription& backend, const SettingDescription& setting, const std::string& text) {
  const std::optional<double> number = number_in(text);
  const std::string range = fmt::format("from {:g} to {:g}", setting.minimum, setting.maximum);
  if (!number) refuse(backend, setting, text, "is not a number; it takes one " + range);
  if (*number < setting.minimum || *number > setting.maximum)
    refuse(backend, setting, text, "is out of range; it takes a number " + range);
  if (setting.type != "int") return *number;
  if (*number != std::round(*number)) refuse(backend, setting, text, "is not a whole number; it takes one " + range);
  return static_cast<std::int64_t>(*number);
}

// Names under which engines have what the profile "matched" turns off.
Json matched_settings(const BackendDescription& backend) {
  Json settings = Json::object();
  for (const char* name : {"sleeping", "sleep", "auto_sleep", "linear_damping", "angular_damping", "damping"}) {
    const SettingDescription* setting = backend.setting(name);
    if (setting == nullptr || setting->type == "choice") continue;
    if (setting->type == "bool") {
      settings[name] = false;
    } else {
      settings[name] = std::max(0.0, setting->minimum);
    }
  }
  return settings;
}

void merge_checked(Json& settings, const Json& more, const BackendDescription& backend, const std::string& place) {
  if (!more.is_object()) throw UsageError(place + ": \"settings\" must be an object of names and values");
  for (const auto& [name, value] : more.items()) {
    const SettingDescription* setting = backend.setting(name);
    if (setting == nullptr)
      throw UsageError(fmt::format("{}: backend {} has no setting \"{}\"{}", place, backend.name, name,
                                   suggestion(name, backend.setting_names())));
    settings[name] = checked_value(backend, *setting, typed_text(value));
  }
}

std::filesystem::path tuned_file(const BackendDescription& backend) {
  return std::filesystem::path(backend.file).parent_path() / ("plumb-" + backend.name + ".tuned.json");
}

Json tuned_settings(const BackendDescription& backend, const std::string& scene_id) {
  const std::filesystem::path file = tuned_file(backend);
  std::ifstream in(file);
  if (!in)
    throw UsageError(
        fmt::format("profile tuned: backend {} has no file {}; its author writes one with {{\"settings\": {{...}}}}",
                    backend.name, file.string()));
  const Json tuned = Json::parse(in, nullptr, false, true);
  if (!tuned.is_object()) throw UsageError(file.string() + " is not a JSON object");
  for (const auto& [key, ignored] : tuned.items()) {
    if (key != "settings" && key != "scenes")
      throw UsageError(
          fmt::format("{}: unknown key \"{}\"{}", file.string(), key, suggestion(key, {"settings", "scenes"})));
  }
  Json settings = Json::object();
  if (tuned.contains("settings")) merge_checked(settings, tuned["settings"], backend, file.string());
  if (tuned.contains("scenes") && tuned["scenes"].contains(scene_id))
    merge_checked(settings, tuned["scenes"][scene_id], backend, file.string());
  return settings;
}

}  // namespace

bool has_tuned_settings(const BackendDescription& backend) { return std::filesystem::exists(tuned_file(backend)); }

Json checked_value(const BackendDescription& backend, const SettingDescription& setting, const std::string& text) {
  if (setting.type == "bool") {
    if (text == "true" || text == "1" || text == "on" || text == "yes") return true;
    if (text == "false" || text == "0" || text == "off" || text == "no") return false;
    refuse(backend, setting, text, "is neither true nor false");
  }
  if (setting.type == "choice") {
    if (std::find(setting.choices.begin(), setting.choices.end(), text) == setting.choices.end())
      refuse(backend, setting, text, "is not one of its choices" + suggestion(text, setting.choices));
    return text;
  }
  return number_value(backend, setting, text);
}

SettingRequest parse_setting_request(const std::string& argument) {
  const auto equals = argument.find('=');
  if (equals == std::string::npos || equals == 0)
    throw UsageError("--set " + argument + ": a setting is given as name=value or backend:name=value");
  SettingRequest request;
  request.name = argument.substr(0, equals);
  request.text = argument.substr(equals + 1);
  if (const auto colon = request.name.find(':'); colon != std::string::npos) {
    request.backend = request.name.substr(0, colon);
    request.name = request.name.substr(colon + 1);
  }
  return request;
}

void check_setting_requests(const std::vector<SettingRequest>& requests,
                            const std::vector<BackendDescription>& backends) {
  std::vector<std::string> backend_names;
  for (const BackendDescription& backend : backends) backend_names.push_back(backend.name);
  for (const SettingRequest& request : requests) {
    bool addressed = false, taken = false, broken = false;
    std::set<std::string> known;
    for (const BackendDescription& backend : backends) {
      if (!request.backend.empty() && request.backend != backend.name) continue;
      addressed = true;
      broken = broken || !backend.error.empty();
      taken = taken || backend.setting(request.name) != nullptr;
      for (const std::string& name : backend.setting_names()) known.insert(name);
    }
    if (!addressed)
      throw UsageError(fmt::format("--set {}:{}: no backend \"{}\" is part of this run{}", request.backend,
                                   request.name, request.backend, suggestion(request.backend, backend_names)));
    if (!taken && !broken) {
      const std::string who =
          request.backend.empty() ? "no backend of this run has a" : "backend " + request.backend + " has no";
      throw UsageError(fmt::format("{} setting \"{}\"{}", who, request.name,
                                   suggestion(request.name, {known.begin(), known.end()})));
    }
  }
}

const std::vector<std::string>& profile_words() {
  static const std::vector<std::string> words{"default", "matched", "tuned"};
  return words;
}

Json settings_for(const BackendDescription& backend, const std::string& scene_id, const std::string& profile,
                  const std::vector<SettingRequest>& requests) {
  Json settings = Json::object();
  if (!backend.error.empty()) return settings;
  if (profile == "matched") settings = matched_settings(backend);
  if (profile == "tuned") settings = tuned_settings(backend, scene_id);
  for (const SettingRequest& request : requests) {
    if (!request.backend.empty() && request.backend != backend.name) continue;
    if (const SettingDescription* setting = backend.setting(request.name))
      settings[request.name] = checked_value(backend, *setting, request.text);
  }
  return settings;
}

}  // namespace plumb::harness
