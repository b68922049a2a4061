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
PLUMB_HD inline bool collide_with_cylinder(const Shape& a, const Quat& qa, const Shape& b, const Quat& qb, const Vec& d,
                                           Real margin, const Hulls& hulls, Manifold& out) {
  switch (a.type) {
    case ShapeType::kSphere: return collide_sphere_cylinder(a, qa, b, qb, d, margin, hulls, out);
    case ShapeType::kBox: return collide_box_cylinder(a, qa, b, qb, d, margin, hulls, out);
    case ShapeType::kCapsule: return collide_capsule_cylinder(a, qa, b, qb, d, margin, hulls, out);
    case ShapeType::kHull: return collide_hull_cylinder(a, qa, b, qb, d, margin, hulls, out);
    default: return collide_cylinder_cylinder(a, qa, b, qb, d, margin, hulls, out);
  }
}

/// Any two convex shapes without cylinders, with a.type <= b.type.
PLUMB_HD inline bool collide_ordered(const Shape& a, const Quat& qa, const Shape& b, const Quat& qb, const Vec& d,
                                     Real margin, const Hulls& hulls, Manifold& out) {
  const auto kind = [](ShapeType type_a, ShapeType type_b) {
    return static_cast<std::uint32_t>(type_a) * kShapeTypes + static_cast<std::uint32_t>(type_b);
  };
  using enum ShapeType;
  switch (kind(a.type, b.type)) {
    case kind(kSphere, kSphere): return collide_sphere_sphere(a, qa, b, qb, d, margin, hulls, out);
    case kind(kSphere, kBox): return collide_sphere_box(a, qa, b, qb, d, margin, hulls, out);
    case kind(kSphere, kCapsule): return collide_sphere_capsule(a, qa, b, qb, d, margin, hulls, out);
    case kind(kSphere, kHull): return collide_sphere_hull(a, qa, b, qb, d, margin, hulls, out);
    case kind(kBox, kBox): return collide_box_box(a, qa, b, qb, d, margin, hulls, out);
    case kind(kBox, kCapsule): return collide_box_capsule(a, qa, b, qb, d, margin, hulls, out);
    case kind(kBox, kHull): return collide_box_hull(a, qa, b, qb, d, margin, hulls, out);
    case kind(kCapsule, kCapsule): return collide_capsule_capsule(a, qa, b, qb, d, margin, hulls, out);
    case kind(kCapsule, kHull): return collide_capsule_hull(a, qa, b, qb, d, margin, hulls, out);
    default: return collide_hull_hull(a, qa, b, qb, d, margin, hulls, out);
  }
}

/// Any two convex shapes with a.type <= b.type.
PLUMB_HD inline bool collide_convex(const Shape& a, const Quat& qa, const Shape& b, const Quat& qb, const Vec& d,
                                    Real margin, const Hulls& hulls, Manifold& out) {
  return b.type == ShapeType::kCylinder ? collide_with_cylinder(a, qa, b, qb, d, margin, hulls, out)
                                        : collide_ordered(a, qa, b, qb, d, margin, hulls, out);
}

/// Any two convex shapes.
PLUMB_HD inline bool collide(const Shape& a, const Quat& qa, const Shape& b, const Quat& qb, const Vec& d, Real margin,
                             const Hulls& hulls, Manifold& out) {
  if (a.type <= b.type) return collide_convex(a, qa, b, qb, d, margin, hulls, out);
  const bool touch = collide_convex(b, qb, a, qa, -d, margin, hulls, out);
  if (touch) swap_sides(d, out);
  return touch;
}

/// A convex, B not.
PLUMB_HD inline bool collide_with_piece(const Shape& a, const Quat& qa, const Shape& b, const Quat& qb, const Vec& d,
                                        Real margin, const Proxies& proxies, std::uint32_t triangle, Manifold& out) {
  out.count = 0;
  return with_convex_type(a.type, [&](auto type) {
    using enum ShapeType;
    switch (b.type) {
      case kPlane: return collide_with_piece_of<type(), kPlane>(a, qa, b, qb, d, margin, proxies, triangle, out);
      case kMesh: return collide_with_piece_of<type(), kMesh>(a, qa, b, qb, d, margin, proxies, triangle, out);
      default: return collide_with_piece_of<type(), kHeightField>(a, qa, b, qb, d, margin, proxies, triangle, out);
    }
  });
}

}  // namespace plumb::impulse
