// Polyhedra in double, brute-force separating axes over all of them, and random pairs that are as hard as they come.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

#include "geometry/hull_pool.hpp"
#include "narrowphase/collide.hpp"
#include "narrowphase/convex/polyhedron.hpp"

namespace plumb::impulse::reference {

using V = Vec3<double>;

inline V to_double(const Vec& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}
inline V unit(const V& v) {
  const double n = length(v);
  return {v.x / n, v.y / n, v.z / n};
}
inline Quat4<double> unit(const Quat& q) {
  return normalized(Quat4<double>{static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z),
                                  static_cast<double>(q.w)});
}

struct Polyhedron {
  std::vector<V> vertices, normals, edges;  ///< edges: directions, each once for a box
  double size = 0;                          ///< furthest vertex from the shape's origin

  [[nodiscard]] double low(const V& n) const {
    double s = std::numeric_limits<double>::infinity();
    for (const V& v : vertices) s = std::min(s, dot(n, v));
    return s;
  }
  [[nodiscard]] double high(const V& n) const { return -low(-n); }
  /// How far a point is outside; negative inside: exact there, and a lower bound outside.
  [[nodiscard]] double outside(const V& p) const {
    double s = -std::numeric_limits<double>::infinity();
    for (const V& n : normals) s = std::max(s, dot(n, p) - high(n));
    return s;
  }
};

template <class View>
Polyhedron polyhedron(const View& view, bool box, const Quat& orientation, const Vec& origin) {
  Polyhedron p;
  const Quat4<double> q = unit(orientation);
  for (std::uint32_t v = 0; v < view.vertex_count(); ++v) {
    p.vertices.push_back(to_double(origin) + rotate(q, to_double(view.vertex(v))));
    p.size = std::max(p.size, length(to_double(view.vertex(v))));
  }
  for (std::uint32_t f = 0; f < view.face_count(); ++f) p.normals.push_back(rotate(q, to_double(view.normal(f))));
  for (std::uint32_t e = 0; e < view.edge_count(); e += box ? 4 : 1)
    p.edges.push_back(
        rotate(q, unit(to_double(view.vertex(view.edge(e).to)) - to_double(view.vertex(view.edge(e).from)))));
  return p;
}
inline Polyhedron polyhedron(const Shape& s, const Hulls& hulls, const Quat& q, const Vec& origin) {
  if (s.type == ShapeType::kBox) return polyhedron(BoxView{s.size}, true, q, origin);
  return polyhedron(HullView(hulls, s.hull), false, q, origin);
}

inline double gap(const Polyhedron& a, const Polyhedron& b, const V& n) { return b.low(n) - a.high(n); }

/// The greatest gap over the normals of all faces and the cross products of all pairs of edges, both ways round.
inline double greatest_gap(const Polyhedron& a, const Polyhedron& b) {
  double best = -std::numeric_limits<double>::infinity();
  for (const V& n : a.normals) best = std::max(best, gap(a, b, n));
  for (const V& n : b.normals) best = std::max(best, gap(a, b, -n));
  for (const V& e : a.edges)
    for (const V& f : b.edges) {
      const V n = cross(e, f);
      if (length(n) < 1e-9) continue;
      const V m = unit(n);
      best = std::max({best, gap(a, b, m), gap(a, b, -m)});
    }
  return best;
}

/// Random shapes and placements. Everything comes from the one generator, in a fixed order.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : bits_(seed) {}

  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(bits_() >> 11U) * 0x1p-53);
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(bits_() % n); }
  V direction() {
    for (;;) {
      const V v = {uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)};
      if (const double n = length(v); n > 0.1 && n < 1) return unit(v);
    }
  }
  static Quat4<double> turn(const V& axis, double angle) {
    const V v = std::sin(angle / 2) * axis;
    return {v.x, v.y, v.z, std::cos(angle / 2)};
  }
  Quat4<double> orientation() { return turn(direction(), uniform(-3.14, 3.14)); }
  static Quat to_real(const Quat4<double>& q) {
    return {static_cast<Real>(q.x), static_cast<Real>(q.y), static_cast<Real>(q.z), static_cast<Real>(q.w)};
  }

 private:
  std::mt19937_64 bits_;
};

struct RandomPair {
  Shape a, b;
  Quat qa, qb;
  Vec d;
};

/// Places B: anywhere near A, a third of the time nearly parallel to it, a third of the time nearly touching.
inline RandomPair place(Dice& dice, const Shape& a, const Shape& b, const Hulls& hulls) {
  RandomPair p = {a, b, {}, {}, {}};
  const auto qa = dice.orientation();
  auto qb = dice.orientation();
  if (dice.below(3) == 0) {  // nearly parallel, in one of the ways that a box can be turned onto itself
    qb = qa;
    const V axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int i = 0; i < 2; ++i) qb = qb * Dice::turn(axes[dice.below(3)], 1.5707963267948966 * dice.below(4));
    if (dice.below(4) != 0) qb = qb * Dice::turn(dice.direction(), dice.log_uniform(1e-8, 1e-1));
  }
  p.qa = Dice::to_real(qa);
  p.qb = Dice::to_real(qb);
  const V way = dice.below(2) == 0 ? dice.direction() : rotate(qa, V{0, 1, 0});
  const double reach = static_cast<double>(a.reach + b.reach);
  V d = dice.uniform(0, 1.1 * reach) * way;
  if (dice.below(3) == 0) {  // the gap along the direction of best separation nearly closed
    const Polyhedron at_a = polyhedron(a, hulls, p.qa, {0, 0, 0}), at_b = polyhedron(b, hulls, p.qb, {0, 0, 0});
    const double wanted = (dice.below(2) == 0 ? -1 : 1) * dice.log_uniform(1e-6, 1e-1) * reach;
    const V n = at_a.normals[dice.below(static_cast<std::uint32_t>(at_a.normals.size()))];
    const V sideways = dice.uniform(0, 0.5 * reach) * dice.direction();
    d = sideways - dot(sideways, n) * n + (wanted + at_a.high(n) - at_b.low(n)) * n;
  }
  p.d = {static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z)};
  return p;
}

inline Shape make_box(double x, double y, double z) {
  return {ShapeType::kBox,
          0,
          {static_cast<Real>(x), static_cast<Real>(y), static_cast<Real>(z)},
          static_cast<Real>(std::sqrt(x * x + y * y + z * z))};
}
/// Half extents of about `scale`; one in four is a plate or a needle of up to 1 : 1000.
inline Shape random_box(Dice& dice, double scale) {
  double h[3];
  for (double& x : h) x = scale * dice.uniform(0.3, 1);
  if (dice.below(4) == 0) h[dice.below(3)] *= dice.log_uniform(1e-3, 1);
  if (dice.below(8) == 0) h[dice.below(3)] *= dice.log_uniform(1e-3, 1);
  return make_box(h[0], h[1], h[2]);
}
/// Points about an ellipsoid, or in a box; 4 to `most` of them.
inline Shape random_hull(Dice& dice, HullPool& pool, double scale, std::uint32_t most) {
  const std::uint32_t count = 4 + dice.below(most - 3);
  const bool round = dice.below(2) == 0;
  const V half = {scale * dice.uniform(0.2, 1), scale * dice.uniform(0.2, 1), scale * dice.uniform(0.2, 1)};
  std::vector<PlumbVec3> points;
  for (std::uint32_t i = 0; i < count; ++i) {
    const V u = dice.direction();
    const V v = round ? u : V{dice.uniform(-1, 1), dice.uniform(-1, 1), dice.uniform(-1, 1)};
    points.push_back({half.x * v.x, half.y * v.y, half.z * v.z});
  }
  const std::uint32_t row = pool.add(points);
  return {ShapeType::kHull, row, {0, 0, 0}, pool.reach(row)};
}

}  // namespace plumb::impulse::reference
