#include "referee/convex_distance.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "plumb/assert.hpp"
#include "referee/difference.hpp"

namespace plumb::referee {

namespace {

struct Simplex {
  std::array<Difference, 4> corner;
  std::array<double, 4> weight{};
  int size = 0;

  [[nodiscard]] Vec3 nearest() const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < size; ++i)
      sum += weight[static_cast<std::size_t>(i)] * corner[static_cast<std::size_t>(i)].point;
    return sum;
  }
};

// Weights of the point of the affine hull of some corners that is nearest to the origin; false when one is not above 0
// or the corners are dependent.
bool interior_weights(const std::array<Vec3, 4>& p, int count, std::array<double, 4>& weight) {
  PLUMB_ASSERT(count >= 1 && count <= 4);
  constexpr double dependent = 1e-14;
  if (count == 1) {
    weight[0] = 1;
  } else if (count == 2) {
    const Vec3 edge = p[1] - p[0];
    const double squared = edge.squaredNorm();
    if (!(squared > 0)) return false;
    weight[0] = p[1].dot(edge) / squared;
    weight[1] = -p[0].dot(edge) / squared;
  } else if (count == 3) {
    const Vec3 u = p[1] - p[0], v = p[2] - p[0], normal = u.cross(v);
    const double squared = normal.squaredNorm();
    if (!(squared > dependent * dependent * u.squaredNorm() * v.squaredNorm())) return false;
    for (std::size_t i = 0; i < 3; ++i) weight[i] = p[(i + 1) % 3].cross(p[(i + 2) % 3]).dot(normal) / squared;
  } else {
    const Vec3 u = p[1] - p[0], v = p[2] - p[0], w = p[3] - p[0];
    const double volume = u.dot(v.cross(w));
    if (!(std::abs(volume) > dependent * u.norm() * v.norm() * w.norm())) return false;
    weight[0] = p[1].dot(p[2].cross(p[3])) / volume;
    weight[1] = -p[0].dot(p[2].cross(p[3])) / volume;
    weight[2] = p[0].dot(p[1].cross(p[3])) / volume;
    weight[3] = -p[0].dot(p[1].cross(p[2])) / volume;
  }
  return std::all_of(weight.begin(), weight.begin() + count, [](double x) { return x > 0; });
}

// Keeps the smallest face of the simplex that holds its nearest point to the origin: all 15 subsets are tried, which is
// slower than Johnson's recursion and cannot go wrong.
void reduce(Simplex& simplex) {
  Simplex best;
  double nearest = infinity;
  for (unsigned subset = 1; subset < (1u << simplex.size); ++subset) {
    Simplex part;
    std::array<Vec3, 4> points;
    for (int i = 0; i < simplex.size; ++i)
      if (subset & (1u << i)) {
        points[static_cast<std::size_t>(part.size)] = simplex.corner[static_cast<std::size_t>(i)].point;
        part.corner[static_cast<std::size_t>(part.size++)] = simplex.corner[static_cast<std::size_t>(i)];
      }
    if (!interior_weights(points, part.size, part.weight)) continue;
    if (const double distance = part.nearest().squaredNorm(); distance < nearest) nearest = distance, best = part;
  }
  PLUMB_ASSERT(best.size >= 1 && best.size <= simplex.size);  // a corner alone always does
  simplex = best;
}

}  // namespace

ConvexDistance convex_distance(const ConvexView& a, const ConvexView& b) {
  const auto support = [&](const Vec3& direction) {
    const Vec3 on_a = a.support(direction), on_b = b.support(-direction);
    return Difference{on_a - on_b, on_a, on_b};
  };
  Simplex simplex;
  simplex.corner[0] = support(Vec3::UnitX());
  simplex.weight[0] = 1;
  simplex.size = 1;
  Vec3 v = simplex.corner[0].point;
  double size = v.norm();
  for (int iteration = 0; iteration < 200; ++iteration) {
    const double squared = v.squaredNorm();
    if (std::sqrt(squared) <= 1e-13 * size || simplex.size == 4) return {0, v, v};
    const Difference next = support(-v);
    size = std::max(size, next.point.norm());
    // No point of the difference is nearer than v . next / |v|; rounding of the products bounds what can be told apart.
    if (squared - v.dot(next.point) <= 1e-15 * size * std::sqrt(squared) + 1e-15 * squared) break;
    PLUMB_ASSERT(simplex.size < 4);
    Simplex grown = simplex;
    grown.corner[static_cast<std::size_t>(grown.size++)] = next;
    reduce(grown);
    if (grown.nearest().squaredNorm() >= squared) break;
    simplex = grown;
    v = simplex.nearest();
  }
  ConvexDistance result{v.norm(), Vec3::Zero(), Vec3::Zero()};
  for (int i = 0; i < simplex.size; ++i) {
    const auto at = static_cast<std::size_t>(i);
    result.on_a += simplex.weight[at] * simplex.corner[at].on_a;
    result.on_b += simplex.weight[at] * simplex.corner[at].on_b;
  }
  return result;
}

ConvexDistance segment_distance(const Vec3& p, const Vec3& d, const Vec3& q, const Vec3& e) {
  const Vec3 r = p - q;
  const double dd = d.squaredNorm(), ee = e.squaredNorm(), de = d.dot(e), dr = d.dot(r), er = e.dot(r);
  double s = 0, t = 0;
  if (dd > 0 && ee > 0) {
    const double cross = d.cross(e).squaredNorm();  // dd ee - de de, without its cancellation
    s = cross > 0 ? std::clamp((de * er - dr * ee) / cross, 0.0, 1.0) : 0;
    t = (de * s + er) / ee;
    if (t < 0 || t > 1) {
      t = std::clamp(t, 0.0, 1.0);
      s = std::clamp((de * t - dr) / dd, 0.0, 1.0);
    }
  } else if (dd > 0) {
    s = std::clamp(-dr / dd, 0.0, 1.0);
  } else if (ee > 0) {
    t = std::clamp(er / ee, 0.0, 1.0);
  }
  const Vec3 on_p = p + s * d, on_q = q + t * e;
  return {(on_p - on_q).norm(), on_p, on_q};
}

}  // namespace plumb::referee
