// The points where two faces lie over each other, and the choice of the four that carry the contact.
#pragma once

#include "geometry/tolerance.hpp"
#include "narrowphase/manifold.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

/// Where a line along the normal meets both faces: at (x, y) in the plane of A's face, and at B's face `separation`
/// further along the normal.
struct Candidate {
  Real x, y, separation;
  std::uint32_t feature;
};

/// Whether the points differ in depth by less than an angle, for how far they are spread.
PLUMB_HD inline bool are_level(const Candidate* at, int count, Real angle) {
  Vec low = {at[0].x, at[0].y, at[0].separation}, high = low;
  for (int i = 1; i < count; ++i) {
    const Vec p = {at[i].x, at[i].y, at[i].separation};
    low = min(low, p);
    high = max(high, p);
  }
  return high.z - low.z <= angle * (high.x - low.x + high.y - low.y);
}

/// How much a point counts for where it lies: fully when it is as deep as `deepest`, less the further the body has to
/// tip over that one until this one touches, a half at kTip. Points that hover far out would else take the places of
/// those that a body on a narrow face rests on, and it would rock for ever.
PLUMB_HD inline Real tip_weight(const Candidate& deepest, const Candidate& at) {
  const Real dx = at.x - deepest.x, dy = at.y - deepest.y, height = max(at.separation - deepest.separation, Real(0));
  const Real reach = kTip * kTip * (dx * dx + dy * dy);
  return reach > 0 ? reach / (reach + height * height) : Real(0);
}

/// Puts the four points that matter first in `at` and returns how many there are: the deepest, the farthest from it,
/// the one that spans the largest triangle with both, and the one that widens that triangle most, each by its
/// tip_weight. Points that are equal within `tie` (a length) are taken in their order. Of more than four that are
/// level, so that the deepest is so by accident, the first is taken as it is: a trembling body rests on the same four
/// all the time. set (1 to 4): whoever knows so many that the body rests on puts them first; they are taken where it
/// does not have to tip over the others.
PLUMB_HD inline int choose_points(Candidate* at, int count, Real tie, int set = 1) {
  PLUMB_ASSERT(count >= 0 && set >= 1 && set <= kManifoldPoints);
  const auto swap = [at](int i, int j) {
    const Candidate c = at[i];
    at[i] = at[j];
    at[j] = c;
  };
  int best = 0;
  for (int i = 1; i < count; ++i)
    if (at[i].separation < at[best].separation - tie) best = i;
  if (count <= kManifoldPoints) {
    swap(0, best);
    return count;
  }
  if (!are_level(at, count, set > 1 ? kTip : kLevel)) {
    swap(0, best);
    set = 1;
  }

  Real most = 0;
  if (set < 2) {
    best = 1;
    for (int i = 1; i < count; ++i) {
      const Real dx = at[i].x - at[0].x, dy = at[i].y - at[0].y, far = (dx * dx + dy * dy) * tip_weight(at[0], at[i]);
      if (far > most * (1 + kClipSlack)) {
        most = far;
        best = i;
      }
    }
    swap(1, best);
  }

  const Real ux = at[1].x - at[0].x, uy = at[1].y - at[0].y;
  const auto side = [&](int i) { return ux * (at[i].y - at[0].y) - uy * (at[i].x - at[0].x); };
  if (set < 3) {
    most = 0;
    best = 2;
    for (int i = 2; i < count; ++i)
      if (const Real area = abs(side(i)) * tip_weight(at[0], at[i]); area > most * (1 + kClipSlack)) {
        most = area;
        best = i;
      }
    swap(2, best);
  }
  if (set > 3) return 4;

  // The triangle 0, 1, 2, counter-clockwise, and how far a point lies outside of its widest side.
  const bool turned = side(2) < 0;
  most = 0;
  best = -1;
  for (int i = 3; i < count; ++i) {
    Real outside = 0;
    for (int k = 0; k < 3; ++k) {
      const Candidate& p = at[k];
      const Candidate& q = at[k == 2 ? 0 : k + 1];
      const Real area = (q.x - p.x) * (at[i].y - p.y) - (q.y - p.y) * (at[i].x - p.x);
      outside = max(outside, turned ? area : -area);
    }
    outside *= tip_weight(at[0], at[i]);
    if (outside > most * (1 + kClipSlack)) {
      most = outside;
      best = i;
    }
  }
  if (best < 0) return 3;
  swap(3, best);
  return 4;
}

}  // namespace plumb::impulse
