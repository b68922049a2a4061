// What the solver "tgs_soft" does to all contacts.
#pragma once

#include "contacts/contact_friction.hpp"
#include "contacts/rolling_friction.hpp"
#include "solver/impacts.hpp"

namespace plumb::impulse {

/// kImpacts: something may bounce.
template <bool kSurfaceEffects, bool kMechanisms, bool kImpacts>
struct SoftContacts : SolverStep {
  /// What other levels have seen come is no matter.
  PLUMB_DEVICE void forget_strikes(Team& team) const;
  PLUMB_DEVICE void warm_start_contacts(Team& team, const StepParameters& step) const;
  /// Throws back what strikes in a sub-step, where the one before has seen it come. round: counts those of a step.
  PLUMB_DEVICE void bounce_contacts(Team& team, const StepParameters& step, std::uint32_t substep,
                                    std::uint32_t& round) const;
  /// Takes overlap back, softly. final: no relaxing pass follows in this sub-step.
  PLUMB_DEVICE void push_contacts(Team& team, const StepParameters& step, std::uint32_t substep, bool final) const;
  /// After the positions have moved: nothing that touches approaches, and what was pushed does not stay as velocity.
  /// final: no other pass follows in this sub-step.
  PLUMB_DEVICE void relax_contacts(Team& team, const StepParameters& step, bool final) const;
};

/// Friction below the centre tilts a body: the normals have the first word and the last.
template <bool kMoments, int P, class N>
PLUMB_HD void solve_contact_softly(const RowAccess<N>& row, Contact<P, N>& contact, const NormalTarget<P, N>& target,
                                   SolverBody<N>& a, SolverBody<N>& b, bool friction) {
  ContactMotion<N> motion = motion_of(contact, a, b);
  ContactWrench<N> wrench = no_wrench<N>();
  const auto held = solve_normals(contact, target, motion, wrench, false);
  solve_rolling_friction<kMoments>(row, contact, motion, wrench);
  if (friction) solve_friction(contact, motion, wrench, held);
  if (friction || (kMoments && row.has_moments())) solve_normals(contact, target, motion, wrench, false);
  push(contact, wrench, a, b);
}
/// A point that was apart and had to be pushed is no longer free to approach.
template <int P, class N>
PLUMB_HD void close_pushed(Contact<P, N>& contact) {
  contact.allowed_approach = select(contact.impulse[0] > N(0), N(0), contact.allowed_approach);
}

template <bool kSurfaceEffects, bool kMechanisms, bool kImpacts>
PLUMB_DEVICE void SoftContacts<kSurfaceEffects, kMechanisms, kImpacts>::forget_strikes(Team& team) const {
  if constexpr (kImpacts) {
    std::uint32_t* const about_to_strike = counters->impacts.about_to_strike;
    team.single([=] { about_to_strike[0] = about_to_strike[1] = 0; });
  }
}

template <bool kSurfaceEffects, bool kMechanisms, bool kImpacts>
PLUMB_DEVICE void SoftContacts<kSurfaceEffects, kMechanisms, kImpacts>::warm_start_contacts(
    Team& team, const StepParameters& step) const {
  for_contacts(team, contacts, step.level, solver, BodyUse::kVelocity,
               [](const auto& row, const auto& contact, auto& a, auto& b) {
                 warm_start_contact<kSurfaceEffects>(row, contact, a, b);
               });
}

template <bool kSurfaceEffects, bool kMechanisms, bool kImpacts>
PLUMB_DEVICE void SoftContacts<kSurfaceEffects, kMechanisms, kImpacts>::bounce_contacts(Team& team,
                                                                                        const StepParameters& step,
                                                                                        std::uint32_t substep,
                                                                                        std::uint32_t& round) const {
  if constexpr (kImpacts) {
    if (!features.restitution) return;
    team.barrier();
    if (substep == 0 || counters->impacts.about_to_strike[(substep - 1) % 2] == substep)
      solve_impacts<kSurfaceEffects, kMechanisms>(team, *this, step, round);
  }
}

template <bool kSurfaceEffects, bool kMechanisms, bool kImpacts>
PLUMB_DEVICE void SoftContacts<kSurfaceEffects, kMechanisms, kImpacts>::push_contacts(Team& team,
                                                                                      const StepParameters& step,
                                                                                      std::uint32_t substep,
                                                                                      bool final) const {
  const ContactSoftness softness = {step.contact, step.loaded, step.ground, step.inverse_h,
                                    step.max_depenetration_speed};
  const bool friction = features.friction, impacts = kImpacts && features.restitution;
  const ImpactLaw law = impact_law(step, friction);
  std::uint32_t* about_to_strike = &counters->impacts.about_to_strike[substep % 2];
  const bool mechanisms = kMechanisms && solver.mechanisms.count != 0;
  const BodyUse use = final ? BodyUse::kLastVelocityWhereMoved : BodyUse::kVelocityWhereMoved;
  for_contacts<kSurfaceEffects, kMechanisms>(
      team, contacts, step.level, solver, use, [=](const auto& row, auto& contact, auto& a, auto& b) {
        contact.noted = contact.impulse[0];
        if (mechanisms) store_noted(row, contact);
        if (impacts && in_any_contact(is_about_to_strike(contact, a, b, law))) atomic_max(about_to_strike, substep + 1);
        const auto target = soft_target(contact, a, b, softness);
        solve_contact_softly<kSurfaceEffects>(row, contact, target, a, b, friction);
        close_pushed(contact);
        store_impulses(row, contact);
        if (final) add_up_impulses(row, contact.impulse);
      });
}

template <bool kSurfaceEffects, bool kMechanisms, bool kImpacts>
PLUMB_DEVICE void SoftContacts<kSurfaceEffects, kMechanisms, kImpacts>::relax_contacts(Team& team,
                                                                                       const StepParameters& step,
                                                                                       bool final) const {
  const bool friction = features.friction;
  const BodyUse use = final ? BodyUse::kLastVelocity : BodyUse::kVelocity;
  for_contacts<kSurfaceEffects, kMechanisms>(
      team, contacts, step.level, solver, use, [=](const auto& row, auto& contact, auto& a, auto& b) {
        solve_contact_softly<kSurfaceEffects>(row, contact, hard_target(contact), a, b, friction);
        store_impulses(row, contact);
        if (final) add_up_impulses(row, contact.impulse);
      });
}

PLUMB_COMPILED_ONCE(struct SoftContacts<true, true, true>);

}  // namespace plumb::impulse
