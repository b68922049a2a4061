// Shapes as kernels see them.
#pragma once

#include <cstdint>
#include <type_traits>

#include "math/quat.hpp"

namespace plumb::impulse {

enum class ShapeType : std::uint32_t {
  kSphere = 0,
  kBox = 1,
  kCapsule = 2,
  kHull = 3,
  kCylinder = 4,
  kPlane = 5,
  kMesh = 6,
  kHeightField = 7
};
constexpr std::uint32_t kShapeTypes = 8;
/// Of those, the first so many are convex and finite.
constexpr std::uint32_t kConvexTypes = 5;
PLUMB_HD constexpr bool is_convex(ShapeType type) { return static_cast<std::uint32_t>(type) < kConvexTypes; }

PLUMB_HD constexpr bool is_surface(ShapeType type) {
  return type == ShapeType::kMesh || type == ShapeType::kHeightField;
}
/// A bit for each type in a set.
constexpr std::uint32_t bit_of(ShapeType type) { return 1U << static_cast<std::uint32_t>(type); }
/// f(std::integral_constant of the type), of a convex type; false of others.
template <class F>
PLUMB_HD bool with_convex_type(ShapeType type, const F& f) {
  using enum ShapeType;
  switch (type) {
    case kSphere: return f(std::integral_constant<ShapeType, kSphere>{});
    case kBox: return f(std::integral_constant<ShapeType, kBox>{});
    case kCapsule: return f(std::integral_constant<ShapeType, kCapsule>{});
    case kHull: return f(std::integral_constant<ShapeType, kHull>{});
    case kCylinder: return f(std::integral_constant<ShapeType, kCylinder>{});
    default: return false;
  }
}
/// Those that are not collided as they are found: planes are in no tree, surfaces are taken triangle by triangle.
constexpr std::uint32_t kMidphaseTypes =
    bit_of(ShapeType::kPlane) | bit_of(ShapeType::kMesh) | bit_of(ShapeType::kHeightField);

/// One shape, in its own frame.
struct Shape {
  ShapeType type;
  std::uint32_t hull;  ///< hulls, meshes, height fields: its row among those
  /// Sphere: radius, -, -. Box: half extents. Capsule: radius, half length of its segment, -. Cylinder: radius, half
  /// height, -. Mesh and height field: half extents of its box, whose centre is the frame's origin.
  Vec size;
  Real reach;  ///< radius of the ball about the frame's origin that holds the shape
};

/// A face's polygon: `count` indices into the hull's loop array from `first`, counter-clockwise seen from outside.
struct HullFace {
  Vec normal;   ///< unit, outward
  Real offset;  ///< dot(normal, p) of its points
  std::uint32_t first, count;
};
/// An edge between two vertices and the two faces that it joins.
struct HullEdge {
  std::uint32_t from, to;     ///< vertices
  std::uint32_t left, right;  ///< faces; the left one's loop runs from -> to
};
/// Where a hull's parts lie in the pool's arrays.
struct HullRange {
  std::uint32_t first_vertex, vertex_count;
  std::uint32_t first_face, face_count;
  std::uint32_t first_loop;  ///< HullFace::first counts from here
  std::uint32_t first_edge, edge_count;
  Vec centre;         ///< a point well inside
  Real inner_radius;  ///< of the largest ball about it that the hull holds
};

/// All hulls of a world.
struct Hulls {
  const HullRange* ranges;
  const Vec* vertices;
  const HullFace* faces;
  const std::uint32_t* loops;  ///< vertex indices, counted from the hull's first vertex
  const HullEdge* edges;
  bool operator==(const Hulls&) const = default;
};

}  // namespace plumb::impulse
