// Contacts of bodies that have moved already: position-based dynamics over the rows of contact.hpp.
//
// An impulse at the level of positions moves a body by what it would move in the sub-step with the velocity that the
// impulse gives, and it gives that velocity too. So positions and velocities stay a sub-step's way from each other, and
// velocities need not be formed from differences of positions.
#pragma once

#include "contacts/contact.hpp"

namespace plumb::impulse {

/// Starts a sub-step's impulses at 0 (compliance 0) and sets `allowed_approach`: what a point's relative speed must
/// lose so that it ends the sub-step without overlap. Overlap from before is taken back no faster than
/// max_depenetration_speed.
template <int P, class N>
PLUMB_HD void start_contact_position(Contact<P, N>& contact, const SolverBody<N>& a, const SolverBody<N>& b,
                                     const StepParameters& step) {
  const PerPoint<P, N> before =
      separations_now(contact, a, b) * N(step.inverse_h) - speed_at(motion_of(contact, a, b).normal, contact.place);
  contact.allowed_approach = max(before, N(-step.max_depenetration_speed));
  for (PerPoint<P, N>& impulse : contact.impulse) impulse = for_all_points<P>(N(0));
}

/// Sets `allowed_approach` for the pass at the level of velocities: what was pushed does not leave, so that what took
/// back overlap does not stay as velocity; what was not pushed is let be.
template <int P, class N>
PLUMB_HD void start_contact_velocity(Contact<P, N>& contact) {
  contact.allowed_approach = select_by_point(contact.impulse[0] > N(0), N(0), N(kHuge));
}

}  // namespace plumb::impulse
