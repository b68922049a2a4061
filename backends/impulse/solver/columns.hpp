// How short sub-steps must be for a column of bodies to stand.
//
// A column of like bodies buckles under its own weight when it is higher than H of them, for contacts are springs:
// H^3 = c k l^2 / (m g d) with a contact's stiffness k ~ m / h^2, the radius of gyration l of its patch, and d from one
// centre to the next (Greenhill, "Determination of the greatest height consistent with stability", Proc. Camb. Phil.
// Soc. 4, 1881). So under n weights sub-steps must be shorter than sqrt(l^2 / (g d n^3)) by a factor that does not
// depend on the scene. What presses beside the centre of a patch leaves one side of it with less to bear: where that is
// nothing the patch opens, and is no spring any more.
#pragma once

#include "narrowphase/contact_cache.hpp"

namespace plumb::impulse {

/// Over that length; cubes were seen to buckle from .42 on.
constexpr Real kColumnSubsteps = Real(0.5);
/// Columns that bear no more than so many of their bodies' weights stand as it is.
constexpr Real kLeastColumn = 8;
/// What stands on another presses along gravity, within so much: the cosine of an angle.
constexpr Real kColumnUpright = Real(0.9);
/// However far beside the centre, a patch counts for that share of itself.
constexpr Real kLeastPatch = Real(0.1);

/// Where two bodies touch.
struct ContactPatch {
  Real gyration2;  ///< of its points, squared, about the line in its plane where that is least, m2
  Real closed;     ///< 1: all points bear alike; 0: one side of it bears nothing
};

/// found has three points or more. Nothing where they are on a line, or bear nothing.
PLUMB_HD inline ContactPatch patch_of(const Manifold& found, const CachedManifold& kept) {
  const Vec bitangent = cross(kept.normal, kept.tangent);
  Real x = 0, y = 0, xx = 0, xy = 0, yy = 0, pressed = 0, pressed_x = 0, pressed_y = 0;
  for (std::uint32_t p = 0; p < found.count; ++p) {
    const Vec from_first = found.points[p].position - found.points[0].position;
    const Real along = dot(from_first, kept.tangent), across = dot(from_first, bitangent);
    x = x + along;
    y = y + across;
    xx = xx + along * along;
    xy = xy + along * across;
    yy = yy + across * across;
    pressed = pressed + kept.normal_impulse[p];
    pressed_x = pressed_x + kept.normal_impulse[p] * along;
    pressed_y = pressed_y + kept.normal_impulse[p] * across;
  }
  const Real share = Real(1) / static_cast<Real>(found.count);
  x = share * x;
  y = share * y;
  xx = share * xx - x * x;
  xy = share * xy - x * y;
  yy = share * yy - y * y;
  const Real half = (xx - yy) / 2, gyration2 = (xx + yy) / 2 - sqrt(half * half + xy * xy);
  if (!(gyration2 > 0 && pressed > 0)) return {0, 0};
  const Real off_x = pressed_x / pressed - x, off_y = pressed_y / pressed - y;
  // Of a rectangle, what presses within the rhombus of the middles of its sides leaves every corner pressed.
  return {gyration2, max(Real(1) - sqrt(off_x * off_x / xx) - sqrt(off_y * off_y / yy), kLeastPatch)};
}

/// Sub-steps that a column asks for, 1/s. n: how many weights of a body press on it there; d: from its centre to that
/// of the one above, m.
PLUMB_HD inline Real column_rate(Real n, Real d, Real gravity, const ContactPatch& patch) {
  const Real weights = n / patch.closed;
  return kColumnSubsteps * weights * sqrt(weights * gravity * d / patch.gyration2);
}

}  // namespace plumb::impulse
