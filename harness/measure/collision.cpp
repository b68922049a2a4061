// Measures of the collision scenes.
#include "measure/groups.hpp"

namespace plumb::harness {

std::span<const MeasureEntry> collision_measures() { return {}; }

}  // namespace plumb::harness
