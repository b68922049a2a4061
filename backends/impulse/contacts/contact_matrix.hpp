// The matrix of a contact's frame (contact_frame.hpp) and its inverses, as they are worked out once a step, for one
// contact or for kLanes of them.
#pragma once

#include "bodies/mechanism.hpp"
#include "contacts/contact_frame.hpp"
#include "contacts/contact_rows.hpp"

namespace plumb::impulse {

/// Of what two bodies of one mechanism would move alone the share below which a contact between them pushes less and
/// less, and the least that counts: there it is as soft as if what they would move alone came on top.
constexpr Real kShareLeft = Real(0.01), kLeastLeft = Real(1e-3);
/// Of what a body would move alone the share below which joints hold it, by themselves and not by the mass of what is
/// joined to it: it is about what they yield (kCfmShareInLoops). And how soft a contact is between two that are held.
constexpr Real kShareHeld = Real(2e-4), kSoftWhereHeld = 1000;

/// Of what the most mobile of a manifold's points, or directions of slip, moves, the share below which another does not
/// move at all; and the least that counts of a turn about the normal, 1/(kg m2).
constexpr Real kLeastMobility = Real(1e-6), kLeastSpin = Real(1e-20);
/// Of the product of a friction block's diagonal the share of its determinant below which its directions depend on each
/// other, and what is added to the diagonal then.
constexpr Real kLeastVolume = Real(1e-4), kShareWhereFlat = Real(0.01);

/// The matrix of contact_frame.hpp. In its order: normal, turns about the tangents; tangents, turn about the normal.
template <class N>
struct FrameDelassus {
  N at[6][6];

  PLUMB_HD FrameDelassus(const Vec3<N>& n, const Vec3<N>& t1, const Vec3<N>& arm_a, const Vec3<N>& arm_b,
                         const Sym33<N>& inertia_a, const Sym33<N>& inertia_b, const N& inverse_mass) {
    const Vec3<N> t2 = cross(n, t1);
    const Vec3<N> turns_a[6] = {cross(arm_a, n), t1, t2, cross(arm_a, t1), cross(arm_a, t2), n};
    const Vec3<N> turns_b[6] = {cross(arm_b, n), t1, t2, cross(arm_b, t1), cross(arm_b, t2), n};
    PLUMB_UNROLL
    for (int j = 0; j < 6; ++j) {
      const Vec3<N> by_a = inertia_a * turns_a[j], by_b = inertia_b * turns_b[j];
      PLUMB_UNROLL
      for (int i = 0; i <= j; ++i) at[i][j] = at[j][i] = dot(turns_a[i], by_a) + dot(turns_b[i], by_b);
    }
    at[0][0] = at[0][0] + inverse_mass;
    at[3][3] = at[3][3] + inverse_mass;
    at[4][4] = at[4][4] + inverse_mass;
  }
  PLUMB_HD FrameDelassus(const FrameDelassus<Lanes>& of, std::uint32_t lane) requires(sizeof(N) == sizeof(Real)) {
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) at[i][j] = lane_of(of.at[i][j], lane);
  }
  PLUMB_HD void put(std::uint32_t lane, const FrameDelassus<Real>& of) {
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) lane_of(at[i][j], lane) = of.at[i][j];
  }

  /// Adds what wrenches on body `from` give at body `to`, of one mechanism or the same body: sign is -1 where one is a
  /// and the other b.
  PLUMB_HD void add(const Mechanisms& mechanisms, std::uint32_t from, const Six (&at_from)[6], std::uint32_t to,
                    const Six (&at_to)[6], Real sign) {
    for (int j = 0; j < 6; ++j) {
      const Six moved = mechanisms.moved(from, at_from[j], to);
      for (int i = 0; i < 6; ++i) at[i][j] = at[i][j] + sign * dot(at_to[i], moved);
    }
  }
  /// Between two bodies of one mechanism: what they move against each other is a difference of large numbers, and next
  /// to nothing where joints hold them against each other. The less of what they would move `alone` is left along the
  /// normal, the less a contact may push: joints and contact would strive against each other, with ever more. But what
  /// counts as held may be held by a motor, which squeezes what is between its bodies: against that the contact is as
  /// stiff as between bodies that are alone.
  PLUMB_HD void yield_where_joints_hold(const FrameDelassus& alone) {
    const Real over = kShareLeft / max(at[0][0] / alone.at[0][0], kLeastLeft);
    soften(kShareLeft * over * over, alone);
  }
  /// Between a body of a mechanism and one of none, or of another. left: of what each would move alone along the normal
  /// the share that joints leave it, the greater of the two. Where they leave both as good as nothing, as of a door and
  /// its threshold, joints and contact would strive likewise.
  PLUMB_HD void yield_where_held(Real left, const FrameDelassus& alone) {
    const Real less = Real(1) - left / kShareHeld;
    if (less > 0) soften(kSoftWhereHeld * min(less * less, Real(1)), alone);
  }
  PLUMB_HD void soften(Real share, const FrameDelassus& alone) {
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < 6; ++i) at[i][j] = at[i][j] + share * alone.at[i][j];
  }
  /// The half below the diagonal is that above it.
  PLUMB_HD void mirror() {
    for (int j = 0; j < 6; ++j)
      for (int i = 0; i < j; ++i) at[j][i] = at[i][j];
  }

  PLUMB_HD void copy_normal(N (&m)[6]) const {
    m[0] = at[0][0];
    m[1] = at[0][1];
    m[2] = at[0][2];
    m[3] = at[1][1];
    m[4] = at[1][2];
    m[5] = at[2][2];
  }
  /// The largest that an impulse along a tangent at p gives in slip there, 1/kg.
  PLUMB_HD N largest_slip(const PlanePoint<N>& p) const {
    const N two = N(2), x = p.x, y = p.y, spin = at[5][5];
    const N k11 = at[3][3] - two * y * at[3][5] + y * y * spin;
    const N k12 = at[3][4] + x * at[3][5] - y * at[4][5] - x * y * spin;
    const N k22 = at[4][4] + two * x * at[4][5] + x * x * spin;
    const N half = (k11 - k22) / two;
    return (k11 + k22) / two + sqrt(half * half + k12 * k12);
  }
};

/// The wrenches of the frame's six directions on a body, or the motions there that they see.
PLUMB_HD inline void frame_wrenches(const Vec& n, const Vec& t1, const Vec& arm, Six (&wrenches)[6]) {
  const Vec t2 = cross(n, t1), zero = {0, 0, 0};
  wrenches[0] = six(n, cross(arm, n));
  wrenches[1] = six(zero, t1);
  wrenches[2] = six(zero, t2);
  wrenches[3] = six(t1, cross(arm, t1));
  wrenches[4] = six(t2, cross(arm, t2));
  wrenches[5] = six(zero, n);
}

/// Inverse of a symmetric positive definite matrix by Gauss and Jordan's elimination, which needs no pivots for those.
template <int R, class N>
PLUMB_HD void invert(N (&m)[R][R]) {
  PLUMB_UNROLL
  for (int k = 0; k < R; ++k) {
    const N pivot = N(1) / m[k][k];
    m[k][k] = N(1);
    PLUMB_UNROLL
    for (int j = 0; j < R; ++j) m[k][j] = pivot * m[k][j];
    PLUMB_UNROLL
    for (int i = 0; i < R; ++i) {
      if (i == k) continue;
      const N factor = m[i][k];
      m[i][k] = N(0);
      PLUMB_UNROLL
      for (int j = 0; j < R; ++j) m[i][j] = m[i][j] - factor * m[k][j];
    }
  }
}

/// Inverse of the matrix that gives all normal speeds for all normal impulses. Four points of a plane have but three
/// ways to move: a share of each point's own softness is added, without which there is no inverse. With much less of it
/// impulses drift in the null space, and towers tremble.
template <class N>
struct NormalBlock {
  N inverse[kManifoldPoints][kManifoldPoints];

  /// count: of points.
  PLUMB_HD NormalBlock(ContactNumbers<N>& numbers, const N& count, const FrameDelassus<N>& delassus,
                       const PlanePoint<N> (&places)[kManifoldPoints]) {
    const N zero = N(0), one = N(1);
    const N share = select(count > one, N(Real(0.05)), zero);
    N normal[6], own[kManifoldPoints], most = zero;
    delassus.copy_normal(normal);
    PLUMB_UNROLL
    for (int p = 0; p < kManifoldPoints; ++p) {
      own[p] = select(N(p) < count, speed_at(apply_delassus_at(normal, places[p]), places[p]), zero);
      most = max(most, own[p]);
    }
    const N least = N(kLeastMobility) * most;
    PLUMB_UNROLL
    for (int p = 0; p < kManifoldPoints; ++p) {
      inverse[p][p] = select(own[p] > least, (one + share) * own[p], one);
      PLUMB_UNROLL
      for (int q = p + 1; q < kManifoldPoints; ++q)
        inverse[p][q] = inverse[q][p] =
            select(own[p] > least && own[q] > least, speed_at(apply_delassus_at(normal, places[p]), places[q]), zero);
    }
    invert(inverse);
    PLUMB_UNROLL
    for (int p = 0; p < kManifoldPoints; ++p) PLUMB_UNROLL
    for (int q = 0; q < kManifoldPoints; ++q) {
      inverse[p][q] = select(own[p] > least && own[q] > least, inverse[p][q], zero);
      numbers.at[point_field(p, kBlockInverse) + static_cast<std::uint32_t>(q)] = inverse[p][q];
    }
  }
};

/// What stops slip: the inverse of a block of friction. One point does not rub against a turn about the normal; nor
/// does a patch whose bodies cannot turn. Where what may move is less than the directions of slip, as of a body that
/// only turns about one axis, they depend on each other: a share of each direction's own softness is added then.
template <class N>
PLUMB_HD void put_stop_mass(ContactNumbers<N>& numbers, std::uint32_t field, const N& count, const N (&block)[3][3]) {
  const N zero = N(0), one = N(1);
  const N most = max(block[0][0], block[1][1]), least = N(kLeastMobility) * most;
  const auto turns = most > zero && count > one && block[2][2] > N(kLeastSpin);
  const decltype(block[0][0] > zero) moves[3] = {block[0][0] > least, block[1][1] > least, turns};
  N m[3][3];
  PLUMB_UNROLL
  for (int i = 0; i < 3; ++i) PLUMB_UNROLL
  for (int j = 0; j < 3; ++j) m[i][j] = select(moves[i] && moves[j], block[i][j], i == j ? one : zero);
  const N volume = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[1][2]) -
                   m[0][1] * (m[0][1] * m[2][2] - m[1][2] * m[0][2]) +
                   m[0][2] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
  const N share = select(volume > N(kLeastVolume) * (m[0][0] * m[1][1] * m[2][2]), zero, N(kShareWhereFlat));
  PLUMB_UNROLL
  for (int i = 0; i < 3; ++i) m[i][i] = m[i][i] + share * m[i][i];
  invert(m);
  PLUMB_UNROLL
  for (int i = 0; i < 3; ++i) PLUMB_UNROLL
  for (int j = i; j < 3; ++j) numbers.at[field++] = select(moves[i] && moves[j], m[i][j], zero);
}

/// The matrix of the frame, and what stops slip in it.
template <class N>
PLUMB_HD void put_frame_matrix(ContactNumbers<N>& numbers, const N& count, const FrameDelassus<N>& delassus,
                               const NormalBlock<N>& normals, const PlanePoint<N> (&places)[kManifoldPoints]) {
  N normal[6];
  delassus.copy_normal(normal);
  std::uint32_t field = kDelassus;
  PLUMB_UNROLL
  for (int i = 0; i < 6; ++i) numbers.at[field++] = normal[i];
  N across[kManifoldPoints][3];  // normal speed of each point for friction
  PLUMB_UNROLL
  for (int i = 0; i < 3; ++i) PLUMB_UNROLL
  for (int j = 0; j < 3; ++j) numbers.at[field++] = delassus.at[i][3 + j];
  N free[3][3], held[3][3];
  PLUMB_UNROLL
  for (int j = 0; j < 3; ++j) {
    PLUMB_UNROLL
    for (int i = 0; i < 3; ++i) {
      held[i][j] = free[i][j] = delassus.at[3 + i][3 + j];
      if (j >= i) numbers.at[field + static_cast<std::uint32_t>(i * (5 - i) / 2 + j)] = free[i][j];
    }
    PLUMB_UNROLL
    for (int p = 0; p < kManifoldPoints; ++p)
      across[p][j] =
          speed_at(NormalPart<N>{delassus.at[0][3 + j], delassus.at[1][3 + j], delassus.at[2][3 + j]}, places[p]);
  }
  // What friction does along the normals is undone by them.
  PLUMB_UNROLL
  for (int p = 0; p < kManifoldPoints; ++p) PLUMB_UNROLL
  for (int j = 0; j < 3; ++j) {
    N undone = N(0);
    PLUMB_UNROLL
    for (int q = 0; q < kManifoldPoints; ++q) undone = undone + normals.inverse[p][q] * across[q][j];
    PLUMB_UNROLL
    for (int i = 0; i < 3; ++i) held[i][j] = held[i][j] - across[p][i] * undone;
  }
  put_stop_mass(numbers, field + 6, count, free);
  put_stop_mass(numbers, field + 12, count, held);
}

}  // namespace plumb::impulse
