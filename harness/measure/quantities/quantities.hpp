// The measure "quantities": what a scene file observes and which truth it holds it against, in the file's own words.
#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/measure.hpp"
#include "measure/quantities/quantity.hpp"
#include "measure/quantities/reduction.hpp"

namespace plumb::harness {

/// One entry of the argument "quantities": a metric of the scene.
struct QuantityRequest {
  std::string name;
  QuantityWatch::Target target;
  ReductionSpec reduction;
  double in_unit = 1;            ///< factor from SI, in which all else is, to the unit in which the metric is told
  double truth = 0;              ///< 0 where it is a function of the time
  nlohmann::json truth_of_time;  ///< that function, as the argument has it; null where the truth is one number
  double scale = 1;              ///< what an error of 1 is
};

/// What may stand in an entry.
[[nodiscard]] const std::vector<std::string>& quantity_keys();

/// The scene's quantities, those left out whose metric does not stand in it. Throws UsageError for what cannot be
/// measured: with file and line where `file` is given, whose scene it is.
[[nodiscard]] std::vector<QuantityRequest> read_quantities(const Scene& scene, const SceneFile* file);

/// The list, of this one measure.
[[nodiscard]] std::span<const MeasureEntry> quantity_measures();

void measure_quantities(MeasureContext& context);
void check_quantities(const SceneFile& file, const Scene& scene);

}  // namespace plumb::harness
