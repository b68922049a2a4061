// Friction impulses of a contact, all its points at once: one force of the whole patch, within Coulomb's circle at each
// point.
//
//   t2 ^   p0 o-------------o p1    m: mean of the points, the origin of the frame    c: centre of pressure
//      |      |      m      |       stick:  (F1, F2, T) = the wrench at m with which the slip of the patch stops
//      |      |  c          |               point p has its share s_p of the load, and gets
//      |   p3 o-------------o p2            f_p = s_p (F + w n x (p - c)),  w = T_c / sum of s_p |p - c|^2
//      '--> t1                      taken where |f_p| <= mu N_p at every p, N_p being its normal impulse of now
//
// Sticking. What would stop the slip along both tangents and about the normal is found in one, for each of the three
// makes slip of the others, and shared out over the points by how hard each is pressed: as a rigid patch would bear it.
// A turn about the normal has no row and no radius of its own: the points' forces resist it by their arms, and a single
// point does not at all. Where one point bears everything the slip of its own place is stopped, and the patch may turn.
//
// What stops a slip depends on the normals (StopMass). Where they hold (their block is exact, no point comes or goes)
// what friction does along them is undone when they are solved next: the matrix is the Schur complement. Where they may
// let go, or are not solved again, it is the block of friction alone. The default solver goes through normals, friction
// and normals in turn, so that its friction may be of other normal impulses than the last; the others end with
// friction, which so stays within the cone.
//
// Sliding. Where a point's share is beyond its circle, the patch slides, and each point takes a projected step against
// its own slip, f = circle(f - r slip): only then is the impulse opposite to the slip when it no longer changes
// (maximum dissipation; the projection of Alart and Curnier, "A mixed formulation for frictional contact problems prone
// to Newton like solution methods", Comput. Methods Appl. Mech. Eng. 92, 1991). The impulse that stops the slip, cut to
// the circle, is not: it leans by the ratio of the effective masses, and a cube on a slope slides by itself at 94 % of
// its friction. Nor would a pyramid do, each tangent cut by itself: it rubs up to 1.41 times as hard along its
// diagonals, and what a body feels would depend on its yaw.
#pragma once

#include "contacts/contact.hpp"

namespace plumb::impulse {

/// Impulses along the tangents.
template <int P, class N>
struct TangentImpulses {
  PerPoint<P, N> t1, t2;
};

/// How the load lies on the points.
template <int P, class N>
struct PressedPatch {
  N load;                            ///< of all points, N s
  PerPoint<P, N> share;              ///< of the load, 0 where there is none
  PlanePoint<N> centre;              ///< of pressure
  PlanePoint<PerPoint<P, N>> place;  ///< from there
  N inverse_spread;                  ///< 1 over the mean square of the places, 1/m2; 0 for 0

  PLUMB_HD PressedPatch(const PlanePoint<PerPoint<P, N>>& places, const PerPoint<P, N>& loads) {
    const N zero = N(0);
    load = sum(loads);
    const N inverse = N(1) / max(load, N(Real(1e-30)));
    // Who bears it all bears it all to the last bit, however many points there could be.
    share = select(loads < load, loads * inverse, select(load > zero, N(1), zero));
    centre = {sum(share * places.x), sum(share * places.y)};
    place = {places.x - centre.x, places.y - centre.y};
    // What all lies on one point resists no torque.
    const N spread = sum(share * (place.x * place.x + place.y * place.y)), least = N(Real(1e-25));
    inverse_spread = select(spread > least, N(1) / max(spread, least), zero);
  }

  /// About the centre of pressure.
  PLUMB_HD N torque_of(const FrictionPart<N>& wrench) const {
    return wrench.about_n - (centre.x * wrench.along_t2 - centre.y * wrench.along_t1);
  }
  /// Impulses that make a wrench, as a rigid patch bears it.
  PLUMB_HD TangentImpulses<P, N> share_out(const FrictionPart<N>& wrench) const {
    const N turn = inverse_spread * torque_of(wrench);
    return {share * (wrench.along_t1 - place.y * turn), share * (wrench.along_t2 + place.x * turn)};
  }
};

/// What stops slip: along the tangents and about the normal, with the normals held or free.
template <class N>
struct StopMass {
  N at[6];

  template <class M>
  PLUMB_HD StopMass(const ContactDelassus<N>& delassus, const M& held) {
    PLUMB_UNROLL
    for (int i = 0; i < 6; ++i) at[i] = select(held, delassus.stop_held[i], delassus.stop_free[i]);
  }
  PLUMB_HD FrictionPart<N> stop(const FrictionPart<N>& motion) const {
    N impulse[3];
    multiply(at, motion.along_t1, motion.along_t2, motion.about_n, impulse);
    return {-impulse[0], -impulse[1], -impulse[2]};
  }
  /// Slip of one place, which goes on turning about the normal: the matrix there, less what it takes to hold the turn
  /// (Schur's complement).
  PLUMB_HD FrictionPart<N> stop_at(const PlanePoint<N>& p, const FrictionPart<N>& motion) const {
    const N lean1 = at[2] + (p.y * at[0] - p.x * at[1]), lean2 = at[4] + (p.y * at[1] - p.x * at[3]);
    const N turn = at[5] + (p.y * (at[2] + lean1) - p.x * (at[4] + lean2)), least = N(Real(1e-30));
    const N slip1 = slip1_at(motion, p), slip2 = slip2_at(motion, p);
    const N lean = select(at[5] > N(0), (lean1 * slip1 + lean2 * slip2) / max(turn, least), N(0));
    const N f1 = lean1 * lean - (at[0] * slip1 + at[1] * slip2), f2 = lean2 * lean - (at[1] * slip1 + at[3] * slip2);
    return {f1, f2, p.x * f2 - p.y * f1};
  }
  /// No more than what stops a slip along any tangent: Gershgorin's bound.
  PLUMB_HD N along_any_tangent() const { return min(at[0], at[3]) - max(at[1], -at[1]); }
  PLUMB_HD N about_normal() const { return at[5]; }
};

/// A patch that rubs one way nearly as hard as it can goes on to do so when the load moves from point to point.
template <int P, class N>
PLUMB_HD TangentImpulses<P, N> follow_load(const TangentImpulses<P, N>& old, const FrictionPart<N>& before,
                                           const PressedPatch<P, N>& patch, const N& friction) {
  const N most = N(Real(0.9)) * friction * patch.load;
  const auto slid = before.along_t1 * before.along_t1 + before.along_t2 * before.along_t2 > most * most;
  const TangentImpulses<P, N> anew = patch.share_out(before);
  return {select_all(slid, anew.t1, old.t1), select_all(slid, anew.t2, old.t2)};
}

/// A projected step of each point against its own slip. Safe steps are small, for a point of a patch may turn about the
/// others, and a patch that begins to slide would take many to reach its circle. So the direction is that of a safe
/// step, and the length that of one as long as the whole patch allows, where this is more.
template <int P, class N>
PLUMB_HD TangentImpulses<P, N> step_against_slip(const Contact<P, N>& contact, const FrictionPart<N>& motion,
                                                 const TangentImpulses<P, N>& old, const PressedPatch<P, N>& patch,
                                                 const StopMass<N>& mass) {
  const PerPoint<P, N>& share = patch.share;
  const N step = contact.tangent_step, far = max(mass.along_any_tangent(), step);
  const PerPoint<P, N> t1 = old.t1 - share * (slip1_at(motion, contact.place) * step);
  const PerPoint<P, N> t2 = old.t2 - share * (slip2_at(motion, contact.place) * step);
  const FrictionPart<N> far_step = {far * slip1_at(motion, patch.centre), far * slip2_at(motion, patch.centre),
                                    min(far, mass.about_normal() * patch.inverse_spread) * motion.about_n};
  const PerPoint<P, N> u1 = old.t1 - share * slip1_at(far_step, patch.place);
  const PerPoint<P, N> u2 = old.t2 - share * slip2_at(far_step, patch.place);
  const PerPoint<P, N> size = sqrt(t1 * t1 + t2 * t2), far_size = sqrt(u1 * u1 + u2 * u2);
  const PerPoint<P, N> most = share * (contact.friction * patch.load);
  const PerPoint<P, N> scale = min(max(size, far_size), most) / max(size, N(Real(1e-30)));
  return {scale * t1, scale * t2};
}

/// New impulses of friction for old ones and loads; the motion and the wrench follow. held: the lanes in which the
/// normals let no point come or go.
template <int P, class N, class M>
PLUMB_HD TangentImpulses<P, N> rub(const Contact<P, N>& contact, const PerPoint<P, N>& loads,
                                   const TangentImpulses<P, N>& old, const M& held, ContactMotion<N>& motion,
                                   ContactWrench<N>& wrench) {
  const PressedPatch<P, N> patch(contact.place, loads);
  const StopMass<N> mass(contact.delassus, held);
  const FrictionPart<N> before = friction_wrench(contact.place, old.t1, old.t2);
  FrictionPart<N> stopping = mass.stop(motion.friction);
  const auto alone = patch.inverse_spread < N(Real(1e-30));  // one point bears all
  if (in_any_contact(alone)) {
    const FrictionPart<N> slip = mass.stop_at(patch.centre, motion.friction);
    stopping = {select(alone, slip.along_t1, stopping.along_t1), select(alone, slip.along_t2, stopping.along_t2),
                select(alone, slip.about_n, stopping.about_n)};
  }
  add(stopping, before);
  TangentImpulses<P, N> found = patch.share_out(stopping);
  const PerPoint<P, N> most = loads * contact.friction;
  const auto slides = in_any_point(found.t1 * found.t1 + found.t2 * found.t2 > most * most);
  if (in_any_contact(slides)) {
    const TangentImpulses<P, N> start = follow_load(old, before, patch, contact.friction);
    const TangentImpulses<P, N> stepped = step_against_slip(contact, motion.friction, start, patch, mass);
    found = {select_all(slides, stepped.t1, found.t1), select_all(slides, stepped.t2, found.t2)};
  }
  const FrictionPart<N> push = friction_wrench(contact.place, found.t1 - old.t1, found.t2 - old.t2);
  apply_delassus(contact.delassus, push, motion);
  add(wrench.friction, push);
  return found;
}

template <int P, class N, class M>
PLUMB_HD void solve_friction(Contact<P, N>& contact, ContactMotion<N>& motion, ContactWrench<N>& wrench,
                             const M& held) {
  auto& impulse = contact.impulse;
  const TangentImpulses<P, N> found = rub(contact, impulse[0], {impulse[1], impulse[2]}, held, motion, wrench);
  impulse[1] = found.t1;
  impulse[2] = found.t2;
}
/// Only some points take part.
template <int P, class N, class M>
PLUMB_HD void solve_friction_where(const PointMask<P, N>& rubs, Contact<P, N>& contact, ContactMotion<N>& motion,
                                   ContactWrench<N>& wrench, const M& held) {
  auto& impulse = contact.impulse;
  const N zero = N(0);
  const TangentImpulses<P, N> old = {select(rubs, impulse[1], zero), select(rubs, impulse[2], zero)};
  const TangentImpulses<P, N> found = rub(contact, select(rubs, impulse[0], zero), old, held, motion, wrench);
  impulse[1] = select(rubs, found.t1, impulse[1]);
  impulse[2] = select(rubs, found.t2, impulse[2]);
}

}  // namespace plumb::impulse
