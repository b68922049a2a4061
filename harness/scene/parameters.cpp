#include "scene/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "base/units.hpp"
#include "plumb/nearest.hpp"
#include "scene/expressions.hpp"

namespace plumb::harness {
namespace {

std::string trimmed(const std::string& text) {
  const auto begin = text.find_first_not_of(" \t");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

double parse_number(const ParameterSpec& spec, const std::string& text) {
  double value = 0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool number_first = failure == std::errc();
  if (number_first && end == text.data() + text.size()) return value;
  const std::string rest = number_first ? trimmed(std::string(end, text.data() + text.size())) : "";
  const bool unit_follows = !rest.empty() && (std::isalpha(static_cast<unsigned char>(rest[0])) != 0 || rest[0] == '%');
  try {
    if (unit_follows) return value * conversion(rest, spec.unit.empty() ? "1" : spec.unit);
    return Expressions().evaluate(text);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("parameter {}: {} (a number in {} is wanted)", spec.name, error.what(),
                                 spec.unit.empty() ? "1" : spec.unit));
  }
}

}  // namespace

ParameterValue parse_parameter(const ParameterSpec& spec, const std::string& text) {
  const std::string word = trimmed(text);
  ParameterValue value;
  if (spec.choices.empty())
    value = parse_number(spec, word);
  else
    value = word;
  check_parameter(spec, value);
  return value;
}

void check_parameter(const ParameterSpec& spec, const ParameterValue& value) {
  if (!spec.choices.empty()) {
    const auto* word = std::get_if<std::string>(&value);
    if (word == nullptr) throw UsageError(fmt::format("parameter {} is a word, not a number", spec.name));
    if (std::find(spec.choices.begin(), spec.choices.end(), *word) == spec.choices.end())
      throw UsageError(
          fmt::format("parameter {}: unknown choice \"{}\"{}", spec.name, *word, suggestion(*word, spec.choices)));
    return;
  }
  const auto* number = std::get_if<double>(&value);
  if (number == nullptr)
    throw UsageError(
        fmt::format("parameter {} is a number, not the word \"{}\"", spec.name, std::get<std::string>(value)));
  if (!std::isfinite(*number)) throw UsageError(fmt::format("parameter {} must be finite", spec.name));
  if (spec.integer && *number != std::rint(*number))
    throw UsageError(fmt::format("parameter {} must be a whole number, not {}", spec.name, *number));
  if (spec.minimum && *number < *spec.minimum)
    throw UsageError(fmt::format("parameter {} = {} is below its minimum {}", spec.name, *number, *spec.minimum));
  if (spec.maximum && *number > *spec.maximum)
    throw UsageError(fmt::format("parameter {} = {} is above its maximum {}", spec.name, *number, *spec.maximum));
}

const ParameterSpec& find_parameter(const SceneFile& scene, std::string_view name) {
  std::vector<std::string> known;
  for (const ParameterSpec& spec : scene.parameters) {
    if (spec.name == name) return spec;
    known.push_back(spec.name);
  }
  if (known.empty()) throw UsageError(fmt::format("scene {} has no parameters, so no \"{}\"", scene.id, name));
  throw UsageError(fmt::format("scene {}: unknown parameter \"{}\"{}", scene.id, name, suggestion(name, known)));
}

}  // namespace plumb::harness
