// Pair functions: the contact manifold of two shapes.
//
// All are asked about a ShapePair (shape_pair.hpp). `out` receives the points whose separation is at most its
// margin; touching counts. A return of false, with out.count 0, means that the shapes are further apart. The normal
// points from A to B; positions are relative to A's origin.
#pragma once

#include "bodies/body.hpp"
#include "narrowphase/feature.hpp"
#include "narrowphase/manifold.hpp"
#include "narrowphase/shape_pair.hpp"

namespace plumb::impulse {

/// Makes the manifold of (B, A) that of (A, B).
PLUMB_HD inline void swap_sides(const Vec& d, Manifold& m) {
  m.normal = -m.normal;
  for (std::uint32_t i = 0; i < m.count; ++i) {
    m.points[i].position += d;
    m.points[i].feature = swapped_feature(m.points[i].feature);
  }
}

/// Any two convex shapes.
PLUMB_HD bool collide(const ShapePair& pair, const Hulls& hulls, Manifold& out);

/// A convex shape A and a plane, or a triangle of a mesh or a height field, B.
PLUMB_HD bool collide_with_piece(const ShapePair& pair, const Proxies& proxies, std::uint32_t triangle, Manifold& out);

}  // namespace plumb::impulse

#include "narrowphase/collide_any.hpp"
