// How far two convex shapes are apart, where they come closest, and where one that moves along a line meets the other:
// GJK (Gilbert, Johnson and Keerthi, "A fast procedure for computing the distance between complex objects", IEEE
// Journal of Robotics and Automation 4, 1988; ended as by van den Bergh, "A fast and robust GJK implementation for
// collision detection of convex objects", Journal of Graphics Tools 4, 1999).
//
// Pair tells what is asked about: PlacedPair (core.hpp), or a triangle and a shape (triangle_core.hpp). Its Number is
// float or double. Nothing in here is absolute: what counts as touching is a multiple of what rounding does to
// coordinates of the size that the shapes and their distance have.
#pragma once

#include <type_traits>

#include "narrowphase/convex/core.hpp"
#include "narrowphase/convex/simplex.hpp"

namespace plumb::impulse {

/// Of two cores; A's frame.
template <class N>
struct CoreGap {
  bool overlap;  ///< or so close that rounding cannot tell: nothing else is set
  N distance;
  Vec3<N> normal;  ///< unit, from A to B
  Vec3<N> on_a, on_b;
};

/// The unit vector from A to B. Of cores that nearly touch, `nearest` is little more than rounding, but the corners
/// that it lies between are not: the normal is across them.
template <class N>
PLUMB_HD Vec3<N> gap_normal(const Simplex<N>& simplex, const Vec3<N>& nearest) {
  const N square = dot(nearest, nearest);
  const Vec3<N> n = (-1 / sqrt(square)) * nearest;
  const Vec3<N> e = simplex.point[simplex.count > 1 ? 1 : 0] - simplex.point[0];
  const N ee = dot(e, e);
  if (simplex.count == 2) {
    const Vec3<N> off_edge = n - (dot(n, e) / ee) * e;
    const N left = length(off_edge);
    return left > N(0.5) ? (1 / left) * off_edge : n;
  }
  if (simplex.count != 3) return n;
  const Vec3<N> f = simplex.point[2] - simplex.point[0], across = cross(e, f);
  const N area2 = dot(across, across), longest2 = max(max(ee, dot(f, f)), dot(f - e, f - e));
  // Rounding turns `nearest` by the size of it all over its length, and the triangle by that over its height.
  if (!(area2 > longest2 * square)) return n;
  return ((dot(across, nearest) > 0 ? N(-1) : N(1)) / sqrt(area2)) * across;
}

/// simplex: empty, or what an earlier call left for the same pair, moved as B was moved against it: then it is quick.
/// Of cores that turn out to be further apart than `enough` the gap need not be found to the end; it is above that.
/// A pair has the members `shift`, from A's origin to B's, and `support` of PlacedPair.
template <class Pair, class N>
PLUMB_HD CoreGap<N> core_gap(const Pair& pair, Simplex<N>& simplex, std::type_identity_t<N> enough) {
  constexpr int kMostRefinements = 128;  // far beyond what polyhedra take; curved cores come closer with every round
  constexpr N kNoise = 16 * kRounding<N>;
  if (simplex.count == 0) {
    Vec3<N> on_a;
    const bool apart = dot(pair.shift, pair.shift) > 0;
    const Vec3<N> p = pair.support(apart ? pair.shift : Vec3<N>{1, 0, 0}, on_a);
    simplex.add(p, on_a);
  }
  N size2 = 0;  // of the largest coordinates that were met
  for (int i = 0; i < simplex.count; ++i) size2 = max(size2, dot(simplex.point[i], simplex.point[i]));
  Vec3<N> nearest;
  N square = 0, last = -1;
  for (int round = 0; round < kMostRefinements; ++round) {
    if (!simplex.reduce(nearest, square) || square <= kNoise * kNoise * size2) return {true, 0, {}, {}, {}};
    if (last >= 0 && !(square < last)) break;  // all that is left is rounding
    last = square;
    Vec3<N> on_a;
    const Vec3<N> p = pair.support(-nearest, on_a);
    size2 = max(size2, dot(p, p));
    // The plane across `nearest` at p bounds the distance from below.
    const N bound = dot(nearest, p);
    if (bound > 0 && bound * bound > enough * enough * square) break;
    if (square - bound <= kNoise * (square + sqrt(square * size2)) || round + 1 == kMostRefinements) break;
    simplex.add(p, on_a);
  }
  const Vec3<N> on_a = simplex.nearest_on_a();
  return {false, sqrt(square), gap_normal(simplex, nearest), on_a, on_a - nearest};
}

/// Of two shapes; A's frame. Where the cores are apart but the shapes overlap, as balls do that are not concentric, the
/// distance is negative and exact.
template <class N>
struct ShapeGap {
  bool cores_overlap;  ///< nothing else is set; the depth is the narrow phase's (collide.hpp) to find
  N distance;
  Vec3<N> normal;      ///< unit, from A to B
  Vec3<N> on_a, on_b;  ///< of the surfaces
};

template <class Pair, class N = typename Pair::Number>
PLUMB_HD ShapeGap<N> to_shape_gap(const Pair& pair, const CoreGap<N>& core) {
  if (core.overlap) return {true, 0, {}, {}, {}};
  return {false, core.distance - pair.radii(), core.normal, core.on_a + pair.radius_a() * core.normal,
          core.on_b - pair.radius_b() * core.normal};
}

template <class Pair, class N = typename Pair::Number>
PLUMB_HD ShapeGap<N> shape_gap(const Pair& pair) {
  Simplex<N> simplex;
  return to_shape_gap(pair, core_gap(pair, simplex, N(kHuge)));
}

/// Touching counts.
template <class Pair, class N = typename Pair::Number>
PLUMB_HD bool shapes_overlap(const Pair& pair) {
  const N reach = pair.reach();
  if (dot(pair.shift, pair.shift) > reach * reach * N(1 + 0x1p-10)) return false;
  Simplex<N> simplex;
  const CoreGap<N> core = core_gap(pair, simplex, pair.radii());
  return core.overlap || core.distance <= pair.radii();
}

/// Where a moving shape meets one that rests; the frame of the resting one.
template <class N>
struct CastTouch {
  N at;            ///< length of the way; 0 where they overlap from the start
  bool at_start;   ///< they do: nothing else is set
  Vec3<N> normal;  ///< unit, of the resting shape's surface
  Vec3<N> on_a;    ///< on its surface
};

/// Moves B along the unit vector `along`, no further than `most`, until it touches A. False where it does not.
/// Directed advancement: the plane that parts the shapes tells how far B may go at least, and that it never arrives
/// when it does not come closer (Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996, section 2.3,
/// for motions without turning, where the bound is the distance over the speed along the normal).
template <class Pair, class N = typename Pair::Number>
PLUMB_HD bool cast_shape(Pair pair, const Vec3<N>& along, typename Pair::Number most, CastTouch<N>& touch) {
  constexpr int kMostRefinements = 64;  // each at least halves what is left of the way, also where they graze
  const N radii = pair.radii();
  // Up to where balls about both origins touch nothing can happen; they are a little too large, so that there is a gap.
  const N reach = pair.reach() * N(1 + 0x1p-10);
  const N middle = -dot(pair.shift, along);
  const Vec3<N> beside = pair.shift + middle * along;
  const N inside = (reach - length(beside)) * (reach + length(beside));
  if (!(inside >= 0)) return false;
  const N half = sqrt(inside), enough = 256 * kRounding<N> * reach;
  if (middle + half < 0 || middle - half > most) return false;

  const Vec3<N> start = pair.shift;
  Simplex<N> simplex;
  touch.at = max(middle - half, N(0));
  pair.shift = start + touch.at * along;
  bool advanced = false;
  for (int round = 0; round < kMostRefinements; ++round) {
    const CoreGap<N> core = core_gap(pair, simplex, N(kHuge));
    const N gap = core.overlap ? 0 : core.distance - radii;
    if (core.overlap || gap <= enough) {
      if (!core.overlap) touch.on_a = core.on_a;
      break;
    }
    const N approach = -dot(core.normal, along);
    if (!(approach > 0)) return false;
    const N next = touch.at + gap / approach;
    if (next > most) return false;
    touch.normal = core.normal;
    touch.on_a = core.on_a;
    advanced = true;
    if (!(next > touch.at)) break;
    simplex.move((touch.at - next) * along);
    touch.at = next;
    pair.shift = start + touch.at * along;
  }
  touch.at_start = !advanced;
  if (touch.at_start) touch.at = 0;
  if (advanced) touch.on_a += pair.radius_a() * touch.normal;
  return true;
}

}  // namespace plumb::impulse
