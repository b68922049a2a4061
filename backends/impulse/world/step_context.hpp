// What the stages of a step work with.
#pragma once

#include "bodies/state_rows.hpp"
#include "broadphase/broad_phase.hpp"
#include "broadphase/exclusions.hpp"
#include "contacts/colouring.hpp"
#include "contacts/contact_modification.hpp"
#include "continuous/impact_clamp.hpp"
#include "continuous/impacts.hpp"
#include "exec/phase_clock.hpp"
#include "islands/sleep.hpp"
#include "joints/joint_store.hpp"
#include "narrowphase/midphase.hpp"
#include "narrowphase/narrow_phase.hpp"
#include "solver/energy_bound.hpp"
#include "solver/solver.hpp"
#include "world/validate.hpp"

namespace plumb::impulse {

/// The memory of the stages, which knows nothing of any one step.
struct Stages {
  explicit Stages(const SolverFeatures& wanted) : features(wanted), solver(wanted) {}
  /// Room for so many rows of bodies and proxies, and so many pairs. Between steps.
  void reserve(Executor& executor, std::uint32_t bodies, std::uint32_t proxies, std::uint32_t pairs);

  SolverFeatures features;
  std::uint32_t pair_capacity = 0;
  bool uses_midphase = false;      ///< once there was a plane or a surface
  bool continuous = false;         ///< once there was a body that must not pass through others
  bool modifies_contacts = false;  ///< once there was a body whose contacts the host is to see
  Buffer<Box> boxes;               ///< by proxy
  Buffer<Real> margins;            ///< by proxy: how far ahead it is looked, m
  BroadPhase broad_phase;
  Midphase midphase;
  NarrowPhase narrow_phase;
  Impacts impacts;  ///< these two where the scene asks for them
  ImpactClamp clamp;
  ContactModification modification;  ///< likewise
  Colouring colouring;
  Solver solver;
  EnergyBound energy_bound;  ///< where there are joints
  PhaseClock phases;
  ValidationMemory validation;  ///< where there are asserts

  /// What the host has changed in the step's manifolds.
  [[nodiscard]] ManifoldChanges changes() { return modifies_contacts ? modification.changes() : ManifoldChanges{}; }
};

/// What a step depends on of the host's numbers and addresses: two steps of the same are the same sequence of kernels,
/// and a recording of the one serves for the other.
struct StepInput {
  MovableBodies movable;
  Proxies proxies;
  const BodyFrame* frames;
  const Vec* surface_velocities;             ///< by proxy; null in worlds without
  const RollingFriction* rolling_frictions;  ///< by body; null in worlds without
  PairFilter filter;
  ProxyRows movers, statics, planes;
  std::uint32_t body_rows;  ///< that kernels go through; those without a body are nobody's
  std::uint32_t pair_capacity;
  std::uint32_t shape_types;       ///< a bit for each ShapeType in the world
  bool uses_midphase, continuous;  ///< of the stages
  bool has_sleepers;
  const KeptPair* woken;  ///< manifolds of those who woke; null in worlds where nobody sleeps
  SolverKind solver;
  std::uint64_t storage;  ///< generation of the stages' memory and of the joints
  bool operator==(const StepInput&) const = default;
};

/// The rows that steps bring to whoever reads state, where somebody does.
struct OutputRows {
  FieldRows<PoseRow> poses;
  FieldRows<VelocityRow> velocities;
};

struct StepContext : StepInput {
  Executor& executor;
  Stages& stages;
  JointStore& joints;
  Sleep& sleep;
  OutputRows& output;
  StepParameters* parameters;
  const SubstepLevels* levels;
  Mirror<StepCounters>& counted;
  Mechanisms mechanisms;   ///< that contacts push as a whole
  ContactCache now, last;  ///< contacts of this step, and of the last one
  StepCounters* counters = counted.device();
  Bodies bodies = movable;  ///< for the stages that only look at them

  [[nodiscard]] bool collides() const { return stages.features.collision; }
  [[nodiscard]] bool has_joints() const { return joints.count() != 0; }
  [[nodiscard]] bool finds_impacts() const { return continuous || stages.features.restitution; }
  /// Others than the default solver take errors of joints back by speeds that stay.
  [[nodiscard]] bool bounds_energy() const { return has_joints() && solver == SolverKind::kTgsSoft; }
  /// What is put in front of what it has passed through depends on how that has moved.
  [[nodiscard]] bool settles() const {
    return bounds_energy() && collides() && !continuous && joints.code() == JointCode::kAll;
  }
  /// Of the narrow phase.
  [[nodiscard]] Count candidates() const { return stages.narrow_phase.candidates(counters); }
  [[nodiscard]] NarrowPhaseWork narrow_phase_work() const {
    return {now, last, bodies, proxies, stages.margins.data(), parameters, continuous};
  }
  [[nodiscard]] SolverInput solver_input() const {
    return {now, movable, body_rows, proxies, joints, levels, parameters, counters, pair_capacity};
  }
  [[nodiscard]] EnergyWork energy_work() const {
    return {now,
            proxies,
            surface_velocities,
            stages.changes(),
            movable,
            stages.solver.joint_set(movable, counters, joints),
            joints.code(),
            body_rows,
            pair_capacity,
            parameters,
            counters,
            stages.solver.paces(),
            stages.solver.body_levels(),
            levels,
            settles()};
  }
};

/// Enqueues a step, from bounds to poses.
void enqueue_step(const StepContext& step);
/// Its two halves, where the host is shown what touches: between them it says what becomes of that.
void enqueue_detection(const StepContext& step);
void enqueue_response(const StepContext& step);

}  // namespace plumb::impulse
