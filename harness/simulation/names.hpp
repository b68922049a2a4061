// The words for the interface's numbers, in rows, listings and reasons; those of needs, shapes and joints are the scene
// files' own.
#pragma once

#include <string>
#include <vector>

#include "plumb/plumb.h"

namespace plumb::harness {

[[nodiscard]] const std::vector<std::string>& degree_words();  ///< none, approximate, emulated, native
[[nodiscard]] const std::vector<std::string>& motion_words();
[[nodiscard]] const std::vector<std::string>& field_words();
[[nodiscard]] const std::vector<std::string>& event_words();
[[nodiscard]] const std::vector<std::string>& phase_words();
[[nodiscard]] const std::vector<std::string>& query_words();
[[nodiscard]] const std::vector<std::string>& joint_feature_words();
[[nodiscard]] const std::vector<std::string>& setting_type_words();
[[nodiscard]] const std::vector<std::string>& role_words();
[[nodiscard]] const std::vector<std::string>& determinism_words();

/// The word at an index, or "" beyond the end.
[[nodiscard]] std::string word_of(const std::vector<std::string>& words, std::size_t index);

/// "ok", "truncated", "unsupported" ...: what a PlumbResult is called.
[[nodiscard]] std::string result_word(PlumbResult result);

}  // namespace plumb::harness
