// Impacts within a sub-step: who strikes somebody is thrown back at once, and may strike the next.
//
// Between two sub-steps a body is on its way along a parabola: the velocity with which it moves is that of their
// middle. So when a gap closes, and how fast, is known exactly, e = 1 gives back all of the energy, and who is thrown
// back goes on from there for the rest of the sub-step, as if it had come along its new way from the start. Of many
// bodies that touch each pair is thrown back by its own speed of now, one after the other and again until nobody
// strikes: no such impact makes energy, and so they don't together, where a law on the speeds before all impacts would
// ("Reflections on Simultaneous Impact", Smith et al., SIGGRAPH 2012, sections 2 and 3: the sequential law, which keeps
// energy and spreads it over who touches, and leaves open in which order).
#pragma once

#include "contacts/contact_bounce.hpp"

namespace plumb::impulse {

struct ImpactLaw {
  Real slowest;  ///< what comes no faster does not bounce, m/s
  Real h, inverse_h;
  bool friction;
};

/// How the points of a contact come closer in a sub-step.
template <int P, class N>
struct Approach {
  PointMask<P, N> bounces;  ///< those that are struck together
  PerPoint<P, N> came;      ///< their speeds then, m/s
  N time;                   ///< into the sub-step, s
};

template <int P, class N>
PLUMB_HD N smallest(const PerPoint<P, N>& x) {
  N least = from_point(0, x.at[0]);
  PLUMB_UNROLL
  for (int p = 1; p < P; ++p) least = min(least, from_point(p, x.at[index_of(p)]));
  return least;
}

/// Points that would touch up to a sub-step after the first are struck along with it, so that what falls flat, but for
/// rounding, does not turn. What forces alone bring about in two sub-steps rests. And what approaches because of what
/// held the bodies in the last sub-step does not strike: who is squeezed would be thrown to and fro, and the more so
/// the more often.
template <int P, class N>
PLUMB_HD Approach<P, N> approach_of(const Contact<P, N>& contact, const SolverBody<N>& a, const SolverBody<N>& b,
                                    const ImpactLaw& law) {
  const N zero = N(0), h = N(law.h);
  const PerPoint<P, N> closing = -speed_at(motion_of(contact, a, b).normal, contact.place);
  const PerPoint<P, N> gap = max(separations_now(contact, a, b), zero);
  const N resting = max(N(law.slowest), N(-2) * contact.pull);
  const PerPoint<P, N> slowest = max(N(Real(0.5)) * closing, for_all_points<P>(resting));
  const PointMask<P, N> fast =
      contact.there() && -contact.noted > slowest && closing > resting && contact.restitution > zero;
  const auto strikes = in_any_point(fast && closing * h > gap);
  const PerPoint<P, N> at_start = closing + N(Real(0.5)) * contact.pull;
  const N gain = N(-law.inverse_h) * contact.pull;  // of speed, m/s2
  const PerPoint<P, N> at_touch = sqrt(max(at_start * at_start + N(2) * gain * gap, zero));
  const PerPoint<P, N> touch = N(2) * gap / max(at_start + at_touch, N(Real(1e-30)));
  Approach<P, N> approach;
  approach.bounces = fast && closing * (N(2) * h) > gap && strikes;
  approach.time = smallest(select(approach.bounces, touch, N(kHuge)));
  approach.came = at_start + gain * approach.time;
  return approach;
}

/// The body has been on its way since the impact only.
template <class N, class M>
PLUMB_HD void go_back(SolverBody<N>& body, const SolverBody<N>& before, const M& strikes, const N& time) {
  const Quat4<N> now = body.rotated;
  displace(body, before.linear, before.angular, -time);
  body.rotated = {select(strikes, body.rotated.x, now.x), select(strikes, body.rotated.y, now.y),
                  select(strikes, body.rotated.z, now.z), select(strikes, body.rotated.w, now.w)};
}

/// Impulses found short of what stops the points by more than this are none: bodies that joints hold against each other
/// do not give way, whatever pushes them.
constexpr Real kMostShare = 4;

/// The normal impulses that stop the points which strike, times what gives back e of their speed: a reflection, whose
/// energy is what Newton's law says for any direction of the impulses, however well they have converged (Smith et al.,
/// section 5, "generalized reflections").
template <int P, class N>
PLUMB_HD void reflect(const Approach<P, N>& approach, Contact<P, N>& contact, ContactMotion<N>& motion,
                      ContactWrench<N>& wrench) {
  const N zero = N(0);
  const ContactMotion<N> before = motion;
  const PerPoint<P, N> speed = speed_at(before.normal, contact.place);
  const PerPoint<P, N> none = for_all_points<P>(zero);
  contact.allowed_approach = select(approach.bounces, -(speed + approach.came), N(kHuge));
  const NormalTarget<P, N> target = {contact.allowed_approach, select_by_point(approach.bounces, N(1), zero), none,
                                     none};
  for (PerPoint<P, N>& impulse : contact.impulse) impulse = none;
  for (int round = 0; round < kBounceRounds; ++round) solve_normals(contact, target, motion, wrench, false);
  const N gained = sum(contact.impulse[0] * (speed_at(motion.normal, contact.place) - speed));
  const N stopped = sum(contact.impulse[0] * approach.came);
  const N share = stopped / max(gained, N(Real(1e-30)));
  const N scale = select(share < N(kMostShare), (N(1) + contact.restitution) * share, zero);
  contact.impulse[0] = scale * contact.impulse[0];
  wrench = no_wrench<N>();
  add(wrench.normal, normal_wrench(contact.place, contact.impulse[0]));
  motion = before;
  apply_delassus(contact.delassus, wrench.normal, motion);
}

/// Throws back what strikes within this sub-step. Returns whether anything did. The contact's impulses are those of the
/// impact then, and none that acts again in the next sub-step. By Coulomb's law what presses a point rubs it, too.
template <int P, class N>
PLUMB_HD bool solve_impact(Contact<P, N>& contact, SolverBody<N>& a, SolverBody<N>& b, const ImpactLaw& law) {
  const Approach<P, N> approach = approach_of(contact, a, b, law);
  const auto strikes = in_any_point(approach.bounces);
  if (!in_any_contact(strikes)) return false;
  const SolverBody<N> a_before = a, b_before = b;
  ContactMotion<N> motion = motion_of(contact, a, b);
  ContactWrench<N> wrench = no_wrench<N>();
  reflect(approach, contact, motion, wrench);
  const auto held = N(1) < N(0);  // no normals follow that could
  if (law.friction) solve_friction_where(approach.bounces, contact, motion, wrench, held);
  push(contact, wrench, a, b);
  const N time = select(strikes, approach.time, N(0));
  go_back(a, a_before, strikes, time);
  go_back(b, b_before, strikes, time);
  return true;
}

/// Whether a point that bounces may touch in this sub-step or soon after: then impacts are looked for in the next.
template <int P, class N>
PLUMB_HD auto is_about_to_strike(const Contact<P, N>& contact, const SolverBody<N>& a, const SolverBody<N>& b,
                                 const ImpactLaw& law) {
  const PerPoint<P, N> closing = -speed_at(motion_of(contact, a, b).normal, contact.place);
  const PointMask<P, N> near = closing * N(4 * law.h) > separations_now(contact, a, b);
  return in_any_point(contact.there() && near && closing > N(law.slowest / 2) && contact.restitution > N(0));
}

}  // namespace plumb::impulse
