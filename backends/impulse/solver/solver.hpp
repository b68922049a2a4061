// The solver's memory, and its stages of a step.
#pragma once

#include "bodies/body.hpp"
#include "bodies/solver_bodies.hpp"
#include "bodies/step_counters.hpp"
#include "bodies/step_parameters.hpp"
#include "contacts/colouring.hpp"
#include "contacts/contact_rows.hpp"
#include "contacts/hand_over.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "joints/joint_store.hpp"
#include "narrowphase/contact_cache.hpp"
#include "narrowphase/manifold_change.hpp"
#include "solver/choose_substeps.hpp"
#include "solver/pass_change.hpp"
#include "solver/split_bodies.hpp"

namespace plumb::impulse {

/// What the scene asks for; the rest is left out.
struct SolverFeatures {
  bool rotation, collision, friction, restitution, gyroscopic, contact_impulses;
  bool sleeping = false, continuous = false, surface_velocity = false, contact_modification = false;
  bool rolling_friction = false;

  /// What only the code for all joints has beside it.
  [[nodiscard]] bool has_surface_effects() const { return surface_velocity || rolling_friction; }
};

/// What all stages of a step work on.
struct SolverInput {
  ContactCache cache;
  MovableBodies bodies;
  std::uint32_t body_count;
  Proxies proxies;
  JointStore& joints;
  const SubstepLevels* levels;
  const StepParameters* parameters;
  StepCounters* counters;
  std::uint32_t pair_capacity;
};

class Solver {
 public:
  explicit Solver(const SolverFeatures& features) : features_(features) {}
  void reserve(Executor& executor, std::uint32_t bodies, std::uint32_t manifolds);
  /// Which solver works from now on. Memory that only it needs is made here.
  void choose(SolverKind kind);
  [[nodiscard]] bool needs_colours() const { return kind_ != SolverKind::kJacobi; }

  /// The whole step of bodies among which there are no constraints: without the stages below.
  void move_freely(Executor& executor, const MovableBodies& bodies, std::uint32_t body_count,
                   const StepParameters* parameters, StepCounters* counters);

  /// How many sub-steps each island has, by what its contacts bear. masks, settled: as of LoadWork.
  void choose_substeps(Executor& executor, const SolverInput& input, const std::uint64_t* masks,
                       const SettledBody* settled);
  /// What a body has, if bodies have their own.
  [[nodiscard]] BodyLevels levels(const StepCounters* counters) const {
    return has_levels() ? BodyLevels(body_levels_.data(), counters) : BodyLevels();
  }
  /// From step to step.
  [[nodiscard]] BodyPace* paces() { return paces_.data(); }
  [[nodiscard]] const BodyLevel* body_levels() const { return has_levels() ? body_levels_.data() : nullptr; }
  void exchange(Archive& archive, std::size_t bodies) { archive.rows_of_all(paces_, bodies); }
  /// World inertia of all bodies, what forces do to them in a sub-step, no displacement.
  void begin(Executor& executor, const SolverInput& input);
  /// The mechanisms that contacts push as a whole, as far as this solver does that; and which bodies tumble.
  const Mechanisms& take_mechanisms(JointStore& joints);
  /// Of those that touch something.
  void find_mobility(Executor& executor, const SolverInput& input);
  /// Contacts into rows, in the order of their colours. impacts: Impacts::times(), or null.
  void prepare(Executor& executor, const SolverInput& input, const Colouring& colouring, const PairTime* impacts,
               const ManifoldChanges& changes);
  /// The joints with what their kernels work on.
  [[nodiscard]] JointSet joint_set(const MovableBodies& all, const StepCounters* counters, JointStore& joints) {
    return joints.set(all, bodies(all, counters));
  }
  /// Moves the bodies through the step.
  void solve(Executor& executor, const SolverInput& input);
  void keep_impulses(Executor& executor, const ContactCache& cache, StepCounters* counters);

  /// How far bodies moved in the last step, by body.
  [[nodiscard]] Displacement* displacements() { return displacement_.data(); }
  /// By row of the contact cache; null unless asked for.
  [[nodiscard]] StepImpulses* step_impulses() { return step_impulses_.data(); }

  [[nodiscard]] ContactRows rows() {
    return {contacts_.body_a.data(),  contacts_.body_b.data(),  contacts_.count.data(),
            contacts_.row.data(),     contacts_.numbers.data(), contacts_.sums.data(),
            contacts_.moments.data(), contacts_.turns.data(),   slots_};
  }

 private:
  SolverBodies bodies(const MovableBodies& bodies, const StepCounters* counters) {
    return {bodies.velocity, displacement_.data(), inertia_.data(), free_velocity_.data(), forces_.data(),
            tumbling_,       mechanisms_,          levels(counters)};
  }
  /// Others than this one have the same sub-steps for all.
  [[nodiscard]] bool has_levels() const { return kind_ == SolverKind::kTgsSoft && features_.collision; }

  /// Of ContactRows.
  struct ContactMemory {
    Buffer<std::uint32_t> body_a, body_b, count, row;
    Buffer<Real> numbers;
    Buffer<ContactTurns> turns;  // on a GPU
    Buffer<Real> sums;           // of the step's impulses, where somebody asks
    Buffer<Real> moments;        // in worlds with rolling friction
  };

  SolverFeatures features_;
  SolverKind kind_ = SolverKind::kTgsSoft;
  // Of the step that is being enqueued.
  Mechanisms mechanisms_{};
  Tumbling tumbling_ = Tumbling::kNobody;
  std::uint32_t slots_ = 0, sentinel_ = 0, most_groups_ = 0;
  Buffer<Displacement> displacement_;
  Buffer<WorldInertia> inertia_;
  Buffer<FreeVelocity> free_velocity_;
  Buffer<SubstepForces> forces_;
  Buffer<BodyPace> paces_;
  Buffer<BodyLevel> body_levels_;
  Buffer<IslandLoad> loads_;
  Buffer<std::uint32_t> body_groups_;  // as of LoadWork
  ContactMemory contacts_;
  Buffer<StepImpulses> step_impulses_;
  Buffer<PassChange> pass_changes_;  // of si and jacobi
  SplitBodies split_;                // of jacobi
};

}  // namespace plumb::impulse
