// What a backend says of itself, as data: the program that loads no backend reads it, and `plumb backends --json`
// prints it. Made in a worker by describe().
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/json.hpp"
#include "plumb/loader.hpp"

namespace plumb::harness {

struct SettingDescription {
  std::string name, unit, doc, type, role;  ///< type and role by their words
  bool creation_only = false;
  std::vector<std::string> choices;
  double minimum = 0, maximum = 0;  ///< of int and float
  Json default_value;
};

struct BackendDescription {
  std::string name, file;
  std::string error;   ///< why it cannot be opened; empty when it can, and only then what follows means something
  std::string status;  ///< "ok", or how it failed: "error", "crashed", "timeout", "out_of_memory"
  std::string version, build, device;
  std::uint32_t max_threads = 1;
  std::vector<SettingDescription> settings;
  Json json;  ///< all of it, as printed

  [[nodiscard]] const SettingDescription* setting(const std::string& setting_name) const;
  [[nodiscard]] std::vector<std::string> setting_names() const;
};

/// All that a backend says of itself.
[[nodiscard]] Json describe(const Backend& backend);

/// Reads describe()'s answer. Throws nlohmann::json::exception for what is not one.
[[nodiscard]] BackendDescription read_description(const Json& json);

/// A backend that could not be asked; error: the sentence.
[[nodiscard]] BackendDescription broken_backend(const std::string& name, const std::string& file,
                                                const std::string& status, const std::string& error);

/// A setting's value as JSON: bool, number or word.
[[nodiscard]] Json json_of(const PlumbSettingValue& value);
/// The other way, by the backend's own description, whose words the value then points to.
[[nodiscard]] PlumbSettingValue setting_value(const PlumbSettingInfo& info, const Json& json);

}  // namespace plumb::harness
