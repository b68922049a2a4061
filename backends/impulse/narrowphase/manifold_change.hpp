// What the host changes in a manifold before it is solved, as kernels see it.
#pragma once

#include <cstdint>

#include "math/vec3.hpp"
#include "plumb/manifolds.h"

namespace plumb::impulse {

struct ManifoldChange {
  std::uint32_t what;  ///< PLUMB_MANIFOLD_ bits; 0: nothing
  Real friction, restitution;
  Vec surface_velocity;  ///< of b's surface against a's, world axes, m/s
};

/// The changes of a step by candidate of the narrow phase.
struct ManifoldChanges {
  const std::uint32_t* is_shown = nullptr;  ///< by candidate: 1 or 0; null in worlds that change none
  const std::uint32_t* place = nullptr;     ///< by candidate: the row of its change where it was shown
  const ManifoldChange* rows = nullptr;

  /// Of a candidate, if it has it; else null.
  [[nodiscard]] PLUMB_HD const ManifoldChange* find(std::uint32_t candidate, std::uint32_t what) const {
    if (is_shown == nullptr || is_shown[candidate] == 0) return nullptr;
    const ManifoldChange* change = &rows[place[candidate]];
    return (change->what & what) != 0 ? change : nullptr;
  }
  [[nodiscard]] PLUMB_HD bool disables(std::uint32_t candidate) const {
    return find(candidate, PLUMB_MANIFOLD_DISABLED) != nullptr;
  }
};

}  // namespace plumb::impulse
