// All measures, joined from the groups' lists, and what scene files may ask of them.
#pragma once

#include <span>
#include <string>

#include "measure/measure.hpp"

namespace plumb::harness {

/// All measures; the lists of the groups, joined.
[[nodiscard]] std::span<const MeasureEntry> all_measures();

/// The measure of a name; throws UsageError with the nearest one.
[[nodiscard]] const MeasureEntry& find_measure(const std::string& name);

/// The measure of a scene file. Throws UsageError with file, line and the nearest word when its kind or an argument is
/// unknown, and likewise when an argument is missing or of another type.
[[nodiscard]] const MeasureEntry& find_measure(const SceneFile& file);

/// Throws likewise when an argument names what this scene of the file does not have, or asks what cannot be measured.
void check_measure(const SceneFile& file, const Scene& scene);

}  // namespace plumb::harness
