// Pair functions of a convex shape A with a plane, or with one triangle of a mesh or a height field, B. Parameters as
// in collide.hpp, the shape's row among the surfaces, and the triangle.
#pragma once

#include "bodies/body.hpp"
#include "narrowphase/convex/plane.hpp"
#include "narrowphase/convex/round_polyhedron.hpp"
#include "narrowphase/triangle/sided_surface.hpp"
#include "narrowphase/triangle/triangle_cylinder.hpp"
#include "narrowphase/triangle/triangle_polyhedron.hpp"
#include "narrowphase/triangle/triangle_round.hpp"

namespace plumb::impulse {

namespace surface {

/// A convex shape as it lies in a surface's frame.
struct ShapeOver {
  const Shape& shape;
  Quat turn;
  Vec shift;
  Real margin, tie;
};

/// A convex shape of a type that is known when this is compiled.
template <ShapeType kType, class Surface>
PLUMB_HD bool touch_with(const Surface& on, std::uint32_t t, const ShapeOver& over, [[maybe_unused]] const Hulls& hulls,
                         Manifold& out) {
  const Shape& shape = over.shape;
  if constexpr (kType == ShapeType::kSphere) {
    return touch_round(on, t, over.shift, {0, 0, 0}, shape.size.x, over.margin, out);
  } else if constexpr (kType == ShapeType::kCapsule) {
    const Vec half = rotate(over.turn, Vec{0, shape.size.y, 0});
    return touch_round(on, t, over.shift - half, half + half, shape.size.x, over.margin, out);
  } else if constexpr (kType == ShapeType::kBox) {
    return touch_polyhedron(on, t, BoxView{shape.size}, {to_matrix(over.turn), over.shift}, over.margin, over.tie, out);
  } else if constexpr (kType == ShapeType::kHull) {
    return touch_polyhedron(on, t, HullView(hulls, shape.hull), {to_matrix(over.turn), over.shift}, over.margin,
                            over.tie, out);
  } else {
    static_assert(kType == ShapeType::kCylinder);
    return touch_cylinder(on, t, {shape.size.x, shape.size.y}, {to_matrix(over.turn), over.shift}, over.margin,
                          over.tie, out);
  }
}

}  // namespace surface

/// A of type kA, B of type kB.
template <ShapeType kA, ShapeType kB>
PLUMB_HD bool collide_with_piece_of(const ShapePair& pair, const Proxies& proxies,
                                    [[maybe_unused]] std::uint32_t triangle, Manifold& out) {
  const Quat turn = conjugate(pair.qb) * pair.qa;
  const Vec shift = rotate_back(pair.qb, -pair.d);
  bool touch = false;
  if constexpr (kB == ShapeType::kPlane) {
    touch = touch_plane_with<kA>(pair.a, turn, shift, pair.margin, proxies.hulls, out);
  } else {
    const auto touch_on = [&](const auto& surfaces) {
      const surface::ShapeOver over = {pair.a, turn, shift, pair.margin, kTie * (pair.a.reach + length(shift))};
      const SidedSurface<std::remove_cvref_t<decltype(surfaces[0])>> on = {surfaces[pair.b.hull], pair.from_behind};
      return surface::touch_with<kA>(on, triangle, over, proxies.hulls, out);
    };
    if constexpr (kB == ShapeType::kMesh)
      touch = touch_on(proxies.surfaces.meshes);
    else
      touch = touch_on(proxies.surfaces.fields);
  }
  if (touch) round_polyhedron::put_second(pair.qb, pair.d, out);
  return touch;
}

}  // namespace plumb::impulse
