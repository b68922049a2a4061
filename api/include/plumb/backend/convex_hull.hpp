// The convex hull of points in space: triangles for integration, merged planar polygons for engines that want faces.
//
// Quickhull (Barber, Dobkin, Huhdanpaa 1996) on a grid: the points are snapped to integers of 40 bits over their
// longest extent, and every question "which side of this plane?" is answered exactly in 128-bit integers (doubles first,
// where their error bound settles it). Exact answers make the cone of new faces closed and convex whatever the input: no
// tolerance decides topology. Snapping moves a point by at most 1e-12 of the extent, and only in the questions: the
// output are the points as given. Tolerances appear in two places, both relative to the extent: what is flat, and which
// triangles are one face.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "plumb/backend/small_math.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::backend {

/// A planar face: its corners counter-clockwise seen from outside, at least 3.
struct HullFace {
  std::vector<std::uint32_t> loop;  ///< into ConvexHull::vertices
  PlumbVec3 normal;                 ///< unit, outward
  double offset;                    ///< m; every corner p has dot(normal, p) <= offset, one of them equals it
};

struct ConvexHull {
  std::vector<PlumbVec3> vertices;                       ///< corners of triangles: a subset of the points, in their order
  std::vector<std::uint32_t> sources;                    ///< index among the points of each vertex
  std::vector<std::array<std::uint32_t, 3>> triangles;   ///< a closed surface, counter-clockwise seen from outside
  /// The same surface with triangles merged that lie in one plane within merge_tolerance. A vertex that is no corner of
  /// any merged face (it lies inside a face or on a straight edge) is in no loop.
  std::vector<HullFace> faces;
  double extent;                                         ///< m: longest side of the points' bounding box
};

/// Of the extent: points within it of one plane are flat, and not a hull.
inline constexpr double hull_flat_tolerance = 1e-6;
/// Of the extent: triangles whose corners lie within it of a common plane are one face. Points that were rounded to
/// float32 still give whole faces.
inline constexpr double hull_merge_tolerance = 1e-6;

namespace hull_detail {

__extension__ typedef __int128 Int128;
using Grid = std::array<std::int64_t, 3>;
inline constexpr std::uint32_t none = 0xffffffffu;

struct Triangle {
  std::array<std::uint32_t, 3> corner;
  std::array<std::uint32_t, 3> across;  // the triangle on the other side of the edge corner[i] -> corner[i + 1]
  std::vector<std::uint32_t> outside;   // points that see this triangle and wait for their turn
  bool alive = true;
  bool visible = false;
};

class Builder {
 public:
  explicit Builder(std::span<const PlumbVec3> points) : points_(points) {}

  ConvexHull build() {
    snap();
    start();
    for (std::uint32_t at = 0; at < triangles_.size(); ++at)
      while (triangles_[at].alive && !triangles_[at].outside.empty()) add_furthest(at);
    ConvexHull hull = collect();
    merge_faces(hull);
    return hull;
  }

 private:
  void snap() {
    const auto refuse = [](const std::string& text) { throw Error(PLUMB_E_INVALID_ARGUMENT, "convex hull: " + text); };
    if (points_.size() < 4) refuse(std::to_string(points_.size()) + " points; a hull needs at least 4 that are not in one plane");
    PlumbVec3 low = points_[0], high = points_[0];
    for (const PlumbVec3& p : points_) {
      if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
        refuse("point " + std::to_string(&p - points_.data()) + " is not finite");
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    extent_ = std::max({high.x - low.x, high.y - low.y, high.z - low.z});
    if (!(extent_ > 0) || !std::isfinite(extent_)) refuse("all " + std::to_string(points_.size()) + " points coincide");
    const auto to_grid = [this](double d) { return static_cast<std::int64_t>(std::llround(d / extent_ * 0x1p40)); };
    for (const PlumbVec3& p : points_) grid_.push_back({to_grid(p.x - low.x), to_grid(p.y - low.y), to_grid(p.z - low.z)});
  }

  // Six times the signed volume of a, b, c, p in grid units, rounded: above 0 when p is on the side from which a, b, c
  // turn counter-clockwise. The sign is exact. |result| <= 3 sqrt(3) 2^120, so 128 bits never overflow.
  [[nodiscard]] double side(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t p) const {
    std::array<std::int64_t, 3> u, v, w;
    for (std::size_t i = 0; i < 3; ++i) {
      u[i] = grid_[b][i] - grid_[a][i];
      v[i] = grid_[c][i] - grid_[a][i];
      w[i] = grid_[p][i] - grid_[a][i];
    }
    double det = 0, magnitude = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      const double first = static_cast<double>(u[j]) * static_cast<double>(v[k]);
      const double second = static_cast<double>(u[k]) * static_cast<double>(v[j]);
      det += (first - second) * static_cast<double>(w[i]);
      magnitude += (std::abs(first) + std::abs(second)) * std::abs(static_cast<double>(w[i]));
    }
    if (std::abs(det) > 8 * 0x1p-52 * magnitude) return det;  // 7 roundings at most on the way to each term and the sum
    Int128 exact = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      exact += (static_cast<Int128>(u[j]) * v[k] - static_cast<Int128>(u[k]) * v[j]) * w[i];
    }
    return static_cast<double>(exact);
  }
  [[nodiscard]] double side(const Triangle& t, std::uint32_t p) const {
    return side(t.corner[0], t.corner[1], t.corner[2], p);
  }

  // The first tetrahedron: the two points furthest apart along an axis, the one furthest from their line, the one
  // furthest from that plane.
  void start() {
    const auto furthest = [this](auto&& measure) {
      std::uint32_t best = 0;
      double largest = -1;
      for (std::uint32_t i = 0; i < points_.size(); ++i)
        if (const double value = measure(i); value > largest) largest = value, best = i;
      return std::pair{best, largest};
    };
    const auto along = [this](std::size_t axis, double sign) {
      return [this, axis, sign](std::uint32_t i) { return sign * static_cast<double>(grid_[i][axis]) + 0x1p41; };
    };
    std::uint32_t a = 0, b = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t low = furthest(along(axis, -1)).first, high = furthest(along(axis, 1)).first;
      if (grid_[high][axis] - grid_[low][axis] > std::abs(grid_[b][0] - grid_[a][0]) && grid_[high][axis] - grid_[low][axis] >= (std::int64_t{1} << 39)) a = low, b = high;
    }
    const auto from_line = [&](std::uint32_t i) { return length(cross(sub(points_[b], points_[a]), sub(points_[i], points_[a]))); };
    auto [c, area] = furthest(from_line);
    const double edge = length(sub(points_[b], points_[a]));
    if (area <= hull_flat_tolerance * extent_ * edge) refuse_flat("line");
    const auto from_plane = [&, c = c](std::uint32_t i) { return std::abs(side(a, b, c, i)); };
    const std::uint32_t d = furthest(from_plane).first;
    const PlumbVec3 normal = cross(sub(points_[b], points_[a]), sub(points_[c], points_[a]));
    if (std::abs(dot(normal, sub(points_[d], points_[a]))) <= hull_flat_tolerance * extent_ * area || side(a, b, c, d) == 0)
      refuse_flat("plane");
    if (side(a, b, c, d) > 0) std::swap(b, c);
    triangles_ = {{{a, b, c}, {3, 2, 1}, {}}, {{c, b, d}, {0, 3, 2}, {}}, {{a, c, d}, {0, 1, 3}, {}}, {{b, a, d}, {0, 2, 1}, {}}};
    link_first();
    std::vector<std::uint32_t> all(points_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    hand_out(all, 0);
  }

  std::span<const PlumbVec3> points_;
  std::vector<Grid> grid_;
  std::vector<Triangle> triangles_;
  double extent_ = 0;
};

}  // namespace hull_detail
}  // namespace plumb::backend
