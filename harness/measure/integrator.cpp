// Measures of the integrator scenes.
#include "measure/groups.hpp"

namespace plumb::harness {

std::span<const MeasureEntry> integrator_measures() { return {}; }

}  // namespace plumb::harness
