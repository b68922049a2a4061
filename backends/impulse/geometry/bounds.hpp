// Bounding volumes of a shape at an orientation, relative to the shape's origin, and whether two of them overlap:
// balls, axis-aligned boxes (box.hpp, shape_box.hpp), turned boxes and 18-DOPs, in the order of what they cost and how
// closely they fit. All are exact: each touches its shape on every side that it has. Touching volumes overlap. d is
// from the first shape's origin to the second's.
#pragma once

#include "geometry/shape_box.hpp"
#include "narrowphase/box_box.hpp"

namespace plumb::impulse {

struct Ball {
  Vec centre;
  Real radius;
};

PLUMB_HD inline Ball shape_ball(const Shape& shape, const Quat& orientation, const Hulls& hulls) {
  if (shape.type != ShapeType::kHull) return {{0, 0, 0}, shape.reach};
  const HullRange& hull = hulls.ranges[shape.hull];
  Real square = 0;
  for (std::uint32_t v = 0; v < hull.vertex_count; ++v)
    square = max(square, length_squared(hulls.vertices[hull.first_vertex + v] - hull.centre));
  return {rotate(orientation, hull.centre), sqrt(square)};
}
PLUMB_HD inline bool overlap(const Ball& a, const Ball& b, const Vec& d) {
  const Real radii = a.radius + b.radius;
  return length_squared(d + b.centre - a.centre) <= radii * radii;
}

PLUMB_HD inline bool overlap(const Box& a, const Box& b, const Vec& d) {
  return overlap(a, Box{b.low + d, b.high + d});
}

/// A box turned with the shape.
struct TurnedBox {
  Vec centre;  ///< in the world's axes
  Quat orientation;
  Vec half;
};

PLUMB_HD inline TurnedBox shape_turned_box(const Shape& shape, const Quat& orientation, const Hulls& hulls) {
  if (shape.type == ShapeType::kBox) return {{0, 0, 0}, orientation, shape.size};
  const Box local = shape_box(shape, {0, 0, 0, 1}, hulls);
  return {rotate(orientation, Real(0.5) * (local.low + local.high)), orientation, Real(0.5) * (local.high - local.low)};
}
/// The 15 axes of Gottschalk's test.
PLUMB_HD inline bool overlap(const TurnedBox& a, const TurnedBox& b, const Vec& d) {
  const box_box::BoxPair pair = {a.half, b.half, to_matrix(conjugate(a.orientation) * b.orientation),
                                 rotate_back(a.orientation, d + b.centre - a.centre)};
  box_box::BoxAxis axis;
  return box_box::find_axis(pair, 0, kTie * (length(a.half) + length(b.half)), axis);
}

/// Slabs across the three axes and the six diagonals of their planes: 18 half-spaces (Klosowski et al. 1998). Not of
/// unit length: overlap needs no lengths.
struct Kdop {
  static constexpr int kSlabs = 9;
  Real low[kSlabs], high[kSlabs];

  PLUMB_HD static Vec direction(int slab) {
    constexpr signed char x[] = {1, 0, 0, 1, 1, 0, 1, 1, 0}, y[] = {0, 1, 0, 1, 0, 1, -1, 0, 1},
                          z[] = {0, 0, 1, 0, 1, 1, 0, -1, -1};
    return {static_cast<Real>(x[slab]), static_cast<Real>(y[slab]), static_cast<Real>(z[slab])};
  }
};

/// The range of dot(n, p) over the shape.
struct Extent {
  Real low, high;
};
PLUMB_HD inline Extent shape_extent(const Shape& shape, const Quat& orientation, const Vec& n, const Hulls& hulls) {
  const Vec local = rotate_back(orientation, n);
  Real high = 0;
  switch (shape.type) {
    case ShapeType::kSphere: high = length(n) * shape.size.x; break;
    case ShapeType::kBox: high = dot(abs(local), shape.size); break;
    case ShapeType::kCapsule: high = abs(local.y) * shape.size.y + length(n) * shape.size.x; break;
    case ShapeType::kHull: {
      const HullRange& hull = hulls.ranges[shape.hull];
      Extent e = {kHuge, -kHuge};
      for (std::uint32_t v = 0; v < hull.vertex_count; ++v) {
        const Real s = dot(local, hulls.vertices[hull.first_vertex + v]);
        e = {min(e.low, s), max(e.high, s)};
      }
      return e;
    }
    case ShapeType::kCylinder: {
      high = abs(local.y) * shape.size.y + sqrt(local.x * local.x + local.z * local.z) * shape.size.x;
      break;
    }
    case ShapeType::kMesh:
    case ShapeType::kHeightField: high = dot(abs(local), shape.size); break;
    case ShapeType::kPlane: return {kHuge, -kHuge};
  }
  return {-high, high};
}

PLUMB_HD inline Kdop shape_kdop(const Shape& shape, const Quat& orientation, const Hulls& hulls) {
  Kdop k;
  for (int i = 0; i < Kdop::kSlabs; ++i) {
    const Extent e = shape_extent(shape, orientation, Kdop::direction(i), hulls);
    k.low[i] = e.low;
    k.high[i] = e.high;
  }
  return k;
}
PLUMB_HD inline bool overlap(const Kdop& a, const Kdop& b, const Vec& d) {
  for (int i = 0; i < Kdop::kSlabs; ++i) {
    const Real along = dot(Kdop::direction(i), d);
    if (a.low[i] > b.high[i] + along || b.low[i] + along > a.high[i]) return false;
  }
  return true;
}

}  // namespace plumb::impulse
