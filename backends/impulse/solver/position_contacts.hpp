// What the solver "xpbd" does to all contacts.
#pragma once

#include "contacts/contact_friction.hpp"
#include "contacts/contact_normals.hpp"
#include "contacts/contact_position.hpp"
#include "contacts/rolling_friction.hpp"
#include "solver/solver_step.hpp"

namespace plumb::impulse {

template <bool kSurfaceEffects>
struct PositionContacts : SolverStep {
  PLUMB_DEVICE void solve_positions(Team& team, const StepParameters& step) const;
  PLUMB_DEVICE void solve_velocities(Team& team) const;
};

/// kMoments: rolling friction takes part. Nothing but velocities sees it, so that what it holds on a slope creeps.
template <bool kMoments, int P, class N>
PLUMB_HD void solve_contact_once(const RowAccess<N>& row, Contact<P, N>& contact, SolverBody<N>& a, SolverBody<N>& b,
                                 bool friction) {
  const NormalTarget<P, N> target = hard_target(contact);
  ContactMotion<N> motion = motion_of(contact, a, b);
  ContactWrench<N> wrench = no_wrench<N>();
  solve_normals(contact, target, motion, wrench, false);
  solve_rolling_friction<kMoments>(row, contact, motion, wrench);
  const auto held = N(1) < N(0);  // no normals follow that could
  if (friction) solve_friction(contact, motion, wrench, held);
  push(contact, wrench, a, b);
  store_impulses(row, contact);
}

template <bool kSurfaceEffects>
PLUMB_DEVICE void PositionContacts<kSurfaceEffects>::solve_positions(Team& team, const StepParameters& step) const {
  const bool friction = features.friction;
  for_contacts<kSurfaceEffects>(
      team, contacts, 0, solver, BodyUse::kAll, [=](const auto& row, auto& contact, auto& a, auto& b) {
        start_contact_position(contact, a, b, step);
        const auto a_linear = a.linear, a_angular = a.angular, b_linear = b.linear, b_angular = b.angular;
        solve_contact_once<false>(row, contact, a, b, friction);
        displace(a, a_linear, a_angular, step.h);
        displace(b, b_linear, b_angular, step.h);
      });
}

template <bool kSurfaceEffects>
PLUMB_DEVICE void PositionContacts<kSurfaceEffects>::solve_velocities(Team& team) const {
  const bool friction = features.friction;
  for_contacts<kSurfaceEffects>(team, contacts, 0, solver, BodyUse::kVelocity,
                                [=](const auto& row, auto& contact, auto& a, auto& b) {
                                  start_contact_velocity(contact);
                                  start_moment<kSurfaceEffects>(row);
                                  solve_contact_once<kSurfaceEffects>(row, contact, a, b, friction);
                                  add_up_impulses(row, contact.impulse);
                                });
}

PLUMB_COMPILED_ONCE(struct PositionContacts<true>);

}  // namespace plumb::impulse
