// Restitution: what came fast leaves again, and rubs while it is thrown back.
#pragma once

#include "constraints/contact_friction.hpp"
#include "constraints/contact_normals.hpp"

namespace plumb::impulse {

/// Rounds of normals and friction in which a contact bounces: what the softness of the block leaves falls by a factor
/// of 20 or more in each.
constexpr int kBounceRounds = 3;

/// Newton's restitution: a point that came faster than `slowest` and was pushed leaves with e times that speed. All
/// points of a manifold act at once where all of them bounce, so that what falls flat does not turn. The impulse that
/// throws a point back presses it on, too: by Coulomb's law it rubs as much more. Points that do not bounce keep their
/// impulses.
template <int P, class N>
PLUMB_HD void bounce_contact(const RowAccess<N>& row, Contact<N>& contact, SolverBody<N>& a, SolverBody<N>& b,
                             Real slowest, bool friction) {
  const N zero = N(0);
  ManifoldAim<N> aims;
  N before[P][3];
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    ContactPoint<N>& point = contact.points[p];
    const auto bounces = point.impact_speed < N(-slowest) && contact.restitution > zero;
    point.open = select(bounces, contact.restitution * point.impact_speed, N(kHuge));
    aims[p] = {point.open, select(bounces, point.normal_mass, zero), zero, zero};
    for (int i = 0; i < 3; ++i) before[p][i] = point.impulse[i];
  }
  for (int round = 0; round < kBounceRounds; ++round) {
    solve_normals<P>(contact, aims, a, b, false);
    if (friction) solve_friction_where<P>(contact, a, b, [&](int p) { return contact.points[p].open < zero; });
  }
  if (friction) solve_normals<P>(contact, aims, a, b, false);
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p)
    for (std::uint32_t i = 0; i < 3; ++i) row.add_to_sum(p, i, contact.points[p].impulse[i] - before[p][i]);
}

}  // namespace plumb::impulse
