// The engine without its interface: bodies and shapes in memory, and the step.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "body_state.hpp"
#include "broadphase/broad_phase.hpp"
#include "constraints/joint_store.hpp"
#include "contact_record.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "exec/phase_clock.hpp"
#include "exec/table.hpp"
#include "geometry/hull_pool.hpp"
#include "geometry/surface_pool.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "narrowphase/pieces.hpp"
#include "solver/colouring.hpp"
#include "solver/solver.hpp"
#include "state_rows.hpp"
#include "step_counters.hpp"
#include "step_parameters.hpp"

namespace plumb::impulse {

class Simulation {
  Executor executor_;  // before all that works with it

 public:
  Simulation(const PlumbHost* host, std::uint32_t threads, const SolverFeatures& features);

  // --- what the host fills; rows are body slots. The last row is nobody. ---
  BodyState state;  ///< say which rows were touched
  Table<BodyForce> force;
  Table<BodyMass> mass;
  Table<BodyFrame> frames;
  Table<Proxy> proxies;        // rows of their own: a body may have several, or none
  Table<ProxyFilter> filters;  // by proxy
  Table<Shape> shapes;
  JointStore joints;
  HullPool hulls;
  SurfacePool surfaces;

  /// Room for this many body slots, and the rows up to it.
  void reserve_bodies(std::uint32_t slots);
  void reserve_shapes(std::uint32_t rows);
  /// Room for this many proxies, at least one a body slot. New rows have no shape.
  void reserve_proxies(std::uint32_t rows);
  /// Slots in use; rows behind are nobody's.
  void set_body_count(std::uint32_t slots) { body_count_ = slots; }
  [[nodiscard]] std::uint32_t body_count() const { return body_count_; }
  /// Proxy rows in use; those among them without a shape are nobody's.
  void set_proxy_count(std::uint32_t rows) { proxy_count_ = rows; }

  void bodies_changed() { bodies_dirty_ = true; }    ///< made, gone
  void statics_changed() { statics_dirty_ = true; }  ///< bodies that do not move: placed elsewhere

  /// Enqueues a step. parameters.step and .origin are filled in here.
  void step(const StepParameters& parameters);
  /// Returns when the step is done; grows what was too small and repeats the step then.
  void wait();

  [[nodiscard]] const StepCounters& counters() const { return *counters_.host(); }
  [[nodiscard]] std::uint32_t steps() const { return step_; }
  [[nodiscard]] bool repeated() const { return repeated_; }
  /// Of the last step, s; NaN where it was not measured, and for phases that this engine does not tell apart.
  [[nodiscard]] double phase_seconds(PlumbPhase phase) const;
  [[nodiscard]] Executor& executor() { return executor_; }

  /// Manifolds of the last step, copied to the host. Impulses are 0 where the scene did not ask for them.
  [[nodiscard]] std::vector<ContactRecord> contacts();
  /// What the broad phase of the last step found.
  [[nodiscard]] std::vector<Pair> candidates();
  [[nodiscard]] std::uint32_t candidate_count() const { return in_pieces_ ? counters().pieces : counters().pairs; }

  /// Rows of state by body slot, up to date. Steps bring them from now on. On the device they are there once what was
  /// enqueued is done; on the host they are there.
  [[nodiscard]] std::shared_ptr<RowBlock<PoseRow>> pose_rows(bool on_host) { return rows(poses_, on_host); }
  [[nodiscard]] std::shared_ptr<RowBlock<VelocityRow>> velocity_rows(bool on_host) {
    return rows(velocities_, on_host);
  }

 private:
  /// What a recorded step holds of the host's numbers and addresses.
  struct Recorded {
    std::array<const void*, 9> addresses{};
    std::array<std::uint32_t, 7> numbers{};
    bool operator==(const Recorded&) const = default;
  };

  void upload_changes();
  void list_bodies();
  void find_origin();
  void find_candidates(const ContactCache& now);
  void reserve_rows();
  void enqueue();
  void enqueue_rows();
  void run_step();
  void forget_recordings();
  [[nodiscard]] Recorded what_is_recorded();
  template <class Row>
  std::shared_ptr<RowBlock<Row>> rows(FieldRows<Row>& field, bool on_host);
  [[nodiscard]] Bodies bodies();
  [[nodiscard]] Proxies proxy_view();
  void reserve_pairs(std::uint32_t pairs);

  SolverFeatures features_;
  std::uint32_t body_count_ = 0, proxy_count_ = 0, step_ = 0, pair_capacity_ = 0;
  bool bodies_dirty_ = true, statics_dirty_ = true, repeated_ = false;
  Position origin_{0, 0, 0};

  Mirror<std::uint32_t> movers_, statics_, planes_;
  std::uint32_t mover_count_ = 0, static_count_ = 0, plane_count_ = 0;
  bool in_pieces_ = false;         // once there was a plane or a surface
  std::uint32_t shape_types_ = 0;  // a bit for each ShapeType in the world
  Mirror<StepParameters> parameters_;
  Mirror<StepCounters> counters_;
  Buffer<Box> boxes_;     // by proxy
  Buffer<Real> margins_;  // by proxy

  BroadPhase broad_phase_;
  Pieces pieces_;
  NarrowPhase narrow_phase_;
  Colouring colouring_;
  Solver solver_;
  Buffer<ContactRecord> records_;
  FieldRows<PoseRow> poses_;
  FieldRows<VelocityRow> velocities_;
  PhaseClock phases_;
  Recording recordings_[2][2];  // steps that are measured or not, of each parity
  Recorded recorded_;
};

}  // namespace plumb::impulse
