// The impacts of a step or sub-step, of the solvers that go through the contacts one after the other.
#pragma once

#include "contacts/contact_impact.hpp"
#include "exec/atomic.hpp"
#include "solver/solver_step.hpp"

namespace plumb::impulse {

/// Rounds of impacts at once. What strikes on after so many is stopped.
constexpr std::uint32_t kMostImpactRounds = 64;

PLUMB_HD inline ImpactLaw impact_law(const StepParameters& step, bool friction) {
  return {step.restitution_speed, step.h, step.inverse_h, friction};
}

/// Throws back what strikes within the sub-step that begins, until nothing does. round: counts those of a step.
template <bool kSurfaceEffects, bool kMechanisms>
PLUMB_DEVICE void solve_impacts(Team& team, const SolverStep& on, const StepParameters& step, std::uint32_t& round) {
  const ImpactLaw law = impact_law(step, on.features.friction);
  std::uint32_t* struck = &on.counters->impacts.struck;
  team.barrier();  // all have read what the rounds before left
  for (const std::uint32_t end = round + kMostImpactRounds; round < end;) {
    const std::uint32_t now = ++round;
    for_contacts<kSurfaceEffects, kMechanisms>(team, on.contacts, step.level, on.solver, BodyUse::kImpact,
                                               [=](const auto& row, auto& contact, auto& a, auto& b) {
                                                 if (!solve_impact(contact, a, b, law)) return;
                                                 add_up_impulses(row, contact.impulse);
                                                 atomic_max(struck, now);
                                               });
    team.barrier();
    if (*struck < now) return;
  }
}

}  // namespace plumb::impulse
