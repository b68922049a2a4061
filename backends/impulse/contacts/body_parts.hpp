// The parts of split bodies as kernels see them. A contact has two ends: 2 slot is on its body a, 2 slot + 1 on b.
#pragma once

#include <cstdint>

#include "math/vec3.hpp"

namespace plumb::impulse {

/// A body's part: what a pass over its contact did to its velocity.
struct alignas(4 * sizeof(Real)) PartChange {
  Vec linear;
  Real unused0;
  Vec angular;
  Real unused1;
};

/// Where a body's ends are in the list.
struct PartRange {
  std::uint32_t first, end;
};

struct BodyParts {
  const PartRange* ranges;    ///< by body; empty for what cannot be pushed
  const std::uint32_t* ends;  ///< by body, and in the order of the contacts within
  PartChange* changes;        ///< by end

  /// How many parts a body is in.
  PLUMB_HD Real count(std::uint32_t body) const { return static_cast<Real>(ranges[body].end - ranges[body].first); }
};

}  // namespace plumb::impulse
