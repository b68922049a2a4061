// A convex shape and a plane or a surface: whether they overlap, where one that moves along a line meets the other, and
// how far they are apart. The plane or surface is A and holds still, everything is in its frame; numbers are double.
#pragma once

#include <limits>

#include "geometry/shape_box.hpp"
#include "narrowphase/convex/distance.hpp"
#include "narrowphase/triangle/triangle_core.hpp"
#include "queries/line_surface.hpp"
#include "queries/query_scene.hpp"

namespace plumb::impulse {

using SurfacePair = PlacedPair<double>;

/// The box about B's origin, a little too large rather than too small; axes as `turn` has B's.
PLUMB_HD inline Box box_about(const Shape& shape, const Quat64& turn, const Hulls& hulls) {
  const Box box = shape_box(shape, to_numbers<Real>(turn), hulls);
  const Vec rounding = (8 * kEpsilon) * (abs(box.low) + abs(box.high));
  return {box.low - rounding, box.high + rounding};
}

/// How far B is from A where that is so far that its fourth power is beyond all numbers, and their sizes count for
/// nothing. False: it is not.
PLUMB_HD inline bool is_beyond(const Vec64& shift, ShapeGap<double>& gap) {
  constexpr double kBeyond = 1e70;
  const Vec64 m = abs(shift);
  const double most = max(m.x, max(m.y, m.z));
  if (!(most > kBeyond)) return false;
  const Vec64 scaled = {shift.x / most, shift.y / most, shift.z / most};
  const double size = length(scaled);
  gap = {false, most * size, {scaled.x / size, scaled.y / size, scaled.z / size}, {0, 0, 0}, shift};
  return true;
}

namespace plane {

/// The lowest point of B.
PLUMB_HD inline Vec64 lowest(const SurfacePair& pair) {
  const Vec64 down = multiply_transposed(pair.turn, Vec64{0, -1, 0});
  const Vec64 p = pair.turn * core_support(pair.b, pair.hulls, down) + pair.shift;
  return {p.x, p.y - pair.radius_b(), p.z};
}

PLUMB_HD inline bool cast(const SurfacePair& pair, const Vec64& along, double most, CastTouch<double>& touch) {
  const Vec64 from = lowest(pair);
  touch.at_start = from.y <= 0;
  touch.at = 0;
  if (touch.at_start) return true;
  if (!(along.y < 0)) return false;
  touch.at = -from.y / along.y;
  if (touch.at > most) return false;
  touch.normal = {0, 1, 0};
  touch.on_a = {from.x + touch.at * along.x, 0, from.z + touch.at * along.z};
  return true;
}

}  // namespace plane

namespace surface {

/// The nearest touch; of equal ones that of the first triangle. The search ends with a triangle that is overlapped.
template <class Surface>
struct NearestTouch {
  const Surface& on;
  const SurfacePair& pair;
  Vec64 along;
  double most;
  CastTouch<double>& touch;
  std::uint32_t triangle = kNoCorner;

  PLUMB_HD void operator()(std::uint32_t t) {
    const Triangle seen = on.triangle(t);
    const Vec64 middle = middle_of<double>(seen);
    CastTouch<double> found;
    if (!cast_shape(TrianglePair<double>(seen, pair, middle), along, most, found)) return;
    if (!found.at_start && found.at == most && triangle != kNoCorner && t > triangle) return;
    triangle = t;
    touch = found;
    touch.on_a += middle;
    most = found.at_start ? -1 : found.at;
  }
};

template <class Surface>
struct AnyOverlap {
  const Surface& on;
  const SurfacePair& pair;
  double most = 0;
  std::uint32_t triangle = kNoCorner;

  PLUMB_HD void operator()(std::uint32_t t) {
    const Triangle seen = on.triangle(t);
    if (!shapes_overlap(TrianglePair<double>(seen, pair, middle_of<double>(seen)))) return;
    triangle = t;
    most = -1;
  }
};

/// What of a surface comes nearest to a shape.
struct NearestTriangle {
  ShapeGap<double> gap{true, std::numeric_limits<double>::infinity(), {}, {}, {}};
  std::uint32_t triangle = kNoCorner;

  /// Looks at one more. Of those that are overlapped, and of equal ones, the first counts.
  template <class Surface>
  PLUMB_HD void look(const Surface& on, std::uint32_t t, const SurfacePair& pair) {
    const Triangle seen = on.triangle(t);
    const Vec64 middle = middle_of<double>(seen);
    ShapeGap<double> found = shape_gap(TrianglePair<double>(seen, pair, middle));
    if (found.cores_overlap) found.distance = -static_cast<double>(kHuge);
    if (found.distance > gap.distance || (found.distance == gap.distance && t > triangle)) return;
    triangle = t;
    gap = found;
    gap.on_a += middle;
    gap.on_b += middle;
  }
  /// `box` and what is about it as far as the nearest so far, in the engine's numbers and a little larger.
  [[nodiscard]] PLUMB_HD Box within(const Box& box) const {
    const Real far = static_cast<Real>(clamp(gap.distance, 0.0, static_cast<double>(kHuge)));
    const Vec size = abs(box.low) + abs(box.high) + Vec{far, far, far};
    const Vec more = Vec{far, far, far} + (8 * kEpsilon) * size;
    return {box.low - more, box.high + more};
  }
};

/// How deep the shape is below the triangle's plane, on the side where its origin is not.
PLUMB_HD inline ShapeGap<double> gap_below(const Triangle& triangle, const SurfacePair& pair) {
  const Vec64 corner = to_numbers<double>(triangle.at[0]);
  const Vec64 n = normal_against(triangle, corner - pair.shift);
  const Vec64 core = core_support(pair.b, pair.hulls, multiply_transposed(pair.turn, -n));
  const Vec64 deepest = pair.turn * core + pair.shift - pair.radius_b() * n;
  const double height = min(dot(n, deepest - corner), 0.0);
  return {false, height, n, deepest - height * n, deepest};
}

/// How far apart two boxes are, squared.
PLUMB_HD inline Real square_between(const Box& a, const Box& b) {
  const Vec none = {0, 0, 0};
  return length_squared(max(none, max(a.low - b.high, b.low - a.high)));
}

/// box: of the shape in the surface's frame. First by the nearer box down to one triangle, then all that may be nearer.
PLUMB_HD inline void find_nearest(const MeshView& mesh, const Box& box, const SurfacePair& pair,
                                  NearestTriangle& nearest) {
  const TreeView& tree = mesh.tree;
  std::uint32_t id = tree.root();
  if (id == TreeView::kEnd) return;
  while (TreeView::is_inner(id)) {
    const std::uint32_t first = tree.nodes[id].child, second = tree.nodes[first].next;
    const auto far = [&](std::uint32_t n) { return square_between(box, {tree.nodes[n].low, tree.nodes[n].high}); };
    id = far(second) < far(first) ? second : first;
  }
  nearest.look(mesh, tree.nodes[id].child, pair);
  Box about = nearest.within(box);
  for (id = tree.root(); id != TreeView::kEnd;) {
    const TreeNode& node = tree.nodes[id];
    const bool near = overlap(about, Box{node.low, node.high}), inner = TreeView::is_inner(id);
    if (near && !inner) {
      nearest.look(mesh, node.child, pair);
      about = nearest.within(box);
    }
    id = near && inner ? node.child : node.next;
  }
}
PLUMB_HD inline void find_nearest(const HeightView& field, const Box& box, const SurfacePair& pair,
                                  NearestTriangle& nearest) {
  const auto cell = [](double x, Real first, Real spacing, std::uint32_t corners) {
    const double at = (x - static_cast<double>(first)) / static_cast<double>(spacing);
    return at > 0 ? static_cast<std::uint32_t>(min(at, static_cast<double>(corners - 2))) : 0U;
  };
  const std::uint32_t column = cell(pair.shift.x, field.x0, field.spacing_x, field.columns),
                      row = cell(pair.shift.z, field.z0, field.spacing_z, field.rows);
  nearest.look(field, 2 * (row * (field.columns - 1) + column), pair);
  const auto look = [&](std::uint32_t t) {
    const Triangle seen = field.triangle(t);
    const Box bounds = {min(seen.at[0], min(seen.at[1], seen.at[2])), max(seen.at[0], max(seen.at[1], seen.at[2]))};
    if (overlap(nearest.within(box), bounds)) nearest.look(field, t, pair);
  };
  field.overlaps(nearest.within(box), look);
}

}  // namespace surface

/// B along a unit vector against the surface. turn: of B. triangle: that which is met.
PLUMB_HD PLUMB_OUT_OF_LINE inline bool cast_at_surface(const Surfaces& surfaces, const SurfacePair& pair,
                                                       const Quat64& turn, const Vec64& along, double most,
                                                       CastTouch<double>& touch, std::uint32_t& triangle) {
  const SurfaceWay way = {pair.shift, along, box_about(pair.b, turn, pair.hulls)};
  with_surface(surfaces, pair.a, [&](const auto& on) {
    surface::NearestTouch<std::decay_t<decltype(on)>> nearest{on, pair, along, most, touch};
    visit_way(on, way, nearest);
    triangle = nearest.triangle;
  });
  return triangle != kNoCorner;
}

PLUMB_HD PLUMB_OUT_OF_LINE inline bool overlaps_surface(const Surfaces& surfaces, const SurfacePair& pair,
                                                        const Quat64& turn, std::uint32_t& triangle) {
  const SurfaceWay way = {pair.shift, {0, 0, 0}, box_about(pair.b, turn, pair.hulls)};
  with_surface(surfaces, pair.a, [&](const auto& on) {
    surface::AnyOverlap<std::decay_t<decltype(on)>> any{on, pair};
    visit_way(on, way, any);
    triangle = any.triangle;
  });
  return triangle != kNoCorner;
}

}  // namespace plumb::impulse
