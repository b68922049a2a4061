// What the solver "tgs_soft" does to all contacts.
#pragma once

#include "constraints/contact_bounce.hpp"
#include "constraints/contact_friction.hpp"
#include "solver/solver_step.hpp"

namespace plumb::impulse {

template <bool kBelts, bool kMechanisms>
struct SoftContacts : SolverStep {
  PLUMB_DEVICE void warm_start_contacts(Team& team) const;
  /// Takes overlap back, softly. final: no relaxing pass follows in this sub-step.
  PLUMB_DEVICE void push_contacts(Team& team, const StepParameters& step, bool final) const;
  /// After the positions have moved: nothing that touches approaches, and what was pushed does not stay as velocity.
  PLUMB_DEVICE void relax_contacts(Team& team) const;
  PLUMB_DEVICE void bounce_contacts(Team& team, Real slowest) const;
};

/// Friction below the centre tilts a body: the normals have the first word and the last.
template <int P, class N>
PLUMB_HD void solve_contact_softly(Contact<P, N>& contact, const ManifoldAim<P, N>& aim, SolverBody<N>& a,
                                   SolverBody<N>& b, bool friction, bool note_impacts) {
  ContactMotion<N> motion = motion_of(contact, a, b);
  ContactWrench<N> wrench = no_wrench<N>();
  const auto held = solve_normals(contact, aim, motion, wrench, note_impacts);
  if (friction) {
    solve_friction(contact, motion, wrench, held);
    solve_normals(contact, aim, motion, wrench, note_impacts);
  }
  push(contact, wrench, a, b);
}
/// A point that was apart and had to be pushed is no longer free to approach.
template <int P, class N>
PLUMB_HD void close_pushed(Contact<P, N>& contact) {
  contact.open = select(contact.impulse[0] > N(0), N(0), contact.open);
}

template <bool kBelts, bool kMechanisms>
PLUMB_DEVICE void SoftContacts<kBelts, kMechanisms>::warm_start_contacts(Team& team) const {
  for_contacts(team, contacts, solver, BodyUse::kVelocity,
               [](const auto& /*row*/, const auto& contact, auto& a, auto& b) { warm_start_contact(contact, a, b); });
}

template <bool kBelts, bool kMechanisms>
PLUMB_DEVICE void SoftContacts<kBelts, kMechanisms>::push_contacts(Team& team, const StepParameters& step,
                                                                   bool final) const {
  const ContactSoftness softness = {step.contact, step.ground, step.inverse_h, step.push_speed};
  const bool friction = features.friction, note_impacts = features.restitution;
  for_contacts<kBelts, kMechanisms>(team, contacts, solver, BodyUse::kVelocityWhereMoved,
                                    [=](const auto& row, auto& contact, auto& a, auto& b) {
                                      const auto aim = aim_softly(contact, a, b, softness);
                                      solve_contact_softly(contact, aim, a, b, friction, note_impacts);
                                      close_pushed(contact);
                                      store_impulses(row, contact);
                                      if (note_impacts) store_impact_speeds(row, contact);
                                      if (final) add_up_impulses(row, contact.impulse);
                                    });
}

template <bool kBelts, bool kMechanisms>
PLUMB_DEVICE void SoftContacts<kBelts, kMechanisms>::relax_contacts(Team& team) const {
  const bool friction = features.friction;
  for_contacts<kBelts, kMechanisms>(team, contacts, solver, BodyUse::kVelocity,
                                    [=](const auto& row, auto& contact, auto& a, auto& b) {
                                      solve_contact_softly(contact, aim_hard(contact), a, b, friction, false);
                                      store_impulses(row, contact);
                                      add_up_impulses(row, contact.impulse);
                                    });
}

template <bool kBelts, bool kMechanisms>
PLUMB_DEVICE void SoftContacts<kBelts, kMechanisms>::bounce_contacts(Team& team, Real slowest) const {
  const BounceContact bounce = {slowest, features.friction};
  for_contacts<kBelts, kMechanisms>(team, contacts, solver, BodyUse::kVelocity, bounce);
}

PLUMB_COMPILED_ONCE(struct SoftContacts<true, true>);

}  // namespace plumb::impulse
