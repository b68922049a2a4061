// Pair functions by the types that shapes turn out to have, compiled with each file that calls them: kernels have to
// be, and hits of queries at surfaces have been seen to end in other bits where a CPU called them from another file.
#pragma once

#include "narrowphase/collide.hpp"
#include "narrowphase/collide_pieces.hpp"
#include "narrowphase/convex/box_box.hpp"
#include "narrowphase/convex/capsule.hpp"
#include "narrowphase/convex/cylinder_pairs.hpp"
#include "narrowphase/convex/polyhedra.hpp"
#include "narrowphase/convex/round.hpp"
#include "narrowphase/convex/round_polyhedron.hpp"

namespace plumb::impulse {

/// A convex shape and a cylinder.
PLUMB_HD inline bool collide_with_cylinder(const ShapePair& pair, const Hulls& hulls, Manifold& out) {
  switch (pair.a.type) {
    case ShapeType::kSphere: return collide_sphere_cylinder(pair, hulls, out);
    case ShapeType::kBox: return collide_box_cylinder(pair, hulls, out);
    case ShapeType::kCapsule: return collide_capsule_cylinder(pair, hulls, out);
    case ShapeType::kHull: return collide_hull_cylinder(pair, hulls, out);
    default: return collide_cylinder_cylinder(pair, hulls, out);
  }
}

/// Any two convex shapes without cylinders, with a.type <= b.type.
PLUMB_HD inline bool collide_ordered(const ShapePair& pair, const Hulls& hulls, Manifold& out) {
  const auto kind = [](ShapeType type_a, ShapeType type_b) {
    return static_cast<std::uint32_t>(type_a) * kShapeTypes + static_cast<std::uint32_t>(type_b);
  };
  using enum ShapeType;
  switch (kind(pair.a.type, pair.b.type)) {
    case kind(kSphere, kSphere): return collide_sphere_sphere(pair, hulls, out);
    case kind(kSphere, kBox): return collide_sphere_box(pair, hulls, out);
    case kind(kSphere, kCapsule): return collide_sphere_capsule(pair, hulls, out);
    case kind(kSphere, kHull): return collide_sphere_hull(pair, hulls, out);
    case kind(kBox, kBox): return collide_box_box(pair, hulls, out);
    case kind(kBox, kCapsule): return collide_box_capsule(pair, hulls, out);
    case kind(kBox, kHull): return collide_box_hull(pair, hulls, out);
    case kind(kCapsule, kCapsule): return collide_capsule_capsule(pair, hulls, out);
    case kind(kCapsule, kHull): return collide_capsule_hull(pair, hulls, out);
    default: return collide_hull_hull(pair, hulls, out);
  }
}

/// Any two convex shapes with a.type <= b.type.
PLUMB_HD inline bool collide_convex(const ShapePair& pair, const Hulls& hulls, Manifold& out) {
  return pair.b.type == ShapeType::kCylinder ? collide_with_cylinder(pair, hulls, out)
                                             : collide_ordered(pair, hulls, out);
}

/// Any two convex shapes.
PLUMB_HD inline bool collide(const ShapePair& pair, const Hulls& hulls, Manifold& out) {
  if (pair.a.type <= pair.b.type) return collide_convex(pair, hulls, out);
  const bool touch = collide_convex(pair.swapped(), hulls, out);
  if (touch) swap_sides(pair.d, out);
  return touch;
}

/// A convex, B not.
PLUMB_HD inline bool collide_with_piece(const ShapePair& pair, const Proxies& proxies, std::uint32_t triangle,
                                        Manifold& out) {
  out.count = 0;
  return with_convex_type(pair.a.type, [&](auto type) {
    using enum ShapeType;
    switch (pair.b.type) {
      case kPlane: return collide_with_piece_of<type(), kPlane>(pair, proxies, triangle, out);
      case kMesh: return collide_with_piece_of<type(), kMesh>(pair, proxies, triangle, out);
      default: return collide_with_piece_of<type(), kHeightField>(pair, proxies, triangle, out);
    }
  });
}

}  // namespace plumb::impulse
