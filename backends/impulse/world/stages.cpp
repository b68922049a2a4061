#include "world/stages.hpp"

#include "bodies/proxy_bounds.hpp"
#include "contacts/match.hpp"
#include "contacts/rolling_friction.hpp"
#include "contacts/surface_velocity.hpp"
#include "narrowphase/inner_edges.hpp"
#include "narrowphase/manifold_reduction.hpp"
#include "narrowphase/sweep_rims.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

struct ClearCounters {
  StepCounters* counters;
  PLUMB_HD void operator()(std::uint32_t) const { *counters = StepCounters{}; }
};

}  // namespace

void Stages::reserve(Executor& executor, std::uint32_t bodies, std::uint32_t proxies, std::uint32_t pairs) {
  pair_capacity = pairs;
  boxes.grow(proxies);
  margins.grow(proxies);
  broad_phase.reserve(executor, proxies, proxies, pairs);
  narrow_phase.reserve(executor, proxies, pairs);
  if (features.continuous || features.restitution) impacts.reserve(pairs);
  if (features.continuous) clamp.reserve(bodies);
  if (uses_midphase) midphase.reserve(proxies, pairs);
  if (modifies_contacts) modification.reserve(pairs);
  colouring.reserve(executor, bodies, pairs);
  solver.reserve(executor, bodies, pairs);
  if (kAsserts) validation.reserve(bodies);
}

void begin(const StepContext& step) {
  step.stages.phases.start(step.executor);
  step.executor.run(1U, ClearCounters{step.counters});
  remember_still(step);
}

void end_phase(const StepContext& step, PlumbPhase phase) { step.stages.phases.end(step.executor, phase); }

void bound(const StepContext& step) {
  step.executor.run(step.movers.count, BoundProxies{step.bodies, step.proxies, step.parameters, step.movers.rows,
                                                    step.stages.boxes.data(), step.stages.margins.data()});
}

void find_pairs(const StepContext& step) {
  Stages& of = step.stages;
  const PairList found = {step.uses_midphase ? of.midphase.pairs() : step.now.pairs,
                          step.uses_midphase ? of.midphase.ranges() : step.now.ranges, &step.counters->pairs};
  of.broad_phase.find_pairs(step.executor, of.boxes.data(), step.movers, step.filter, found);
}

void midphase(const StepContext& step) {
  if (!step.uses_midphase) return;
  Stages& of = step.stages;
  of.midphase.find(step.executor, {step.narrow_phase_work(), step.filter, of.boxes.data(), step.movers, step.planes},
                   step.counters, step.continuous);
}

void collide(const StepContext& step) {
  step.stages.narrow_phase.collide(step.executor, step.narrow_phase_work(), step.shape_types, step.counters);
  if (may_have_inner_edges(step.statics.count, step.shape_types))
    drop_inner_edges(step.executor, step.candidates(), step.now, step.bodies, step.proxies, step.filter,
                     step.stages.broad_phase.statics(), step.parameters);
  if (step.bodies.turn && (step.shape_types & bit_of(ShapeType::kCylinder)) != 0)
    sweep_rims(step.executor, step.candidates(), step.now, step.bodies, step.proxies, step.parameters);
}

void find_impacts(const StepContext& step) {
  if (!step.finds_impacts()) return;
  Stages& of = step.stages;
  of.impacts.find(step.executor, step.candidates(), step.narrow_phase_work(), step.uses_midphase);
  of.narrow_phase.collide_again(step.executor, step.narrow_phase_work(), step.shape_types, step.counters,
                                of.impacts.times());
}

void reduce_manifolds(const StepContext& step) {
  constexpr std::uint32_t kSurfaces = bit_of(ShapeType::kMesh) | bit_of(ShapeType::kHeightField);
  if ((step.shape_types & kSurfaces) == 0) return;
  reduce_manifolds(step.executor, step.candidates(), step.narrow_phase_work(),
                   step.finds_impacts() ? step.stages.impacts.times() : nullptr);
}

void show_manifolds(const StepContext& step) {
  if (!step.stages.modifies_contacts) return;
  step.stages.modification.show(step.executor,
                                {step.now, step.candidates(), step.bodies, step.proxies, step.surface_velocities});
  step.executor.to_host(step.counted, 1);
}

void modify_manifolds(const StepContext& step) {
  if (!step.stages.modifies_contacts) return;
  step.stages.modification.disable(step.executor, step.now, step.candidates());
}

void match(const StepContext& step) {
  Stages& of = step.stages;
  of.narrow_phase.number(step.executor, step.now, step.counters);
  of.colouring.begin(step.executor);
  match(step.executor,
        {step.now, step.last, step.woken, step.bodies, step.proxies, step.parameters, step.counters, step.mechanisms,
         of.colouring.masks()},
        step.pair_capacity);
  if (step.has_sleepers)
    step.sleep.find_touched(step.executor, step.now, step.pair_capacity, step.bodies, step.proxies, step.counters);
}

void choose_substeps(const StepContext& step) {
  step.stages.solver.choose_substeps(step.executor, step.solver_input(), step.stages.colouring.masks(),
                                     step.settles() ? step.stages.energy_bound.settled_bodies() : nullptr);
}

void colour(const StepContext& step) {
  Colouring& colouring = step.stages.colouring;
  if (step.stages.solver.needs_colours())
    colouring.colour(step.executor, step.now, step.bodies.velocity, step.proxies.rows, step.mechanisms,
                     step.stages.solver.levels(step.counters), step.counters);
  else
    colouring.leave_out(step.executor, step.counters);
}

void prepare(const StepContext& step) {
  Stages& of = step.stages;
  of.solver.begin(step.executor, step.solver_input());
  if (!step.collides()) return;
  if (step.mechanisms.count != 0) of.solver.find_mobility(step.executor, step.solver_input());
  of.solver.prepare(step.executor, step.solver_input(), of.colouring,
                    step.finds_impacts() ? of.impacts.times() : nullptr, of.changes());
  if (step.surface_velocities != nullptr)
    put_surface_speeds(step.executor,
                       {step.now, step.bodies, step.proxies, step.surface_velocities, of.colouring.order(),
                        of.colouring.keys(), of.solver.rows(), step.counters, of.changes()},
                       step.pair_capacity);
  if (step.rolling_frictions != nullptr)
    put_moments(step.executor,
                {step.now, step.bodies, step.proxies, step.rolling_frictions, of.colouring.order(), of.colouring.keys(),
                 of.solver.rows(), step.counters, step.parameters, of.solver.levels(step.counters)},
                step.pair_capacity);
}

void keep_state(const StepContext& step) {
  if (step.bounds_energy()) step.stages.energy_bound.keep(step.executor, step.energy_work());
}

void solve(const StepContext& step) { step.stages.solver.solve(step.executor, step.solver_input()); }

void clamp(const StepContext& step) {
  if (!step.continuous) return;
  Stages& of = step.stages;
  of.clamp.clamp(step.executor,
                 {step.now, step.candidates(), step.pair_capacity, step.counters, step.parameters, step.proxies,
                  of.boxes.data(), step.movers, of.broad_phase.statics(), step.planes, of.changes()},
                 step.movable, step.body_rows, of.solver.displacements());
}

void judge(const StepContext& step) {
  if (!step.bounds_energy()) return;
  step.stages.energy_bound.judge(step.executor, step.energy_work(), {&step.counters->manifolds, step.pair_capacity});
}

void keep_impulses(const StepContext& step) {
  if (step.collides()) step.stages.solver.keep_impulses(step.executor, step.now, step.counters);
}

void move_freely(const StepContext& step) {
  step.stages.solver.move_freely(step.executor, step.movable, step.body_rows, step.parameters, step.counters);
}

void time_rest(const StepContext& step) {
  if (!step.stages.features.sleeping) return;
  step.sleep.time_rest(step.executor, step.bodies, step.body_rows, step.parameters, step.counters, step.pair_capacity);
}

void write_output(const StepContext& step) {
  const auto write = [&](auto& rows) {
    if (rows.in_step()) rows.write(step.executor, step.bodies, step.frames, step.body_rows);
  };
  write(step.output.poses);
  write(step.output.velocities);
  step.executor.to_host(step.counted, 1);
}

}  // namespace plumb::impulse
