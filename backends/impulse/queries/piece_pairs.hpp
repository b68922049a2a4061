// Posed pairs of convex shapes, and of a convex shape and a plane or a surface: what touches by the pair functions of
// the step, else how far they are apart.
#pragma once

#include "narrowphase/collide.hpp"
#include "queries/line_surface.hpp"
#include "queries/pair_contacts.hpp"
#include "queries/surface_pairs.hpp"

namespace plumb::impulse {

PLUMB_HD inline void take_deepest(PairAnswer& answer) {
  const Manifold& manifold = answer.manifold;
  std::uint32_t deepest = 0;
  for (std::uint32_t i = 1; i < manifold.count; ++i)
    if (manifold.points[i].separation < manifold.points[deepest].separation) deepest = i;
  answer.distance = static_cast<double>(manifold.points[deepest].separation);
  answer.normal = to_numbers<double>(manifold.normal);
  answer.at = to_numbers<double>(manifold.points[deepest].position);
}

PLUMB_HD inline PairAnswer answer_convex(const PosedPair& pair, const Hulls& hulls) {
  PairAnswer answer;
  answer.triangle = answer.touches = 0;
  const Vec apart = between(pair.place_a, pair.place_b);
  if (collide({pair.a, pair.b, to_numbers<Real>(pair.turn_a), to_numbers<Real>(pair.turn_b), apart, 0}, hulls,
              answer.manifold)) {
    take_deepest(answer);
    return answer;
  }
  answer.manifold.count = 0;
  const PlacedPair<double> placed = {pair.a, pair.b, to_matrix(conjugate(pair.turn_a) * pair.turn_b),
                                     rotate_back(pair.turn_a, pair.place_b - pair.place_a), hulls};
  ShapeGap<double> gap;
  if (!is_beyond(placed.shift, gap)) gap = shape_gap(placed);
  if (gap.cores_overlap) {  // by rounding alone
    answer.distance = 0;
    answer.normal = to_numbers<double>(normalized_or(apart, {0, 1, 0}));
    answer.at = {0, 0, 0};
  } else {
    answer.distance = max(gap.distance, 0.0);
    answer.normal = rotate(pair.turn_a, gap.normal);
    answer.at = rotate(pair.turn_a, gap.on_a);
  }
  return answer;
}

/// Takes pieces that touch: keeps the deepest, of equal ones that of the first triangle, and where there is room
/// writes them all.
struct TouchesOfPair {
  PieceTouch* rows;
  std::uint32_t count = 0;
  PairAnswer deepest{};

  PLUMB_HD void add(std::uint32_t triangle, const Manifold& manifold) {
    if (rows != nullptr) rows[count] = {manifold, triangle};
    PairAnswer other{};
    other.manifold = manifold;
    other.triangle = triangle;
    take_deepest(other);
    const bool better =
        other.distance < deepest.distance || (other.distance == deepest.distance && triangle < deepest.triangle);
    if (count == 0 || better) deepest = other;
    ++count;
  }
};

/// One of both is a plane or a surface.
class PiecePair {
 public:
  PLUMB_HD PiecePair(const PosedPair& pair, const Hulls& hulls, const Surfaces& surfaces)
      : pair_(pair),
        hulls_(hulls),
        surfaces_(surfaces),
        swapped_(uses_midphase(pair.a)),
        piece_(swapped_ ? pair.a : pair.b),
        convex_(swapped_ ? pair.b : pair.a),
        apart_(between(pair.place_a, pair.place_b)) {}

  /// The manifolds are those of (a, b).
  PLUMB_HD void look(TouchesOfPair& touches) const {
    if (piece_.type == ShapeType::kPlane) {
      look_at(0, touches);
      return;
    }
    const Box box = box_in_piece();
    if (!overlap(box, Box{-piece_.size, piece_.size})) return;
    const auto each = [&](std::uint32_t triangle) { look_at(triangle, touches); };
    if (piece_.type == ShapeType::kMesh)
      surfaces_.meshes[piece_.hull].overlaps(box, each);
    else
      surfaces_.fields[piece_.hull].overlaps(box, each);
  }

  /// Of what does not touch. What overlaps all the same, where the pair functions leave it to a triangle beside that
  /// does not touch either, is told by one point: where the shape is deepest below the triangle's plane.
  PLUMB_HD void tell_gap(PairAnswer& answer) const {
    const Quat64 relative = conjugate(turn_piece()) * turn_convex();
    const Vec64 to_convex = swapped_ ? pair_.place_b - pair_.place_a : pair_.place_a - pair_.place_b;
    const SurfacePair pair = {piece_, convex_, to_matrix(relative), rotate_back(turn_piece(), to_convex), hulls_};
    Vec64 normal = {0, 1, 0}, on_piece, on_convex;  // from the piece to the convex shape
    if (piece_.type == ShapeType::kPlane) {
      on_convex = plane::lowest(pair);
      on_piece = {on_convex.x, 0, on_convex.z};
      answer.distance = max(on_convex.y, 0.0);  // touches by rounding alone
    } else {
      surface::NearestTriangle nearest;
      const Box box = box_in_piece();
      if (is_beyond(pair.shift, nearest.gap))
        nearest.triangle = 0;
      else
        with_surface(surfaces_, piece_, [&](const auto& on) {
          surface::find_nearest(on, box, pair, nearest);
          if (nearest.gap.cores_overlap) nearest.gap = surface::gap_below(on.triangle(nearest.triangle), pair);
        });
      answer.triangle = nearest.triangle;
      answer.distance = nearest.gap.distance;
      normal = nearest.gap.normal;
      on_piece = nearest.gap.on_a;
      on_convex = nearest.gap.on_b;
    }
    answer.normal = rotate(turn_piece(), swapped_ ? normal : -normal);
    answer.at = rotate(turn_piece(), swapped_ ? on_piece : on_convex - pair.shift);
    if (answer.distance < 0) {
      const Vec64 between = 0.5 * (on_piece + on_convex);
      answer.at = rotate(turn_piece(), swapped_ ? between : between - pair.shift);
      answer.manifold.normal = to_numbers<Real>(answer.normal);
      answer.manifold.count = 1;
      answer.manifold.points[0] = {to_numbers<Real>(answer.at), static_cast<Real>(answer.distance), 0};
      answer.distance = static_cast<double>(answer.manifold.points[0].separation);
    }
  }

 private:
  [[nodiscard]] PLUMB_HD const Quat64& turn_piece() const { return swapped_ ? pair_.turn_a : pair_.turn_b; }
  [[nodiscard]] PLUMB_HD const Quat64& turn_convex() const { return swapped_ ? pair_.turn_b : pair_.turn_a; }

  /// Of the convex shape, in the piece's frame; touching counts whatever was rounded.
  [[nodiscard]] PLUMB_HD Box box_in_piece() const {
    const Vec place = rotate_back(to_numbers<Real>(turn_piece()), swapped_ ? apart_ : -apart_);
    const Box box = shape_box(convex_, to_numbers<Real>(conjugate(turn_piece()) * turn_convex()), hulls_);
    const Real more = 8 * kEpsilon * (length(place) + convex_.reach);
    const Vec wider = {more, more, more};
    return {place + box.low - wider, place + box.high + wider};
  }

  PLUMB_HD PLUMB_OUT_OF_LINE void look_at(std::uint32_t triangle, TouchesOfPair& touches) const {
    Manifold manifold;
    if (!collide_with_piece({convex_, piece_, to_numbers<Real>(turn_convex()), to_numbers<Real>(turn_piece()),
                             swapped_ ? -apart_ : apart_, 0},
                            {nullptr, nullptr, hulls_, surfaces_}, triangle, manifold))
      return;
    if (swapped_) swap_sides(apart_, manifold);
    touches.add(triangle, manifold);
  }

  const PosedPair& pair_;
  Hulls hulls_;
  Surfaces surfaces_;
  bool swapped_;
  Shape piece_, convex_;
  Vec apart_;
};

}  // namespace plumb::impulse
