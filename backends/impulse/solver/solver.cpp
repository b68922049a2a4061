#include "solver/solver.hpp"

#include "bodies/motion_lanes.hpp"
#include "contacts/prepare_contacts.hpp"
#include "contacts/rolling_friction.hpp"
#include "solver/enqueue_step.hpp"
#include "solver/mechanism_mobility.hpp"

namespace plumb::impulse {

namespace {

struct BeginBody {
  Bodies bodies;
  SolverBodies solver;
  const StepParameters* parameters;
  const SubstepLevels* levels;
  PLUMB_HD void operator()(std::uint32_t i) const {
    const std::uint32_t level = solver.levels(i);
    begin_body(bodies, solver, *parameters, levels->of[level < kSubstepLevels ? level : 0].h, i);
  }
};

}  // namespace

void Solver::reserve(Executor& /*executor*/, std::uint32_t bodies, std::uint32_t manifolds) {
  sentinel_ = bodies - 1;
  slots_ = slots_for(manifolds);
  displacement_.grow(bodies);
  inertia_.grow(bodies);
  free_velocity_.grow(bodies);
  forces_.grow(bodies);
  paces_.grow(bodies);
  body_levels_.grow(bodies);
  loads_.grow(bodies);
  most_groups_ = body_groups(bodies);
  body_groups_.grow(std::size_t{kSubstepLevels + 1} * most_groups_);
  for (Buffer<std::uint32_t>* buffer : {&contacts_.body_a, &contacts_.body_b, &contacts_.count, &contacts_.row})
    buffer->grow(slots_ + 1);
  const std::size_t padded = std::size_t{slots_ / kRowBlock + 1} * kRowBlock;
  contacts_.numbers.grow(padded * kAllFields);
  if constexpr (kHandsOver) contacts_.turns.grow(slots_ + 1);
  if (features_.contact_impulses) {
    contacts_.sums.grow(padded * kSumFields);
    step_impulses_.grow(manifolds);
  }
  if (features_.rolling_friction) contacts_.moments.grow(padded * kMomentFields * kContactThreads);
  choose(kind_);
}

void Solver::choose(SolverKind kind) {
  kind_ = kind;
  if (kind == SolverKind::kSequential || kind == SolverKind::kJacobi) pass_changes_.grow(kMostPasses);
  if (kind == SolverKind::kJacobi) split_.reserve(sentinel_ + 1, slots_ - slots_for(0));
}

void Solver::begin(Executor& executor, const SolverInput& input) {
  executor.run(input.body_count,
               BeginBody{input.bodies, bodies(input.bodies, input.counters), input.parameters, input.levels});
}

void Solver::choose_substeps(Executor& executor, const SolverInput& input, const std::uint64_t* masks,
                             const SettledBody* settled) {
  if (!has_levels()) return;
  enqueue_levels(executor,
                 {input.cache,
                  input.bodies,
                  input.proxies,
                  mechanisms_,
                  input.joints.device(),
                  input.joints.count(),
                  input.body_count,
                  input.pair_capacity,
                  input.levels,
                  input.parameters,
                  input.counters,
                  paces_.data(),
                  body_levels_.data(),
                  loads_.data(),
                  body_groups_.data(),
                  most_groups_,
                  masks,
                  settled,
                  input.joints.least_moments(),
                  features_.gyroscopic},
                 {&input.counters->manifolds, input.pair_capacity});
}

const Mechanisms& Solver::take_mechanisms(JointStore& joints) {
  const bool soft = kind_ == SolverKind::kTgsSoft;
  mechanisms_ = soft && features_.collision ? joints.mechanisms() : Mechanisms{};
  tumbling_ = Tumbling::kNobody;
  if (features_.gyroscopic)
    tumbling_ = Tumbling::kAll;
  else if (soft && (features_.collision || joints.count() == 0))
    tumbling_ = Tumbling::kFastOnes;
  return mechanisms_;
}

void Solver::find_mobility(Executor& executor, const SolverInput& input) {
  enqueue_mobility(executor, input.joints.code(),
                   {joint_set(input.bodies, input.counters, input.joints), mechanisms_, input.joints.mobility_scratch(),
                    input.cache, input.proxies.rows, input.parameters, input.levels, input.counters},
                   {&input.counters->manifolds, slots_});
}

void Solver::prepare(Executor& executor, const SolverInput& input, const Colouring& colouring, const PairTime* impacts,
                     const ManifoldChanges& changes) {
  const Count slots = {&input.counters->slots, slots_};
  const bool split = kind_ == SolverKind::kJacobi;
  if (split) split_.list(executor, input.cache, input.bodies.velocity, input.proxies.rows, input.counters);
  const auto prepare = [&]<bool kImpacts, bool kMechanisms>() {
    executor.run(slots, PrepareContacts<kImpacts, kMechanisms>{
                            input.cache, input.bodies, input.proxies, bodies(input.bodies, input.counters), rows(),
                            input.counters, colouring.order(), colouring.masks(), input.parameters, input.levels,
                            sentinel_, split ? split_.parts().ranges : nullptr, impacts, changes});
  };
  const bool whole = mechanisms_.count != 0;
  if (impacts == nullptr)
    whole ? prepare.operator()<false, true>() : prepare.operator()<false, false>();
  else
    whole ? prepare.operator()<true, true>() : prepare.operator()<true, false>();
}

void Solver::solve(Executor& executor, const SolverInput& input) {
  const Count load = {&input.counters->longest_loop, contact_loop(slots_)};
  const SolverStep step = {input.bodies,
                           bodies(input.bodies, input.counters),
                           {rows(), input.counters, features_.surface_velocity, input.parameters, input.levels},
                           input.body_count,
                           features_,
                           input.parameters,
                           input.counters,
                           input.pair_capacity,
                           joint_set(input.bodies, input.counters, input.joints),
                           input.levels,
                           body_groups_.data(),
                           most_groups_};
  const std::uint32_t least = max(input.body_count / 2, step.joints.system.small_count * Executor::kGroupThreads);
  const StepWork work = {step, pass_changes_.data(), split_.parts(), kind_, load, least};
  if constexpr (Executor::kWarps) {
    if (features_.has_surface_effects()) return enqueue_step_with_surface_effects(executor, work);
  }
  switch (features_.has_surface_effects() ? JointCode::kAll : input.joints.code()) {
    case JointCode::kContacts: return enqueue_step<JointCode::kContacts>(executor, work);
    case JointCode::kPlain: return enqueue_step<JointCode::kPlain>(executor, work);
    case JointCode::kAll: return enqueue_step_with_axes(executor, work);
  }
}

void Solver::keep_impulses(Executor& executor, const ContactCache& cache, StepCounters* counters) {
  executor.run(Count{&counters->slots, slots_}, KeepImpulses{cache, rows(), step_impulses()});
  if (features_.rolling_friction) keep_moments(executor, cache, rows(), counters, slots_);
}

}  // namespace plumb::impulse
