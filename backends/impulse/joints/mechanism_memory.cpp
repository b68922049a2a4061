#include "joints/mechanism_memory.hpp"

#include <algorithm>
#include <numeric>

#include "math/wide.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

void MechanismMemory::put(const OrderedJoints& ordered, std::span<const std::uint32_t> pushed, std::size_t bodies) {
  const std::uint32_t base = ordered.base, columns = ordered.count() - base;
  std::vector<std::uint32_t> by_mechanism(columns), number(columns), mechanism_of_body(bodies, kNone);
  std::iota(by_mechanism.begin(), by_mechanism.end(), 0U);
  const auto mechanism = [&](std::uint32_t column) { return ordered.mechanism[base + column]; };
  std::stable_sort(by_mechanism.begin(), by_mechanism.end(),
                   [&](std::uint32_t x, std::uint32_t y) { return mechanism(x) < mechanism(y); });
  for (std::uint32_t column = 0; column < columns; ++column)
    for (const std::uint32_t body : {ordered.joints[base + column].body_a, ordered.joints[base + column].body_b})
      if (body != kWorld) mechanism_of_body[body] = mechanism(column);  // of what stands any that it holds

  std::vector<MechanismBody> rows(pushed.size());
  std::vector<std::uint32_t> place_of(bodies, 0U);
  std::uint64_t mobility = 0, scratch = 0;
  held_ = 0;
  for (std::uint32_t first = 0, column = 0; first < pushed.size();) {
    const std::uint32_t of = mechanism_of_body[pushed[first]];
    std::uint32_t end = first, last_column = column;
    while (end < pushed.size() && mechanism_of_body[pushed[end]] == of) ++end;
    while (last_column < columns && mechanism(by_mechanism[last_column]) == of) {
      number[by_mechanism[last_column]] = last_column - column;
      ++last_column;
    }
    PLUMB_ASSERT(end > first);
    const bool whole = end - first <= kMostInMechanism;
    for (std::uint32_t place = first; place < end; ++place) {
      rows[place] = {pushed[place], first, whole ? end - first : 0, column, last_column - column, mobility, scratch};
      if (!whole) continue;
      place_of[pushed[place]] = place + 1;
      mobility += std::uint64_t{end - first} * kMobilityNumbers;
      scratch += std::uint64_t{last_column - column} * (kJointRows * kLaneGroup);
      held_ = static_cast<std::uint32_t>(pushed.size());
    }
    first = end;
    column = last_column;
  }
  place_of_.assign(place_of);
  columns_.assign(by_mechanism);
  number_of_.assign(number);
  bodies_.assign(rows);
  loads_.grow(rows.size());
  mobility_.grow(static_cast<std::size_t>(mobility));
  scratch_.grow(static_cast<std::size_t>(scratch));
}

}  // namespace plumb::impulse
