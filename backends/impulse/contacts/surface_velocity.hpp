// Surface velocity: surfaces that run while their bodies stand, as those of conveyor belts do. Friction sees the
// velocity of the surface, not of the body; the normal, and what bodies without contact do, know nothing of it.
//
// The speeds have rows of their own, and so has the step that reads them its kernel: a world that declares none has
// neither.
#pragma once

#include "bodies/body.hpp"
#include "bodies/step_counters.hpp"
#include "contacts/contact_rows.hpp"
#include "exec/executor.hpp"
#include "exec/table.hpp"
#include "narrowphase/contact_cache.hpp"
#include "narrowphase/manifold_change.hpp"

namespace plumb::impulse {

/// By proxy: how fast its surface runs over the body, m/s in the body's principal frame.
using SurfaceVelocities = Table<Vec>;

/// Whether one of two surfaces runs.
PLUMB_HD inline bool runs(const Vec* surface_velocities, const Pair& pair) {
  return length_squared(surface_velocities[pair.a]) > 0 || length_squared(surface_velocities[pair.b]) > 0;
}

/// What put_surface_speeds works with.
struct SurfaceSpeedWork {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const Vec* surface_velocities;      ///< by proxy
  const std::uint32_t *order, *keys;  ///< as of Colouring
  ContactRows rows;
  const StepCounters* counters;
  ManifoldChanges changes;
};
/// Puts kSurfaceSpeed into the rows of all contacts, which are prepared and of which there are no more than `capacity`.
void put_surface_speeds(Executor& executor, const SurfaceSpeedWork& work, std::uint32_t capacity);

}  // namespace plumb::impulse
