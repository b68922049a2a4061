// What a user asks of settings, and what that means for one backend.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cell/description.hpp"

namespace plumb::harness {

/// One --set: "name=value", or "backend:name=value" for one backend.
struct SettingRequest {
  std::string backend;  ///< "" : all that have it
  std::string name, text;
};

/// Throws UsageError for what has no "=".
[[nodiscard]] SettingRequest parse_setting_request(const std::string& argument);

/// A setting's value from text, as from the command line. Throws UsageError for the wrong type or out of range.
[[nodiscard]] Json checked_value(const BackendDescription& backend, const SettingDescription& setting,
                                 const std::string& text);

/// Throws UsageError, with the nearest right word, for requests that no backend of the list takes, or that one they
/// name does not have.
void check_setting_requests(const std::vector<SettingRequest>& requests,
                            const std::vector<BackendDescription>& backends);

[[nodiscard]] const std::vector<std::string>& profile_words();  ///< default, matched, tuned

/// Whether the backend's author has written the file of the profile "tuned".
[[nodiscard]] bool has_tuned_settings(const BackendDescription& backend);

/// The settings that a cell asks for, by name: the profile's, then the user's over them.
///   default: none. matched: sleeping and damping of the engine's own off, under their usual names. tuned: those of
///   plumb-NAME.tuned.json beside the library: {"settings": {...}, "scenes": {"D1": {...}}}, the scene's over the rest.
/// Throws UsageError for a value of the wrong type or out of range, and for a tuned file that is missing or broken.
[[nodiscard]] Json settings_for(const BackendDescription& backend, const std::string& scene_id,
                                const std::string& profile, const std::vector<SettingRequest>& requests);

}  // namespace plumb::harness
