// Normal impulses of a contact: overlap is taken back softly, by a damped spring integrated implicitly (Catto, "Soft
// Constraints", GDC 2011; "Solver2D", 2024).
#pragma once

#include "contacts/contact.hpp"

namespace plumb::impulse {

/// A point is deep whose overlap would be taken back at this speed, m/s, or faster. The deeper it is the softer, and at
/// twice that depth as soft as this: impulse_scale, and gamma in shares of the effective mass. A body that is squeezed
/// from two sides, by what a host has put there, would be pushed by either with ever more, up to thousands of its
/// weights, and a sweep over contacts whose normals turn leaves a part of that as velocity.
constexpr Real kDeepSpeed = Real(0.75), kImpulseScaleDeep = Real(0.5), kGammaDeep = Real(0.3);

/// How a pass over the contacts takes overlap back.
struct ContactSoftness {
  Softness between_alike, between_unlike, against_fixed;
  Real inverse_h;                ///< 1/s
  Real max_depenetration_speed;  ///< m/s
};

/// What the points' normal impulses have to bring about in a pass.
template <int P, class N>
struct NormalTarget {
  PerPoint<P, N> bias;           ///< wanted speed along the normal, with the other sign, m/s
  PerPoint<P, N> mass_scale;     ///< share of the effective mass that softness leaves
  PerPoint<P, N> impulse_scale;  ///< share of the impulse that softness takes off again
  PerPoint<P, N> gamma;  ///< impulse_scale over the effective mass: speed that the impulse may leave, m/s per N s
};

/// Speed along the normal at each point for a normal impulse there, 1/kg.
template <int P, class N>
PLUMB_HD PerPoint<P, N> own_delassus(const Contact<P, N>& contact) {
  return speed_at(apply_delassus_at(contact.delassus.normal, contact.place), contact.place);
}

/// A point that is apart may close its gap within the sub-step and no more; one that overlaps is taken back softly.
/// Notes in `allowed_approach` which points are apart.
template <int P, class N>
PLUMB_HD NormalTarget<P, N> soft_target(Contact<P, N>& contact, const SolverBody<N>& a, const SolverBody<N>& b,
                                        const ContactSoftness& softness) {
  const N zero = N(0), one = N(1);
  const auto movers = min(a.inverse_mass, b.inverse_mass) > zero, alike = alike_masses(a.inverse_mass, b.inverse_mass);
  const auto choose = [&](Real Softness::*member) {
    const N of_movers = select(alike, N(softness.between_alike.*member), N(softness.between_unlike.*member));
    return select(movers, of_movers, N(softness.against_fixed.*member));
  };
  const N rate = choose(&Softness::bias_rate), mass_scale = choose(&Softness::mass_scale);
  const N impulse_scale = choose(&Softness::impulse_scale), gamma = choose(&Softness::gamma);
  const PerPoint<P, N> separation = separations_now(contact, a, b);
  const PointMask<P, N> apart = separation > zero;
  const PerPoint<P, N> back = separation * rate;
  const PerPoint<P, N> deep = min(max(back * N(-1 / kDeepSpeed) - one, zero), one);
  contact.allowed_approach = select_by_point(apart, N(kHuge), zero);
  NormalTarget<P, N> target;
  target.bias = select(apart, separation * N(softness.inverse_h), max(back, N(-softness.max_depenetration_speed)));
  target.mass_scale = select_by_point(apart, one, mass_scale);
  target.impulse_scale = select(apart, zero, impulse_scale + deep * (N(kImpulseScaleDeep) - impulse_scale));
  target.gamma = select(apart, zero, own_delassus(contact) * (gamma + deep * (N(kGammaDeep) - gamma)));
  return target;
}

/// Without softness: each point may approach with the speed that `allowed_approach` says. In a pass that comes after
/// the positions have moved, so that what soft_target pushed does not stay as velocity, that is 0, or any where the
/// point is apart.
template <int P, class N>
PLUMB_HD NormalTarget<P, N> hard_target(const Contact<P, N>& contact) {
  const PerPoint<P, N> none = for_all_points<P>(N(0));
  return {contact.allowed_approach, for_all_points<P>(N(1)), none, none};
}

/// All points of a manifold at once, by the inverse of their matrix: exact where every point touches and none would
/// have to pull (after the block solver of Box2D: Catto, "Modeling and Solving Constraints", GDC 2009). Returns the
/// lanes where that holds. The points of a face that come down touch together, too: one after the other they would turn
/// it. Of an edge they do not, measured in impacts with friction.
template <int P, class N>
PLUMB_HD auto solve_normal_block(const Contact<P, N>& contact, const NormalTarget<P, N>& target,
                                 const PerPoint<P, N>& speed, PerPoint<P, N>& total) {
  const N zero = N(0);
  const PerPoint<P, N> residual = speed + target.bias + target.gamma * contact.impulse[0];
  total = contact.impulse[0];
  PLUMB_UNROLL
  for (int q = 0; q < P; ++q) total = total - contact.block_inverse[q] * from_point(q, residual.at[index_of(q)]);
  const auto is_face = contact.count > N(2);
  const PointMask<P, N> free = select_all(is_face, target.bias, contact.allowed_approach) > N(kHuge / 2);
  return !in_any_point((free && contact.there()) || total < zero);
}

/// Point by point, in the lanes of `left`: each is clamped, and what it takes changes the speeds of those after it.
template <int P, class N, class M>
PLUMB_HD void solve_normal_points(const Contact<P, N>& contact, const NormalTarget<P, N>& target, const M& left,
                                  PerPoint<P, N> speed, PerPoint<P, N>& total) {
  const PlanePoint<PerPoint<P, N>>& place = contact.place;
  const PerPoint<P, N>& old = contact.impulse[0];
  const PerPoint<P, N> mass =
      select(contact.there(), target.mass_scale / max(own_delassus(contact), N(Real(1e-30))), N(0));
  const NormalPart<PerPoint<P, N>> effects = apply_delassus_at(contact.delassus.normal, place);
  PLUMB_UNROLL
  for (int p = 0; p < P; ++p) {
    const int i = index_of(p);
    const N wanted =
        max(old.at[i] - mass.at[i] * (speed.at[i] + target.bias.at[i]) - target.impulse_scale.at[i] * old.at[i], N(0));
    const N change = from_point(p, wanted - old.at[i]);
    if (holds_point(p)) total.at[i] = select(left, wanted, total.at[i]);
    const NormalPart<N> effect = {from_point(p, effects.along_n.at[i]), from_point(p, effects.about_t1.at[i]),
                                  from_point(p, effects.about_t2.at[i])};
    PLUMB_UNROLL
    for (int j = kContactThreads == 1 ? p + 1 : 0; j < kHeld<P>; ++j) {
      const PlanePoint<N> there = {place.x.at[j], place.y.at[j]};
      speed.at[j] = speed.at[j] + speed_at(effect, there) * change;
    }
  }
}

/// The speed with which a point touches that has come to be pushed while it is apart by s: its gap closes after the
/// share s / (h |v|) of the sub-step, which is bias over speed. Half of the sub-step's pull that is in v already comes
/// too early, for velocities are half a sub-step ahead of positions: by the conservation of energy the point touches
/// with |v| - g h / 2 + g s / |v|. A body that leaves is pulled back half of g h too much in its turn, so that this
/// half is left out here, and e = 1 brings it back to where it came from.
template <int P, class N>
PLUMB_HD PerPoint<P, N> speed_at_touch(const N& pull, const PerPoint<P, N>& bias, const PerPoint<P, N>& speed) {
  const PerPoint<P, N> closing = -speed;
  const PointMask<P, N> apart = bias > N(0) && bias < closing;
  const PerPoint<P, N> share = bias / max(closing, N(Real(1e-30)));
  return min(speed + select(apart, share, N(0)) * pull, N(0));
}

/// The first time in a step that one of the points is pushed, the speeds of all are noted: they hit together, though
/// one of them may be pushed a sub-step later, when the blow on the first has changed its speed. From its own speed it
/// would leave with energy that nobody put in. The noted speed of a point that is not pushed yet waits as kNotPushedYet
/// less itself.
template <int P, class N>
PLUMB_HD void note_impact_speeds(Contact<P, N>& contact, const NormalTarget<P, N>& target, const PerPoint<P, N>& speed,
                                 const PerPoint<P, N>& total) {
  const N zero = N(0), waits = N(kNotPushedYet);
  PerPoint<P, N>& noted = contact.noted;
  const auto pushed = in_any_point(total > zero && noted > zero);
  const PerPoint<P, N> came = speed_at_touch(contact.pull, target.bias, speed);
  noted = select(noted > zero && noted < waits && pushed, waits - came, noted);
  noted = select(total > zero && noted > zero, waits - noted, noted);
}

/// The normal impulses of a manifold: as a block, and point by point in the lanes where a block does not do. Returns
/// the lanes where the block holds. The first time in a step that a point is pushed, its speed is noted for
/// restitution.
template <int P, class N>
PLUMB_HD auto solve_normals(Contact<P, N>& contact, const NormalTarget<P, N>& target, ContactMotion<N>& motion,
                            ContactWrench<N>& wrench, bool note_impacts) {
  const PerPoint<P, N> speed = speed_at(motion.normal, contact.place);
  PerPoint<P, N> total;
  const auto holds = solve_normal_block(contact, target, speed, total);
  if (in_any_contact(!holds)) solve_normal_points(contact, target, !holds, speed, total);
  const NormalPart<N> push = normal_wrench(contact.place, total - contact.impulse[0]);
  contact.impulse[0] = total;
  if (note_impacts) note_impact_speeds(contact, target, speed, total);
  apply_delassus(contact.delassus, push, motion);
  add(wrench.normal, push);
  return holds;
}

}  // namespace plumb::impulse
