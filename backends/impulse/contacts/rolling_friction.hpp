// Rolling and spinning friction: a moment of the contact, for what touches at a point and in truth at a patch.
//
//      w               M <= rho N   against the turn along the tangents, N being the normal force: a ball that rolls
//     .-->.            T <= sigma N against the turn about the normal: one that spins on the spot
//    (  o  ) N ^
//   ---`-'-----       rho, sigma: lengths, m; of two bodies the larger counts
//
// The moment along the tangents is one vector, within a circle, so that what rolls slows down along its way whichever
// that is, and stays where the slope is below rho / r (Tasora and Anitescu, "A complementarity-based rolling friction
// model for rigid contacts", Meccanica 48, 2013). It is solved in the contact's frame, between the normals and the
// friction: what stops the turn where that is within the circle, else a step against it, cut to the circle, whose limit
// is opposite to the turn (maximum dissipation, as contact_friction.hpp has it).
//
// Moments have rows of their own, and so has the step that reads them its kernel on a GPU: a world that declares no
// rolling friction has neither. There each of the threads that share a contact keeps a copy, so that none waits for
// another.
#pragma once

#include "bodies/body.hpp"
#include "bodies/body_level.hpp"
#include "bodies/step_counters.hpp"
#include "contacts/contact.hpp"
#include "contacts/contact_matrix.hpp"
#include "exec/executor.hpp"
#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// An impulse: along tangent and bitangent, and about the normal, N m s.
template <class N>
struct ContactMoment {
  N about_t1, about_t2, about_n;
};
template <class N>
PLUMB_HD ContactMoment<N> moment_of(const RowAccess<N>& row) {
  return {row.moment(kMoment), row.moment(kMoment + 1), row.moment(kMoment + 2)};
}

/// No moment yet, of solvers whose impulses start at 0 in each sub-step.
template <bool kMoments, class N>
PLUMB_HD void start_moment([[maybe_unused]] const RowAccess<N>& row) {
  if constexpr (kMoments) {
    for (std::uint32_t f = 0; row.has_moments() && f < 3; ++f) row.put_moment(kMoment + f, N(0));
  }
}

/// Applies what the last step ended with. kMoments: there may be moments.
template <bool kMoments, int P, class N>
PLUMB_HD void warm_start_contact(const RowAccess<N>& row, const Contact<P, N>& contact, SolverBody<N>& a,
                                 SolverBody<N>& b) {
  ContactWrench<N> wrench = wrench_of(contact);
  if (kMoments && row.has_moments()) {
    const ContactMoment<N> moment = moment_of(row);
    add(wrench.normal, {N(0), moment.about_t1, moment.about_t2});
    add(wrench.friction, {N(0), N(0), moment.about_n});
  }
  push(contact, wrench, a, b);
}

/// The moment along the tangents that stops a turn, within a circle.
template <int P, class N>
PLUMB_HD void stop_rolling(const Contact<P, N>& contact, const ContactMotion<N>& motion, const N& most,
                           ContactMoment<N>& moment) {
  const N zero = N(0), one = N(1), two = N(2), tiny = N(Real(1e-30));
  const N w1 = motion.normal.about_t1, w2 = motion.normal.about_t2;
  const N m11 = contact.delassus.normal[3], m12 = contact.delassus.normal[4], m22 = contact.delassus.normal[5];
  const N product = m11 * m22, volume = product - m12 * m12;
  const N inverse = one / max(volume, tiny);
  const N stop1 = moment.about_t1 - inverse * (m22 * w1 - m12 * w2);
  const N stop2 = moment.about_t2 - inverse * (m11 * w2 - m12 * w1);
  const auto stops =
      product > tiny && volume > N(kLeastVolume) * product && !(stop1 * stop1 + stop2 * stop2 > most * most);

  const N half = (m11 - m22) / two, largest = (m11 + m22) / two + sqrt(half * half + m12 * m12);
  const N step = select(largest > N(kLeastSpin), one / max(largest, N(kLeastSpin)), zero);
  const N push1 = moment.about_t1 - step * w1, push2 = moment.about_t2 - step * w2;
  const N scale = min(one, most / max(sqrt(push1 * push1 + push2 * push2), tiny));
  moment.about_t1 = select(stops, stop1, scale * push1);
  moment.about_t2 = select(stops, stop2, scale * push2);
}

/// The moment about the normal that stops a turn, up to a bound.
template <int P, class N>
PLUMB_HD void stop_spinning(const Contact<P, N>& contact, const ContactMotion<N>& motion, const N& most,
                            ContactMoment<N>& moment) {
  const N spin = contact.delassus.friction[5];
  const N step = select(spin > N(kLeastSpin), N(1) / max(spin, N(kLeastSpin)), N(0));
  moment.about_n = max(-most, min(moment.about_n - step * motion.friction.about_n, most));
}

/// One pass, with the normal impulses of now.
template <bool kMoments, int P, class N>
PLUMB_HD void solve_rolling_friction([[maybe_unused]] const RowAccess<N>& row, const Contact<P, N>& contact,
                                     ContactMotion<N>& motion, ContactWrench<N>& wrench) {
  if (!kMoments || !row.has_moments()) return;
  const N load = sum(contact.impulse[0]);
  const ContactMoment<N> before = moment_of(row);
  ContactMoment<N> moment = before;
  stop_rolling(contact, motion, row.moment(kMostMoment) * load, moment);
  stop_spinning(contact, motion, row.moment(kMostMoment + 1) * load, moment);
  row.put_moment(kMoment, moment.about_t1);
  row.put_moment(kMoment + 1, moment.about_t2);
  row.put_moment(kMoment + 2, moment.about_n);
  const NormalPart<N> rolling = {N(0), moment.about_t1 - before.about_t1, moment.about_t2 - before.about_t2};
  const FrictionPart<N> spinning = {N(0), N(0), moment.about_n - before.about_n};
  apply_delassus(contact.delassus, rolling, motion);
  apply_delassus(contact.delassus, spinning, motion);
  add(wrench.normal, rolling);
  add(wrench.friction, spinning);
}

/// What put_moments works with.
struct MomentWork {
  ContactCache cache;
  Bodies bodies;
  Proxies proxies;
  const RollingFriction* rolling_frictions;  ///< by body
  const std::uint32_t *order, *keys;         ///< as of Colouring
  ContactRows rows;
  const StepCounters* counters;
  const StepParameters* parameters;
  BodyLevels levels;
};
/// Puts the moments of the last step, and how large they may be, into the rows of all contacts, which are prepared and
/// of which there are no more than `capacity`.
void put_moments(Executor& executor, const MomentWork& work, std::uint32_t capacity);
/// Writes them back to the contact cache; of no more slots than `capacity`.
void keep_moments(Executor& executor, const ContactCache& cache, const ContactRows& rows, const StepCounters* counters,
                  std::uint32_t capacity);

}  // namespace plumb::impulse
