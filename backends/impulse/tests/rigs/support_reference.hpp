// Any convex shape by its support function in double, and the greatest gap between two by search over all directions.
#pragma once

#include <algorithm>
#include <vector>

#include "tests/rigs/narrow_reference.hpp"

namespace plumb::impulse::reference {

/// A convex shape where it lies.
struct Solid {
  Shape shape;
  const Hulls* hulls;
  Quat4<double> turn;
  V at;

  /// The furthest of dot(n, p) over the shape, for a unit vector n.
  [[nodiscard]] double high(const V& n) const {
    const V local = rotate_back(turn, n), size = to_double(shape.size);
    double most = 0;
    switch (shape.type) {
      case ShapeType::kSphere: most = size.x; break;
      case ShapeType::kBox:
        most = std::abs(local.x) * size.x + std::abs(local.y) * size.y + std::abs(local.z) * size.z;
        break;
      case ShapeType::kCapsule: most = size.x + std::abs(local.y) * size.y; break;
      case ShapeType::kCylinder: most = std::abs(local.y) * size.y + std::hypot(local.x, local.z) * size.x; break;
      default: {
        const HullView view(*hulls, shape.hull);
        most = -1e300;
        for (std::uint32_t v = 0; v < view.vertex_count(); ++v)
          most = std::max(most, dot(local, to_double(view.vertex(v))));
      }
    }
    return dot(n, at) + most;
  }
};

/// Of B beyond A along n.
inline double gap(const Solid& a, const Solid& b, const V& n) { return -b.high(-n) - a.high(n); }

/// What function of a direction is greatest: a grid over the sphere, then smaller and smaller steps from the best few
/// of it. A lower bound, and nearly always close.
template <class F>
double greatest_over_directions(const F& f, Dice& dice, int directions = 400) {
  struct Found {
    V n;
    double value;
  };
  std::vector<Found> found;
  for (int i = 0; i < directions; ++i) {
    const V n = dice.direction();
    found.push_back({n, f(n)});
  }
  for (const V n : {V{1, 0, 0}, V{0, 1, 0}, V{0, 0, 1}, V{-1, 0, 0}, V{0, -1, 0}, V{0, 0, -1}})
    found.push_back({n, f(n)});
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) { return a.value > b.value; });
  double best = -1e300;
  for (std::size_t k = 0; k < 4; ++k) {
    Found now = found[k];
    for (double step = 0.2; step > 1e-7;) {
      bool better = false;
      for (int trial = 0; trial < 12 && !better; ++trial) {
        const V n = unit(now.n + step * dice.direction());
        if (const double value = f(n); value > now.value) {
          now = {n, value};
          better = true;
        }
      }
      if (!better) step *= 0.6;
    }
    best = std::max(best, now.value);
  }
  return best;
}

}  // namespace plumb::impulse::reference
