// Values of parameters: from what a user typed, and checked against what the scene allows.
#pragma once

#include <string>
#include <string_view>

#include "scene/scene.hpp"

namespace plumb::harness {

/// A value from text: a word of the choices, or a number, numeric expression ("1/60") or number with a unit that the
/// parameter's own can be converted to ("50 cm"). Throws UsageError with the remedy.
[[nodiscard]] ParameterValue parse_parameter(const ParameterSpec& spec, const std::string& text);

/// Throws UsageError when the value is of the wrong kind, out of range, not whole, or not one of the choices.
void check_parameter(const ParameterSpec& spec, const ParameterValue& value);

/// The specification by name; throws UsageError with the nearest parameter of the scene.
[[nodiscard]] const ParameterSpec& find_parameter(const SceneFile& scene, std::string_view name);

}  // namespace plumb::harness
