// The frame of a contact: its axes are the normal n and two tangents t1 and t2 = n x t1, its origin the mean of the
// points, which all lie in the plane of the tangents.
//
// How b moves against a, and what acts between them, are six numbers each in this frame, and a symmetric matrix of six
// by six says how the first answers to the second. So a contact is solved without its bodies; they are pushed once, by
// the sum of all that was found.
#pragma once

#include "contacts/per_point.hpp"
#include "math/mat33.hpp"

namespace plumb::impulse {

/// Motion along the normal and about the tangents: what normal impulses see; or force and torque that they make.
template <class N>
struct NormalPart {
  N along_n, about_t1, about_t2;
};
/// Motion along the tangents and about the normal: what friction sees; or force and torque that it makes.
template <class N>
struct FrictionPart {
  N along_t1, along_t2, about_n;
};

/// How b moves against a at the origin, m/s and rad/s.
template <class N>
struct ContactMotion {
  NormalPart<N> normal;
  FrictionPart<N> friction;
};
/// Impulse on b at the origin and the opposite one on a, N s and N m s.
template <class N>
using ContactWrench = ContactMotion<N>;

template <class N>
PLUMB_HD ContactWrench<N> no_wrench() {
  return {{N(0), N(0), N(0)}, {N(0), N(0), N(0)}};
}

/// A place in the plane, m; or one for each point.
template <class N>
struct PlanePoint {
  N x, y;
};

/// Speed along the normal at a place, or at all points.
template <class N, class At>
PLUMB_HD At speed_at(const NormalPart<N>& motion, const PlanePoint<At>& place) {
  return motion.along_n + (place.y * motion.about_t1 - place.x * motion.about_t2);
}
/// Speeds along the tangents.
template <class N, class At>
PLUMB_HD At slip1_at(const FrictionPart<N>& motion, const PlanePoint<At>& place) {
  return motion.along_t1 - place.y * motion.about_n;
}
template <class N, class At>
PLUMB_HD At slip2_at(const FrictionPart<N>& motion, const PlanePoint<At>& place) {
  return motion.along_t2 + place.x * motion.about_n;
}

/// The wrench of impulses along the normal.
template <int P, class N>
PLUMB_HD NormalPart<N> normal_wrench(const PlanePoint<PerPoint<P, N>>& places, const PerPoint<P, N>& impulses) {
  return {sum(impulses), sum(places.y * impulses), -sum(places.x * impulses)};
}
/// The wrench of impulses along the tangents.
template <int P, class N>
PLUMB_HD FrictionPart<N> friction_wrench(const PlanePoint<PerPoint<P, N>>& places, const PerPoint<P, N>& along_t1,
                                         const PerPoint<P, N>& along_t2) {
  return {sum(along_t1), sum(along_t2), sum(places.x * along_t2 - places.y * along_t1)};
}

/// The matrix, in blocks of three by three, and inverses of the block of friction, without rows for what nothing gives
/// way to: what stops slip where the normals let everything pass, and where they hold.
template <class N>
struct ContactDelassus {
  N normal[6];    ///< of the normal part for the normal part: 11 12 13 22 23 33
  N across[9];    ///< of the normal part (rows) for the part of friction (columns)
  N friction[6];  ///< of the part of friction for itself
  N stop_free[6], stop_held[6];
};

/// m v, for a symmetric matrix of three rows held as 11 12 13 22 23 33.
template <class N>
PLUMB_HD void multiply(const N (&m)[6], const N& x, const N& y, const N& z, N (&product)[3]) {
  product[0] = m[0] * x + m[1] * y + m[2] * z;
  product[1] = m[1] * x + m[3] * y + m[4] * z;
  product[2] = m[2] * x + m[4] * y + m[5] * z;
}

/// What a normal impulse at a place, or at each point, does to the normal part of the motion.
template <class N, class At>
PLUMB_HD NormalPart<At> apply_delassus_at(const N (&normal)[6], const PlanePoint<At>& q) {
  return {normal[0] + (q.y * normal[1] - q.x * normal[2]), normal[1] + (q.y * normal[3] - q.x * normal[4]),
          normal[2] + (q.y * normal[4] - q.x * normal[5])};
}

/// What an impulse of normals does to the motion.
template <class N>
PLUMB_HD void apply_delassus(const ContactDelassus<N>& delassus, const NormalPart<N>& impulse,
                             ContactMotion<N>& motion) {
  const N f = impulse.along_n, t1 = impulse.about_t1, t2 = impulse.about_t2;
  N by[3];
  multiply(delassus.normal, f, t1, t2, by);
  motion.normal = {motion.normal.along_n + by[0], motion.normal.about_t1 + by[1], motion.normal.about_t2 + by[2]};
  const N* across = delassus.across;
  FrictionPart<N>& friction = motion.friction;
  friction = {friction.along_t1 + (across[0] * f + across[3] * t1 + across[6] * t2),
              friction.along_t2 + (across[1] * f + across[4] * t1 + across[7] * t2),
              friction.about_n + (across[2] * f + across[5] * t1 + across[8] * t2)};
}
/// What an impulse of friction does to the motion.
template <class N>
PLUMB_HD void apply_delassus(const ContactDelassus<N>& delassus, const FrictionPart<N>& impulse,
                             ContactMotion<N>& motion) {
  const N f1 = impulse.along_t1, f2 = impulse.along_t2, t = impulse.about_n;
  N by[3];
  multiply(delassus.friction, f1, f2, t, by);
  motion.friction = {motion.friction.along_t1 + by[0], motion.friction.along_t2 + by[1],
                     motion.friction.about_n + by[2]};
  const N* across = delassus.across;
  NormalPart<N>& normal = motion.normal;
  normal = {normal.along_n + (across[0] * f1 + across[1] * f2 + across[2] * t),
            normal.about_t1 + (across[3] * f1 + across[4] * f2 + across[5] * t),
            normal.about_t2 + (across[6] * f1 + across[7] * f2 + across[8] * t)};
}

template <class N>
PLUMB_HD void add(NormalPart<N>& sum, const NormalPart<N>& more) {
  sum = {sum.along_n + more.along_n, sum.about_t1 + more.about_t1, sum.about_t2 + more.about_t2};
}
template <class N>
PLUMB_HD void add(FrictionPart<N>& sum, const FrictionPart<N>& more) {
  sum = {sum.along_t1 + more.along_t1, sum.along_t2 + more.along_t2, sum.about_n + more.about_n};
}

}  // namespace plumb::impulse
