// Belts: surfaces that run while their bodies stand. Friction sees the velocity of the surface, not of the body; the
// normal, and what bodies without contact do, know nothing of it.
//
// The speeds have rows of their own, and so has the step that reads them its kernel: a world that declares no belts has
// neither.
#pragma once

#include "bodies/body.hpp"
#include "bodies/step_counters.hpp"
#include "contacts/contact_rows.hpp"
#include "exec/executor.hpp"
#include "exec/table.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// By proxy: how fast its surface runs over the body, m/s in the body's principal frame.
using BeltSpeeds = Table<Vec>;

/// Whether one of two surfaces runs.
PLUMB_HD inline bool runs(const Vec* belts, const Pair& pair) {
  return length_squared(belts[pair.a]) > 0 || length_squared(belts[pair.b]) > 0;
}

/// What put_drifts works with.
struct DriftWork {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const Vec* belts;                      ///< by proxy
  const std::uint32_t *order, *colours;  ///< as of Colouring
  ContactRows rows;
  const StepCounters* counters;
};
/// Puts kDrift into the rows of all contacts, which are prepared and of which there are no more than `capacity`.
void put_drifts(Executor& executor, const DriftWork& work, std::uint32_t capacity);

}  // namespace plumb::impulse
