// Where a convex shape that turns while it goes along a line first meets one that holds still, or a triangle, or a
// plane. All is seen from what it is cast at, which is A; numbers are double.
//
// Conservative advancement (Mirtich, "Impulse-based dynamic simulation of rigid body systems", 1996, section 2.3): a
// plane that parts the two stays with one of them, and B goes on for as long as no point of the other can be through
// it. How long that is Mirtich bounds by the furthest point; here it is bounded by where each point is and how fast it
// comes nearer, and what that leaves out by the bend of the furthest point's circle. So also grazing takes a few rounds
// only.
#pragma once

#include "math/angle.hpp"
#include "queries/surface_pairs.hpp"

namespace plumb::impulse {

struct TurningWay {
  Vec64 along;      ///< unit, or 0
  Vec64 axis;       ///< unit, or 0
  double turning;   ///< rad for each unit of the way
  double length;    ///< of all of it
  Quat64 at_start;  ///< B's axes

  [[nodiscard]] PLUMB_HD Mat33<double> turn(double at) const {
    const SinCosOf<double> half = sin_cos64(turning * at / 2);
    const Vec64 v = half.sine * axis;
    return to_matrix(normalized(Quat64{v.x, v.y, v.z, half.cosine} * at_start));
  }
};

/// B's furthest point along n, from its origin, without its radius.
template <class Pair>
PLUMB_HD double furthest(const Pair& pair, const Vec64& n) {
  return dot(n, pair.turn * core_support(pair.b, pair.hulls, multiply_transposed(pair.turn, n)));
}

/// A place before the first x > 0 where `left`, which is concave and `at_0` > 0 at 0, is 0; `rest` where that is
/// beyond. Chords of such a function are below it, and so meet 0 before it does.
template <class Left>
PLUMB_HD double before_root(const Left& left, double at_0, double rest) {
  constexpr int kChords = 3, kMostEighths = 16;
  double low = 0, high = rest, left_low = at_0, left_high = left(high);
  if (left_high > 0) return rest;
  // Down to the size of the root, which may be a millionth of the rest.
  for (int k = 0; k < kMostEighths && low == 0; ++k) {
    const double x = high / 8, left_x = left(x);
    (left_x > 0 ? low : high) = x;
    (left_x > 0 ? left_low : left_high) = left_x;
  }
  for (int chord = 0; chord < kChords; ++chord) {
    const double next = low + (high - low) * (left_low / (left_low - left_high)), left_next = left(next);
    low = next;
    left_low = left_next;
    if (!(left_next > 0)) break;  // by rounding: it is met here
    const double middle = (low + high) / 2, left_middle = left(middle);
    (left_middle > 0 ? low : high) = middle;
    (left_middle > 0 ? left_low : left_high) = left_middle;
  }
  return low;
}

/// How far on the way no point of B is through a plane that stays with A and lies ahead by `gap`, in the unit direction
/// `ahead`; `rest`, which is all that is left of the way, where none is all along. What is left of the gap after x is
/// at least
///   gap - x along.ahead - (furthest(ahead + x bent) - furthest(ahead)) - reach |bent| turning x^2 / 2,
/// where bent is how `ahead` begins to turn, seen from B: the last term bounds the rest of Taylor's series.
template <class Pair>
PLUMB_HD double advance_to_plane_of_a(const Pair& pair, const TurningWay& way, const Vec64& ahead, double gap,
                                      double rest) {
  const Vec64 bent = way.turning * cross(ahead, way.axis);
  const double now = furthest(pair, ahead), approach = dot(way.along, ahead),
               bend = length(bent) * way.turning * static_cast<double>(pair.b.reach) / 2;
  const auto left = [&](double x) {
    return gap - x * approach - (furthest(pair, ahead + x * bent) - now) - bend * x * x;
  };
  return before_root(left, gap, rest);
}

/// The same of a plane that stays with B, and of A's points, which turn about B's origin the other way. A face of B
/// that sweeps past a corner is seen so: of the plane at the corner it is beyond with its ends long before.
template <class Pair>
PLUMB_HD double advance_to_plane_of_b(const Pair& pair, const TurningWay& way, const Vec64& ahead, double gap,
                                      double rest) {
  const Vec64 bent = way.turning * cross(way.axis, ahead);
  const double turn = length(bent), approach = dot(way.along, ahead), speed = length(way.along),
               furthest_of_a = length(pair.shift) + pair.reach() - static_cast<double>(pair.b.reach),
               bend = turn * way.turning * furthest_of_a / 2 + turn * speed;
  const auto nearest_of_a = [&](const Vec64& n) {
    Vec64 on_a;
    (void)pair.support(-n, on_a);
    return dot(n, on_a - pair.shift);
  };
  const double now = nearest_of_a(ahead);
  const auto left = [&](double x) {
    return gap - x * approach + (nearest_of_a(ahead + x * bent) - now) -
           (bend + x * speed * turn * way.turning / 2) * x * x;
  };
  return before_root(left, gap, rest);
}

/// How far A and B are apart where they are now, and how far the planes across the normal that touch the two: of curved
/// shapes a little less, for the normal is not exact.
struct PartingPair {
  PLUMB_HD ShapeGap<double> gap(const auto& pair) const { return shape_gap(pair); }
  PLUMB_HD double planes(const auto& pair, const ShapeGap<double>& gap) const {
    Vec64 on_a;
    return -dot(gap.normal, pair.support(gap.normal, on_a)) - pair.radii();
  }
  PLUMB_HD double advance(const auto& pair, const TurningWay& way, const Vec64& ahead, double planes,
                          double rest) const {
    const double of_a = advance_to_plane_of_a(pair, way, ahead, planes, rest);
    return of_a >= rest ? rest : max(of_a, advance_to_plane_of_b(pair, way, ahead, planes, rest));
  }
};
/// The same where A is a plane.
struct PartingPlaneBelow {
  PLUMB_HD ShapeGap<double> gap(const SurfacePair& pair) const {
    const Vec64 lowest = plane::lowest(pair);
    return {lowest.y <= 0, lowest.y, {0, 1, 0}, {lowest.x, 0, lowest.z}, lowest};
  }
  PLUMB_HD double planes(const SurfacePair& /*pair*/, const ShapeGap<double>& gap) const { return gap.distance; }
  PLUMB_HD double advance(const SurfacePair& pair, const TurningWay& way, const Vec64& ahead, double planes,
                          double rest) const {
    return advance_to_plane_of_a(pair, way, ahead, planes, rest);
  }
};

/// Moves B on its way, no further than `most`, until it touches A. False where it does not.
template <class Pair, class Parting>
PLUMB_HD bool cast_turning(Pair pair, const TurningWay& way, double most, const Parting& parting,
                           CastTouch<double>& touch) {
  constexpr int kMostRounds = 512;  // then it is put where the search has come, which is before it
  const double enough = 0x1p-34 * static_cast<double>(pair.b.reach), end = min(way.length, static_cast<double>(kHuge));
  const double fastest = length(way.along) + way.turning * static_cast<double>(pair.b.reach);  // of B's points
  const Vec64 start = pair.shift;
  touch.at = 0;
  bool advanced = false;
  for (int round = 0; round < kMostRounds; ++round) {
    pair.shift = start + touch.at * way.along;
    pair.turn = way.turn(touch.at);
    const ShapeGap<double> gap = parting.gap(pair);
    if (!gap.cores_overlap) touch.on_a = gap.on_a;
    if (gap.cores_overlap || gap.distance <= enough) break;
    touch.normal = gap.normal;
    advanced = true;
    const double rest = end - touch.at, planes = parting.planes(pair, gap), slowest = gap.distance / fastest;
    const double further = max(slowest, planes > 0 ? parting.advance(pair, way, -gap.normal, planes, rest) : 0.0);
    if (further >= rest || touch.at + further > most) return false;
    if (!(touch.at + further > touch.at)) break;
    touch.at += further;
  }
  touch.at_start = !advanced;
  return true;
}

namespace surface {

/// As NearestTouch, of what turns.
template <class Surface>
struct NearestTurningTouch {
  const Surface& on;
  const SurfacePair& pair;
  const TurningWay& way;
  double most;
  CastTouch<double>& touch;
  std::uint32_t triangle = kNoCorner;

  PLUMB_HD void operator()(std::uint32_t t) {
    const Triangle seen = on.triangle(t);
    const Vec64 middle = middle_of<double>(seen);
    CastTouch<double> found;
    if (!cast_turning(TrianglePair<double>(seen, pair, middle), way, most, PartingPair{}, found)) return;
    if (!found.at_start && found.at == most && triangle != kNoCorner && t > triangle) return;
    triangle = t;
    touch = found;
    touch.on_a += middle;
    most = found.at_start ? -1 : found.at;
  }
};

}  // namespace surface

/// about: all that B can reach of what is around its origin, in A's axes.
PLUMB_HD PLUMB_OUT_OF_LINE inline bool cast_turning_at_surface(const Surfaces& surfaces, const SurfacePair& pair,
                                                               const TurningWay& way, const Box& about, double most,
                                                               CastTouch<double>& touch, std::uint32_t& triangle) {
  with_surface(surfaces, pair.a, [&](const auto& on) {
    surface::NearestTurningTouch<std::decay_t<decltype(on)>> nearest{on, pair, way, most, touch};
    visit_way(on, {pair.shift, way.along, about}, nearest);
    triangle = nearest.triangle;
  });
  return triangle != kNoCorner;
}

}  // namespace plumb::impulse
