#include "solver/solver.hpp"

#include "constraints/prepare_contacts.hpp"
#include "exec/atomic.hpp"
#include "solver/contact_loops.hpp"
#include "solver/motion.hpp"

namespace plumb::impulse {

namespace {

struct BeginBody {
  Bodies bodies;
  SolverBodies solver;
  PLUMB_HD void operator()(std::uint32_t i) const { begin_body(bodies, solver, i); }
};

/// Sub-steps with soft constraints and relaxation ("soft step": Catto, "Solver2D", 2024; sub-stepping after Macklin et
/// al., "Small Steps in Physics Simulation", SCA 2019). In each sub-step velocities are solved with a soft bias against
/// overlap, positions moved, and velocities solved again without the bias, so that what it pushed does not stay.
struct StepSoftly {
  Bodies bodies;
  SolverBodies solver;
  ContactSet contacts;
  std::uint32_t body_count;
  SolverFeatures features;
  const StepParameters* parameters;
  StepCounters* counters;
  std::uint32_t pair_capacity;

  PLUMB_DEVICE void operator()(Team& team) const {
    if (counters->pairs > pair_capacity) return;  // the step will be repeated with more room
    const StepSoftly self = *this;
    const StepParameters step = *parameters;
    for (std::uint32_t k = 0; k < step.substeps; ++k) {
      const bool first = k == 0;
      team.each(body_count, [=](std::uint32_t i) { integrate_velocity(self.bodies, self.solver, step, first, i); });
      if (first) warm_start(team);
      solve_contacts(team, step, true);
      team.each(body_count, [=](std::uint32_t i) {
        integrate_position(self.bodies, self.solver, step, self.features.gyroscopic, i);
      });
      solve_contacts(team, step, false);
    }
    if (features.collision && features.restitution) bounce(team, step.restitution_speed);
    team.each(body_count, [=](std::uint32_t i) {
      if (!finish_body(self.bodies, self.solver, i)) atomic_add(&self.counters->nonfinite, 1U);
    });
  }

 private:
  PLUMB_DEVICE void warm_start(Team& team) const {
    if (!features.collision) return;
    for_contacts(team, contacts, solver, false,
                 [](const auto& row, int points, auto& a, auto& b) { warm_start_contact(row, points, a, b); });
  }
  PLUMB_DEVICE void solve_contacts(Team& team, const StepParameters& step, bool take_back_overlap) const {
    if (!features.collision) return;
    const ContactPass pass = {step.contact,
                              step.ground,
                              step.inverse_h,
                              step.push_speed,
                              take_back_overlap,
                              features.friction,
                              take_back_overlap && features.restitution};
    const bool add_up = !take_back_overlap && features.contact_impulses;
    for_contacts(team, contacts, solver, take_back_overlap,
                 [pass, add_up](const auto& row, int points, auto& a, auto& b) {
                   solve_normals(row, points, a, b, pass);
                   if (pass.friction) {
                     solve_friction(row, points, a, b);
                     solve_normals(row, points, a, b,
                                   pass);  // friction below the centre tilts a body: normals have the last word
                   }
                   if (add_up) add_up_impulses(row, points);
                 });
  }
  PLUMB_DEVICE void bounce(Team& team, Real slowest) const {
    for_contacts(team, contacts, solver, false, [slowest](const auto& row, int points, auto& a, auto& b) {
      bounce_contact(row, points, a, b, slowest);
    });
  }
};

}  // namespace

void Solver::reserve(Executor& /*executor*/, std::uint32_t bodies, std::uint32_t manifolds) {
  nobody_ = bodies - 1;
  slots_ = slots_for(manifolds);
  displacement_.grow(bodies);
  inertia_.grow(bodies);
  free_velocity_.grow(bodies);
  for (Buffer<std::uint32_t>* buffer : {&body_a_, &body_b_, &count_, &row_}) buffer->grow(slots_);
  if (features_.contact_impulses) step_impulses_.grow(manifolds);
  numbers_.grow(std::size_t{(slots_ + kRowBlock - 1) / kRowBlock} * kRowBlock * kAllFields);
}

void Solver::begin(Executor& executor, const Bodies& all, std::uint32_t body_count) {
  executor.run(body_count, BeginBody{all, bodies(all)});
}

void Solver::prepare(Executor& executor, const ContactCache& cache, const Bodies& all, const Proxies& proxies,
                     const Colouring& colouring, const StepParameters* parameters, StepCounters* counters) {
  const Count manifolds = {&counters->manifolds, slots_ - slots_for(0)};
  executor.run(manifolds, PrepareContacts{cache, all, proxies, bodies(all), rows(), counters, colouring.order(),
                                          colouring.colours(), parameters, nobody_});
  executor.run(kOverflow + 1, PadColours{rows(), counters, nobody_});
}

void Solver::solve(Executor& executor, const Bodies& all, std::uint32_t body_count, const StepParameters* parameters,
                   StepCounters* counters, std::uint32_t pair_capacity) {
  const Count load = {&counters->largest_colour, slots_};
  executor.team(
      load, body_count / 2,
      StepSoftly{all, bodies(all), {rows(), counters}, body_count, features_, parameters, counters, pair_capacity});
}

void Solver::keep_impulses(Executor& executor, const ContactCache& cache, StepCounters* counters) {
  executor.run(Count{&counters->first_slot[kColours + 1], slots_}, KeepImpulses{cache, rows(), step_impulses()});
}

}  // namespace plumb::impulse
