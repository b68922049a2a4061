// Islands: what contacts and joints join, over bodies that can be pushed. Found where kernels run (union_find.hpp).
#pragma once

#include "bodies/body.hpp"
#include "contacts/surface_velocity.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "joints/joint_axes.hpp"
#include "narrowphase/contact_cache.hpp"
#include "narrowphase/manifold_change.hpp"

namespace plumb::impulse {

/// Joints as edges.
struct JointEdges {
  const Joint* joints;
  std::uint32_t count;
  const JointDrive* drives;  ///< by slot
};

class Islands {
 public:
  void reserve(std::uint32_t bodies);

  /// What joins bodies, and for how long they have rested.
  struct Input {
    ContactCache cache;
    std::uint32_t manifolds;
    JointEdges joints;
    Bodies bodies;
    std::uint32_t body_count;
    Proxies proxies;
    const Real* rest;                         ///< by body, s
    Real time;                                ///< for which an island is to have rested, s
    const Vec* surface_velocities = nullptr;  ///< by proxy, or null: what touches a surface that runs does not rest
    ManifoldChanges changes = {};
  };
  /// Enqueues the search for islands all of whose bodies have rested for that time at least, and which nothing that
  /// moves by itself touches and no motor moves. Only between steps.
  void find_resting(Executor& executor, const Input& input);

  /// Of the last search, when it is done: how many bodies such islands have.
  [[nodiscard]] std::uint32_t resting_count() const { return *count_.host(); }
  /// By body: 1 + the smallest body of its island; 0 where it is not of such an island.
  [[nodiscard]] std::vector<std::uint32_t> resting(std::uint32_t body_count) const {
    return resting_.to_host(body_count);
  }

 private:
  Buffer<std::uint32_t> parent_, root_, restless_, awake_, resting_;
  Mirror<std::uint32_t> count_;
};

}  // namespace plumb::impulse
