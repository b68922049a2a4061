#include "joints/mechanism_memory.hpp"

#include <vector>

#include "math/wide.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

void MechanismMemory::put(std::span<const SystemMechanism> mechanisms, std::span<const std::uint32_t> pushed,
                          std::size_t bodies) {
  std::vector<MechanismBody> rows(pushed.size());
  std::vector<std::uint32_t> place_of(bodies, 0U);
  std::uint64_t mobility = 0, scratch = 0;
  held_ = 0;
  for (const SystemMechanism& mechanism : mechanisms) {
    const std::uint32_t first = mechanism.first_place, count = mechanism.place_count();
    PLUMB_ASSERT(count > 0);
    const bool whole = count <= kMostInMechanism;
    for (std::uint32_t place = first; place < mechanism.place_end; ++place) {
      rows[place] = {pushed[place], first,  whole ? count : 0, mechanism.first_column, mechanism.column_count(),
                     mobility,      scratch};
      if (!whole) continue;
      place_of[pushed[place]] = place + 1;
      mobility += std::uint64_t{count} * kMobilityNumbers;
      scratch += std::uint64_t{mechanism.column_count()} * (kJointRows * kLaneGroup);
      held_ = static_cast<std::uint32_t>(pushed.size());
    }
  }
  place_of_.assign(place_of);
  bodies_.assign(rows);
  loads_.grow(rows.size());
  mobility_.grow(static_cast<std::size_t>(mobility));
  scratch_.grow(static_cast<std::size_t>(scratch));
}

}  // namespace plumb::impulse
