// Arguments of a measure, as the scene file gave them, with errors that say which one is missing or wrong.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "base/locate.hpp"
#include "scene/scene.hpp"

namespace plumb::harness {

/// Throws UsageError "file:line: sentence" for a place in a scene file.
[[noreturn]] void fail_at(const SceneFile& file, const JsonPath& path, const std::string& sentence);

/// All throw UsageError when the argument is missing or of another kind.
[[nodiscard]] double arg_number(const Scene& scene, std::string_view name);
[[nodiscard]] const std::string& arg_text(const Scene& scene, std::string_view name);
[[nodiscard]] std::vector<double> arg_numbers(const Scene& scene, std::string_view name);
/// Index of the body that the argument names.
[[nodiscard]] std::size_t arg_body(const Scene& scene, std::string_view name);
[[nodiscard]] std::size_t arg_joint(const Scene& scene, std::string_view name);
/// Indices of all bodies whose name is the argument's text followed by a number, in order of creation.
[[nodiscard]] std::vector<std::size_t> arg_bodies(const Scene& scene, std::string_view name);

}  // namespace plumb::harness
