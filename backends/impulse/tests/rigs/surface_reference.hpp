// Triangles in the world one by one in double: what a ray meets, and how far a convex shape is from them. Shares
// nothing with the engine.
#pragma once

#include <algorithm>
#include <array>
#include <limits>

#include "tests/rigs/convex_reference.hpp"
#include "tests/rigs/shape_scenes.hpp"

namespace plumb::impulse::reference {

using Corners = std::array<V, 3>;

/// Of the mesh, at the pose.
inline std::vector<Corners> triangles_of(const test::TriangleSet& set, const PlumbPose& pose) {
  const Quat4<double> q =
      normalized(Quat4<double>{pose.orientation.x, pose.orientation.y, pose.orientation.z, pose.orientation.w});
  const V at = {pose.position.x, pose.position.y, pose.position.z};
  std::vector<Corners> all;
  for (std::size_t i = 0; i < set.indices.size(); i += 3) {
    Corners c;
    for (std::size_t k = 0; k < 3; ++k) {
      const double* v = &set.vertices[std::size_t{3} * set.indices[i + k]];
      c[k] = at + rotate(q, V{v[0], v[1], v[2]});
    }
    all.push_back(c);
  }
  return all;
}

/// A height field as triangles, in the order of the engine's numbers.
inline test::TriangleSet triangles_of_field(const PlumbShapeDesc& desc) {
  test::TriangleSet set;
  for (std::uint32_t r = 0; r < desc.rows; ++r)
    for (std::uint32_t c = 0; c < desc.columns; ++c)
      set.add((c - (desc.columns - 1) / 2.0) * desc.spacing.x, desc.heights[r * desc.columns + c],
              (r - (desc.rows - 1) / 2.0) * desc.spacing.z);
  for (std::uint32_t r = 0; r + 1 < desc.rows; ++r)
    for (std::uint32_t c = 0; c + 1 < desc.columns; ++c) {
      const std::uint32_t i = r * desc.columns + c;
      set.triangle(i, i + desc.columns, i + 1);
      set.triangle(i + 1, i + desc.columns, i + desc.columns + 1);
    }
  return set;
}

/// Place along p + s d where it passes the triangle, which is grown by that share of its size; infinite where it does
/// not (Moeller and Trumbore, "Fast, minimum storage ray-triangle intersection", 1997).
inline double passes(const Corners& c, const V& p, const V& d, double grown) {
  const V e = c[1] - c[0], f = c[2] - c[0], h = cross(d, f);
  const double det = dot(e, h), none = std::numeric_limits<double>::infinity();
  if (std::abs(det) <= 1e-14 * length(e) * length(f)) return none;
  const V s = p - c[0], q = cross(s, e);
  const double u = dot(s, h) / det, v = dot(d, q) / det;
  if (u < -grown || v < -grown || u + v > 1 + grown) return none;
  return dot(f, q) / det;
}

/// The triangle as a flat solid: both of its faces, and sides, whose loops run the wrong way so that nothing is over
/// them.
inline Features features_of(const Corners& c) {
  Features out;
  out.vertices = {c[0], c[1], c[2]};
  const V n = unit(cross(c[1] - c[0], c[2] - c[0]));
  out.faces = {{n, {c[0], c[1], c[2]}}, {-n, {c[0], c[2], c[1]}}};
  for (std::size_t k = 0; k < 3; ++k) {
    const V &from = c[k], &to = c[(k + 1) % 3];
    out.edges.emplace_back(from, to);
    out.faces.push_back({unit(cross(to - from, n)), {from, from + n, to + n, to}});
  }
  return out;
}

/// A cylinder about the y axis where it lies.
struct PlacedCylinder {
  double radius, half;
  Quat4<double> turn;
  V at;

  [[nodiscard]] double distance_to(const V& place) const {
    const V p = rotate_back(turn, place - at);
    return std::hypot(std::max(std::hypot(p.x, p.z) - radius, 0.0), std::max(std::abs(p.y) - half, 0.0));
  }
  /// The furthest of dot(n, p).
  [[nodiscard]] double high(const V& n) const {
    const V local = rotate_back(turn, n);
    return dot(n, at) + half * std::abs(local.y) + radius * std::hypot(local.x, local.z);
  }
};

/// The least of a convex function of 0 to 1.
template <class F>
double least_between(const F& f) {
  constexpr double kGolden = 0.61803398874989485;
  double low = 0, high = 1, s = 1 - kGolden, r = kGolden, at_s = f(s), at_r = f(r);
  for (int i = 0; i < 50; ++i) {
    if (at_s < at_r) {
      high = r;
      r = s;
      at_r = at_s;
      s = high - kGolden * (high - low);
      at_s = f(s);
    } else {
      low = s;
      s = r;
      at_s = at_r;
      r = low + kGolden * (high - low);
      at_r = f(r);
    }
  }
  return std::min(std::min(f(0), f(1)), std::min(at_s, at_r));
}
/// The distance to a convex shape is a convex function over the triangle.
inline double distance(const Corners& c, const PlacedCylinder& cylinder) {
  return least_between([&](double u) {
    const V from = c[0] + u * (c[1] - c[0]), to = c[0] + u * (c[2] - c[0]);
    return least_between([&](double v) { return cylinder.distance_to(from + v * (to - from)); });
  });
}

inline V middle_of(const Corners& c) { return (1.0 / 3) * (c[0] + c[1] + c[2]); }
inline double reach_of(const Corners& c) {
  const V m = middle_of(c);
  return std::max(length(c[0] - m), std::max(length(c[1] - m), length(c[2] - m)));
}

}  // namespace plumb::impulse::reference
