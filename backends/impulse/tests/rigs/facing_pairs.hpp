// Pairs of shapes as they meet in piles: with a face, an edge or any side of one towards a face, an edge or any side of
// the other; apart by a hair, touching, a hair deep and far inside each other.
#pragma once

#include "tests/rigs/narrow_reference.hpp"

namespace plumb::impulse::reference {

/// The range of dot(n, p) over the shape.
struct Extent {
  Real low, high;
};
inline Extent shape_extent(const Shape& shape, const Quat& orientation, const Vec& n, const Hulls& hulls) {
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

/// Some shapes of every type, of about a metre.
class ShapeKit {
 public:
  static constexpr std::uint32_t kEach = 16;

  explicit ShapeKit(Dice& dice) {
    const std::vector<PlumbVec3> octahedron = {{0.6, 0, 0},  {-0.6, 0, 0}, {0, 0.6, 0},
                                               {0, -0.6, 0}, {0, 0, 0.6},  {0, 0, -0.6}};
    const std::vector<PlumbVec3> wedge = {{-0.5, -0.4, -0.5}, {0.5, -0.4, -0.5}, {-0.5, -0.4, 0.5},
                                          {0.5, -0.4, 0.5},   {-0.5, 0.5, 0},    {0.5, 0.5, 0}};
    for (std::uint32_t i = 0; i < kEach; ++i) {
      const auto radius = static_cast<Real>(dice.log_uniform(0.1, 1)), half = static_cast<Real>(dice.uniform(0.05, 1));
      add({ShapeType::kSphere, 0, {radius, 0, 0}, radius});
      add(i == 0 ? make_box(0.5, 0.5, 0.5) : random_box(dice, 1));
      add({ShapeType::kCapsule, 0, {radius / 2, half, 0}, radius / 2 + half});
      if (i < 2) {
        const std::uint32_t row = hulls.add(i == 0 ? octahedron : wedge);
        add({ShapeType::kHull, row, {0, 0, 0}, hulls.reach(row)});
      } else {
        add(random_hull(dice, hulls, 1, 8 * i));  // those of many corners have more than 64 edges
      }
      add({ShapeType::kCylinder, 0, {radius, half, 0}, sqrt(radius * radius + half * half)});
    }
  }
  /// Row among `shapes`, of a shape of that type.
  [[nodiscard]] std::uint32_t row(ShapeType type, std::uint32_t i) const {
    return static_cast<std::uint32_t>(type) + kConvexTypes * i;
  }

  std::vector<Shape> shapes;
  HullPool hulls;

 private:
  void add(const Shape& shape) { shapes.push_back(shape); }
};

template <class View>
V side_of_polyhedron(Dice& dice, const View& view, bool edge) {
  if (!edge) return unit(to_double(view.normal(dice.below(view.face_count()))));
  const HullEdge e = view.edge(dice.below(view.edge_count()));
  const V middle = to_double(view.normal(e.left)) + to_double(view.normal(e.right));
  return length(middle) > 1e-3 ? unit(middle) : to_double(view.normal(e.left));
}

/// The direction, in the shape's frame, of what is to look at the other shape: of a face or a capsule's long side, of
/// an edge or a capsule's end, or any.
inline V side(Dice& dice, const Shape& shape, const Hulls& hulls) {
  const std::uint32_t choice = dice.below(4);
  if (choice == 0 || shape.type == ShapeType::kSphere) return dice.direction();
  if (shape.type == ShapeType::kBox) return side_of_polyhedron(dice, BoxView{shape.size}, choice == 1);
  if (shape.type == ShapeType::kHull) return side_of_polyhedron(dice, HullView(hulls, shape.hull), choice == 1);
  if (choice == 1) return {0, dice.below(2) == 0 ? 1.0 : -1.0, 0};
  const double angle = dice.uniform(0, 6.28);
  return {std::cos(angle), 0, std::sin(angle)};
}

/// The shortest turn that takes one unit vector to another.
inline Quat4<double> turn_between(const V& from, const V& to) {
  const double cosine = dot(from, to);
  if (cosine < -0.999) {
    const V across = unit(std::abs(from.x) < 0.7 ? cross(from, V{1, 0, 0}) : cross(from, V{0, 1, 0}));
    return turn_between(-from, to) * Dice::turn(across, 3.14159265358979323846);
  }
  const V axis = cross(from, to);
  return normalized(Quat4<double>{axis.x, axis.y, axis.z, 1 + cosine});
}

/// How far apart the planes are between which both shapes lie, m; negative: they overlap.
inline double gap_between(Dice& dice, double reach) {
  switch (dice.below(4)) {
    case 0: return 0;
    case 1: return -dice.log_uniform(1e-7, 1e-2) * reach;
    case 2: return dice.log_uniform(1e-7, 1e-2) * reach;
    default: return -dice.uniform(0, 0.5) * reach;
  }
}

inline RandomPair facing_pair(Dice& dice, const Shape& a, const Shape& b, const Hulls& hulls) {
  RandomPair p = {a, b, {0, 0, 0, 1}, {0, 0, 0, 1}, {0, 0, 0}};
  const double reach = static_cast<double>(a.reach + b.reach);
  const bool upright = dice.below(8) == 0;
  const V up = upright || dice.below(2) == 0 ? V{0, 1, 0} : dice.direction();
  const double quarters = 1.5707963267948966 * dice.below(4);
  if (upright) {  // as built by hand, exactly
    p.qb = Dice::to_real(Dice::turn(up, quarters));
  } else {
    const auto qa = turn_between(side(dice, a, hulls), up), qb = turn_between(side(dice, b, hulls), -up);
    const double yaw[] = {dice.uniform(-3.14, 3.14), quarters, quarters + dice.log_uniform(1e-7, 1e-2)};
    p.qa = Dice::to_real(Dice::turn(up, dice.uniform(-3.14, 3.14)) * qa);
    p.qb = Dice::to_real(Dice::turn(up, yaw[dice.below(3)]) * qb);
    if (dice.below(4) == 0)  // not quite flat
      p.qb = Dice::to_real(Dice::turn(dice.direction(), dice.log_uniform(1e-7, 1e-2)) * unit(p.qb));
  }
  const Vec n = {static_cast<Real>(up.x), static_cast<Real>(up.y), static_cast<Real>(up.z)};
  const double touching = static_cast<double>(shape_extent(a, p.qa, n, hulls).high) -
                          static_cast<double>(shape_extent(b, p.qb, n, hulls).low);
  V sideways = dice.below(4) == 0 ? V{0, 0, 0} : dice.uniform(0, 0.4 * reach) * dice.direction();
  sideways = sideways - dot(sideways, up) * up;
  V d = sideways + (touching + gap_between(dice, reach)) * up;
  if (dice.below(64) == 0) d = {0, 0, 0};
  p.d = {static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z)};
  return p;
}

}  // namespace plumb::impulse::reference
