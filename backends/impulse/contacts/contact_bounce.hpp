// Restitution: what came fast leaves again, and rubs while it is thrown back.
#pragma once

#include "contacts/contact_friction.hpp"
#include "contacts/contact_normals.hpp"

namespace plumb::impulse {

/// Rounds of normals and friction in which a contact bounces: what the softness of the block leaves falls by a factor
/// of 20 or more in each.
constexpr int kBounceRounds = 3;

/// Newton's restitution: a point that came faster than `slowest` and was pushed leaves with e times that speed. All
/// points of a manifold act at once where all of them bounce, so that what falls flat does not turn. The impulse that
/// throws a point back presses it on, too: by Coulomb's law it rubs as much more. Points that do not bounce keep their
/// impulses.
template <int P, class N>
PLUMB_HD void bounce_contact(const RowAccess<N>& row, Contact<P, N>& contact, SolverBody<N>& a, SolverBody<N>& b,
                             Real slowest, bool friction) {
  const N zero = N(0);
  const PointMask<P, N> bounces = contact.noted < N(-slowest) && contact.restitution > zero;
  contact.allowed_approach = select(bounces, contact.noted * contact.restitution, N(kHuge));
  const NormalTarget<P, N> target = {contact.allowed_approach, select_by_point(bounces, N(1), zero),
                                     for_all_points<P>(zero), for_all_points<P>(zero)};
  PerPoint<P, N> more[3];
  PLUMB_UNROLL
  for (int k = 0; k < 3; ++k) more[k] = -contact.impulse[k];
  ContactMotion<N> motion = motion_of(contact, a, b);
  ContactWrench<N> wrench = no_wrench<N>();
  for (int round = 0; round < kBounceRounds; ++round) {
    const auto held = solve_normals(contact, target, motion, wrench, false);
    if (friction) solve_friction_where(bounces, contact, motion, wrench, held);
  }
  if (friction) solve_normals(contact, target, motion, wrench, false);
  push(contact, wrench, a, b);
  PLUMB_UNROLL
  for (int k = 0; k < 3; ++k) more[k] = contact.impulse[k] + more[k];
  add_up_impulses(row, more);
}

/// The same as work on contacts.
struct BounceContact {
  Real slowest;
  bool friction;
  template <int P, class N>
  PLUMB_HD void operator()(const RowAccess<N>& row, Contact<P, N>& contact, SolverBody<N>& a, SolverBody<N>& b) const {
    bounce_contact(row, contact, a, b, slowest, friction);
    store_impulses(row, contact);
  }
};

}  // namespace plumb::impulse
