// What passes through others in spite of its impacts is put back in front of them.
//
// Contacts of impacts are laws for velocities: a corner that is stopped at 1,000 m/s lets the rest of its body turn and
// fly on for what is left of the step. So when the bodies have moved, the ways of a few points well inside of each
// flagged body are looked at, as the other shape sees them. A body of which a point has gone into the other shape, or
// through it, is put back to where it was shortly before, or to the same place before a kinematic body, which has gone
// on. Nor may such a body leave the box in which the step has looked for others where something else is. It loses time
// and no momentum.
#pragma once

#include "bodies/body.hpp"
#include "bodies/step_counters.hpp"
#include "bodies/step_parameters.hpp"
#include "bvh/tree_view.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "narrowphase/contact_cache.hpp"
#include "narrowphase/manifold_change.hpp"

namespace plumb::impulse {

class ImpactClamp {
 public:
  void reserve(std::uint32_t bodies);

  /// What this reads of the step.
  struct Input {
    ContactCache cache;
    Count candidates;  ///< of the narrow phase
    std::uint32_t pair_capacity;
    const StepCounters* counters;
    const StepParameters* parameters;
    Proxies proxies;
    const Box* boxes;  ///< by proxy, as of the broad phase
    ProxyRows movers;
    TreeView statics;  ///< of the same boxes
    ProxyRows planes;
    ManifoldChanges changes;
  };
  /// After the bodies have moved by these displacements.
  void clamp(Executor& executor, const Input& input, const MovableBodies& bodies, std::uint32_t body_count,
             Displacement* displacements);

 private:
  Buffer<std::uint32_t> stays_;  // by body: share of its way, as the bits of a float
  Buffer<std::uint64_t> first_;  // by body: when, as the bits of a share of its way, and the candidate
};

}  // namespace plumb::impulse
