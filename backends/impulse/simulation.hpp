// The engine without its interface: bodies and shapes in memory, and the step.
#pragma once

#include <cstdint>

#include "body.hpp"
#include "broadphase/broad_phase.hpp"
#include "constraints/joint_store.hpp"
#include "contact_record.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "geometry/hull_pool.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "solver/colouring.hpp"
#include "solver/solver.hpp"
#include "step_counters.hpp"
#include "step_parameters.hpp"

namespace plumb::impulse {

class Simulation {
 public:
  Simulation(const PlumbHost* host, std::uint32_t threads, const SolverFeatures& features);

  // --- what the host fills; rows are body slots. The last row is nobody. After a change say so. ---
  Mirror<Position> position;
  Mirror<Quat> orientation;
  Mirror<Velocity> velocity;
  Mirror<BodyForce> force;
  Mirror<BodyMass> mass;
  Mirror<Proxy> proxies;  // one a body, for now at the body's slot
  Mirror<ProxyFilter> filters;
  Mirror<Shape> shapes;
  JointStore joints;
  HullPool hulls;

  /// Room for this many body slots, and the rows up to it.
  void reserve_bodies(std::uint32_t slots);
  void reserve_shapes(std::uint32_t rows);
  /// Slots in use; rows behind are nobody's.
  void set_body_count(std::uint32_t slots) { body_count_ = slots; }
  [[nodiscard]] std::uint32_t body_count() const { return body_count_; }

  /// The host side of state is up to date after this; and it may be changed before the next step.
  void bring_state_to_host();
  void state_changed() { state_dirty_ = true; }  ///< position, orientation, velocity
  void forces_changed() { forces_dirty_ = true; }
  void bodies_changed() { bodies_dirty_ = true; }    ///< everything else, made and gone bodies included
  void statics_changed() { statics_dirty_ = true; }  ///< bodies that do not move: made, gone, placed elsewhere

  /// Enqueues a step. parameters.step and .origin are filled in here.
  void step(const StepParameters& parameters);
  /// Returns when the step is done; grows what was too small and repeats the step then.
  void wait();

  [[nodiscard]] const StepCounters& counters() const { return *counters_.host(); }
  [[nodiscard]] std::uint32_t steps() const { return step_; }
  [[nodiscard]] bool repeated() const { return repeated_; }
  [[nodiscard]] Executor& executor() { return executor_; }

  /// Manifolds of the last step, copied to the host. Impulses are 0 where the scene did not ask for them.
  [[nodiscard]] std::vector<ContactRecord> contacts();
  /// What the broad phase of the last step found.
  [[nodiscard]] std::vector<Pair> candidates();

 private:
  void upload_changes();
  void find_origin();
  void enqueue();
  void run_step();
  [[nodiscard]] Bodies bodies();
  [[nodiscard]] Proxies proxy_view();
  void reserve_pairs(std::uint32_t pairs);

  Executor executor_;
  SolverFeatures features_;
  std::uint32_t body_count_ = 0, step_ = 0, pair_capacity_ = 0;
  bool state_dirty_ = false, forces_dirty_ = false, bodies_dirty_ = true, statics_dirty_ = true;
  bool host_stale_ = false, repeated_ = false;
  Position origin_{0, 0, 0};

  Mirror<std::uint32_t> movers_, statics_;
  std::uint32_t mover_count_ = 0, static_count_ = 0;
  std::uint32_t shape_types_ = 0;  // a bit for each ShapeType in the world
  Mirror<StepParameters> parameters_;
  Mirror<StepCounters> counters_;
  Buffer<Box> boxes_;     // by proxy
  Buffer<Real> margins_;  // by proxy

  BroadPhase broad_phase_;
  NarrowPhase narrow_phase_;
  Colouring colouring_;
  Solver solver_;
  Buffer<ContactRecord> records_;
  Recording recordings_[2];  // a step of each parity
};

}  // namespace plumb::impulse
