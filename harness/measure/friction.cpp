// Measures of the friction scenes.
#include "measure/groups.hpp"

namespace plumb::harness {

std::span<const MeasureEntry> friction_measures() { return {}; }

}  // namespace plumb::harness
