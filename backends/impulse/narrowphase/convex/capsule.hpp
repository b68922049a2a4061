// Capsules against spheres and capsules. A capsule is what lies within its radius of a segment along its y axis.
#pragma once

#include "narrowphase/convex/round.hpp"
#include "narrowphase/convex/segments.hpp"
#include "narrowphase/feature.hpp"

namespace plumb::impulse {

/// Half of a capsule's segment, in the world's axes.
PLUMB_HD inline Vec half_segment(const Shape& capsule, const Quat& q) { return rotate(q, Vec{0, capsule.size.y, 0}); }

PLUMB_HD inline bool collide_sphere_capsule(const ShapePair& pair, const Hulls&, Manifold& out) {
  const Vec half = half_segment(pair.b, pair.qb);
  const Vec from = pair.d - half, along = half + half;
  const Vec nearest = from + closest_on_segment(from, along, {0, 0, 0}) * along;
  return touch_ball(pair.a.size.x, normalized_or(nearest, perpendicular(normalized_or(half, {1, 0, 0}))),
                    length(nearest) - pair.b.size.x, pair.margin, out);
}

/// Capsules that lie along each other touch along a line, given by its two ends: where the angle has at least this
/// cosine, and the segments' points at the ends miss each other sideways by at most this part of the thinner one's
/// radius.
constexpr Real kNearlyAlong = Real(0.99), kNearlySideways = Real(0.1);

PLUMB_HD inline bool collide_capsule_capsule(const ShapePair& pair, const Hulls&, Manifold& out) {
  const Vec half_a = half_segment(pair.a, pair.qa), half_b = half_segment(pair.b, pair.qb);
  const Vec along_a = half_a + half_a, along_b = half_b + half_b, from_a = -half_a, from_b = pair.d - half_b;
  const Real radii = pair.a.size.x + pair.b.size.x, thinner = min(pair.a.size.x, pair.b.size.x);
  const ClosestPair closest = closest_between(from_a, along_a, from_b, along_b);
  const Vec apart = closest.on_b - closest.on_a;
  const Real distance = length(apart);
  out.count = 0;
  if (distance - radii > pair.margin) return false;
  // Where the segments cross, the shortest way out is across both; where they coincide, any across one.
  Vec normal = cross(half_a, half_b);
  if (dot(normal, pair.d) < 0) normal = -normal;
  normal = normalized_or(normal, perpendicular(normalized_or(half_a, {1, 0, 0})));
  normal = normalized_or(apart, normal);
  out.normal = normal;

  const auto add = [&](const Vec& on_a, Real separation, std::uint32_t feature) {
    if (separation <= pair.margin)
      out.points[out.count++] = {on_a + (pair.a.size.x + Real(0.5) * separation) * normal, separation, feature};
  };
  const Real aa = length_squared(along_a), bb = length_squared(along_b), ab = dot(along_a, along_b);
  if (aa > 0 && bb > 0 && abs(ab) >= kNearlyAlong * sqrt(aa) * sqrt(bb)) {
    // B's segment over A's, as parameters on A.
    const Real begin = dot(from_b - from_a, along_a) / aa, end = begin + ab / aa;
    const Real low = max(min(begin, end), Real(0)), high = min(max(begin, end), Real(1));
    if (high - low > kClipSlack) {
      const auto gap_at = [&](Real s) {
        const Real r = clamp((s - begin) * (aa / ab), Real(0), Real(1));
        return from_b + r * along_b - from_a - s * along_a;
      };
      const Vec gap_low = gap_at(low), gap_high = gap_at(high);
      const Real at_low = dot(gap_low, normal), at_high = dot(gap_high, normal);
      const Real sideways = max(length_squared(gap_low - at_low * normal), length_squared(gap_high - at_high * normal));
      if (sideways <= kNearlySideways * kNearlySideways * thinner * thinner) {
        add(from_a + low * along_a, (at_low < at_high ? distance : max(at_low, distance)) - radii, 1);
        add(from_a + high * along_a, (at_low < at_high ? max(at_high, distance) : distance) - radii, 2);
        return true;
      }
    }
  }
  add(closest.on_a, distance - radii, 0);
  return true;
}

}  // namespace plumb::impulse
