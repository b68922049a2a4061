// Where a simplex of up to four points comes closest to the origin, and between which of its corners.
//
// Every candidate is a convex combination of the corners and the nearest one wins, so that rounding may cost a last
// digit but never gives a point that is not the simplex's. The parts of a simplex that is flat or thin are asked in its
// stead where the whole has no volume or area to speak of; all tolerances are ratios.
#pragma once

#include <cstdint>
#include <type_traits>

#include "math/vec3.hpp"

namespace plumb::impulse {

/// Rounding of a number of this type.
template <class N>
inline constexpr N kRounding = std::is_same_v<N, float> ? N(1.1920929e-7) : N(2.220446049250313e-16);

/// Points of the Minkowski difference A - B, each with the point of A that it comes from.
template <class N>
struct Simplex {
  static constexpr int kMost = 4;
  Vec3<N> point[kMost], on_a[kMost];
  N weight[kMost];  ///< of the nearest point; set by reduce()
  int count = 0;

  PLUMB_HD void add(const Vec3<N>& p, const Vec3<N>& a) {
    point[count] = p;
    on_a[count] = a;
    ++count;
  }
  PLUMB_HD void move(const Vec3<N>& by) {
    for (int i = 0; i < count; ++i) point[i] += by;
  }
  PLUMB_HD Vec3<N> nearest_on_a() const {
    Vec3<N> sum = {0, 0, 0};
    for (int i = 0; i < count; ++i) sum += weight[i] * on_a[i];
    return sum;
  }

  /// Leaves the corners that the nearest point lies between, with their weights. False where the origin is inside of
  /// all four.
  PLUMB_HD bool reduce(Vec3<N>& nearest, N& square) {
    Candidate best;
    switch (count) {
      case 1: best.take(point[0], 1, 1, 0, 0, 0); break;
      case 2: try_edge(0, 1, best); break;
      case 3: try_triangle(0, 1, 2, best); break;
      default:
        if (!try_faces(best)) return false;
    }
    int kept = 0;
    for (int i = 0; i < count; ++i) {
      if ((best.corners >> i & 1U) == 0) continue;
      point[kept] = point[i];
      on_a[kept] = on_a[i];
      weight[kept] = best.weight[i];
      ++kept;
    }
    count = kept;
    nearest = best.at;
    square = best.square;
    return true;
  }

 private:
  struct Candidate {
    Vec3<N> at = {0, 0, 0};
    N square = -1;  ///< none yet
    N weight[kMost];
    std::uint32_t corners = 0;

    PLUMB_HD void take(const Vec3<N>& p, std::uint32_t bits, N w0, N w1, N w2, N w3) {
      const N here = dot(p, p);
      if (square >= 0 && !(here < square)) return;
      at = p;
      square = here;
      corners = bits;
      weight[0] = w0;
      weight[1] = w1;
      weight[2] = w2;
      weight[3] = w3;
    }
    /// A point of corners i, j, k with these weights; corners of weight 0 are left out.
    PLUMB_HD void take_between(const Vec3<N>& p, int i, N wi, int j, N wj, int k, N wk) {
      const auto of = [&](int c) { return (c == i ? wi : 0) + (c == j ? wj : 0) + (c == k ? wk : 0); };
      const auto bit = [](int c, N w) { return w > 0 ? 1U << c : 0U; };
      take(p, bit(i, wi) | bit(j, wj) | bit(k, wk), of(0), of(1), of(2), of(3));
    }
  };

  PLUMB_HD void try_edge(int i, int j, Candidate& best) const {
    const Vec3<N>&p = point[i], &q = point[j], e = q - p;
    const N along = -dot(p, e), whole = dot(e, e);
    if (!(along > 0)) return best.take_between(p, i, 1, j, 0, j, 0);
    if (!(along < whole)) return best.take_between(q, i, 0, j, 1, j, 0);
    const N s = along / whole;
    best.take_between(p + s * e, i, 1 - s, j, s, j, 0);
  }

  /// Whether the edge from j to k is by far the shortest of the triangle: with i as its origin both others would be
  /// long and nearly parallel, and all that tells them apart lost in rounding. Curved cores give such triangles.
  [[nodiscard]] PLUMB_HD bool is_sliver(int i, int j, int k) const {
    const Vec3<N> e = point[j] - point[i], f = point[k] - point[i], g = point[k] - point[j];
    return N(0x1p20) * dot(g, g) < min(dot(e, e), dot(f, f));
  }

  PLUMB_HD void try_triangle(int i, int j, int k, Candidate& best) const {
    if (is_sliver(i, j, k))
      try_triangle_from(j, k, i, best);
    else
      try_triangle_from(i, j, k, best);
  }
  PLUMB_HD void try_triangle_from(int i, int j, int k, Candidate& best) const {
    const Vec3<N>&p = point[i], e = point[j] - p, f = point[k] - p, n = cross(e, f);
    const N square = dot(n, n), thin = 64 * kRounding<N>;
    if (square > thin * thin * dot(e, e) * dot(f, f)) {
      const N s = -dot(cross(p, f), n) / square, r = -dot(cross(e, p), n) / square, rest = 1 - s - r;
      if (s >= 0 && r >= 0 && rest >= 0) return best.take_between(p + s * e + r * f, i, rest, j, s, k, r);
    }
    try_edge(i, j, best);
    try_edge(j, k, best);
    try_edge(k, i, best);
  }

  /// False where the origin is on the inner side of every face.
  PLUMB_HD bool try_faces(Candidate& best) const {
    bool outside = false;
    for (int d = 0; d < 4; ++d) {
      const int a = d == 0 ? 1 : 0, b = d <= 1 ? 2 : 1, c = d <= 2 ? 3 : 2;
      const Vec3<N> e = point[b] - point[a], f = point[c] - point[a], n = cross(e, f), across = point[d] - point[a];
      const N height = dot(n, across), flat = 64 * kRounding<N>;
      const N rounding = flat * flat * dot(e, e) * dot(f, f);  // of n, which is nearly 0 for a sliver
      const N of_origin = -dot(n, point[a]);
      const bool sure = height * height > rounding * dot(across, across) &&
                        of_origin * of_origin > rounding * dot(point[a], point[a]);
      if (sure && (height > 0 ? of_origin >= 0 : of_origin <= 0)) continue;
      outside = true;
      try_triangle(a, b, c, best);
    }
    return outside;
  }
};

}  // namespace plumb::impulse
