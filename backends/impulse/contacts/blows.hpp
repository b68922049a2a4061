// What tells a blow at a contact from a lasting push: with what speed its bodies came together, and of the impulse of a
// sub-step the part that must not act again in the next. How contacts are solved is not said here.
#pragma once

#include "contacts/body_lanes.hpp"
#include "contacts/contact.hpp"

namespace plumb::impulse {

/// With what velocity the points of a contact come together by what moves the bodies freely.
template <int P, class N>
PLUMB_HD void put_impact_speed(const SolverBodies& bodies, const std::uint32_t* body_a, const std::uint32_t* body_b,
                               SolverBody<N> a, SolverBody<N> b, Contact<P, N>& contact) {
  load_free_velocity(bodies, body_a, a);
  load_free_velocity(bodies, body_b, b);
  contact.noted = speed_at(motion_of(contact, a, b).normal, contact.place);
}

/// What presses on a contact by more than so many times the weight there, and twice as much as in the sub-step before,
/// is a blow. Where nothing weighs: acceleration by which other things press, m/s2.
constexpr Real kWeightsOfBlow = 8, kLeastFall = 10;
/// A contact on a mechanism lets go of what a blow called for, so that it does not act again in the next sub-step:
/// contacts and joints would undo in turn what acts for nothing, and where limits stop a mechanism (on which contacts
/// don't count) what they leave of it makes energy.
template <int P, class N>
PLUMB_HD void let_go_of_blow(const SolverBodies& bodies, const std::uint32_t* body_a, const std::uint32_t* body_b,
                             const RowAccess<N>& row, Contact<P, N>& contact, const StepParameters& step,
                             const SubstepLevels& levels) {
  const N zero = N(0);
  const Real falls = kWeightsOfBlow * max(length(step.gravity), kLeastFall);
  N fall = zero;  // in a sub-step, of what is joined
  for (std::uint32_t lane = 0; lane < kLanesIn<N>; ++lane) {
    const std::uint32_t body = bodies.mechanisms.hold(body_a[lane]) ? body_a[lane] : body_b[lane];
    if (bodies.mechanisms.hold(body)) lane_of(fall, lane) = levels.of[bodies.levels(body)].h * falls;
  }
  const N weight = fall / max(contact.delassus.normal[0], N(Real(1e-30)));
  const PerPoint<P, N> pressed = contact.impulse[0], most = N(2) * contact.noted + for_all_points<P>(weight);
  const PointMask<P, N> struck = contact.there() && pressed > most && fall > zero;
  if (!in_any_contact(in_any_point(struck))) return;
  const PerPoint<P, N> share = select(struck, most / max(pressed, N(Real(1e-30))), N(1));
  PerPoint<P, N> let_go[3];
  PLUMB_UNROLL
  for (int k = 0; k < 3; ++k) {
    const PerPoint<P, N> before = contact.impulse[k];
    contact.impulse[k] = share * before;
    let_go[k] = before - contact.impulse[k];
  }
  store_impulses(row, contact);
  SolverBody<N> a = load_body<N>(bodies, body_a, false), b = load_body<N>(bodies, body_b, false);
  a.linear = a.angular = b.linear = b.angular = {zero, zero, zero};
  const SolverBody<N> a_before = a, b_before = b;
  push(contact, {normal_wrench(contact.place, let_go[0]), friction_wrench(contact.place, let_go[1], let_go[2])}, a, b);
  if (holds_point(0)) store_free_velocity<N>(bodies, body_a, a, a_before);
  if (holds_point(1)) store_free_velocity<N>(bodies, body_b, b, b_before);
}

}  // namespace plumb::impulse
