// Quickhull (Barber, Dobkin, Huhdanpaa 1996) on a grid: the points are snapped to integers of 40 bits over their
// longest extent, and every question "which side of this plane?" is answered exactly in 128-bit integers (doubles
// first, where their error bound settles it). Exact answers make the cone of new faces closed and convex whatever the
// input: no tolerance decides topology. Snapping moves a point by at most 1e-12 of the extent, and only in the
// questions: the output are the points as given. Tolerances appear in two places, both relative to the extent: what is
// flat, and which triangles are one face.
#include "plumb/backend/convex_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <utility>

#include "plumb/backend/small_math.hpp"

namespace plumb::backend {

namespace {

__extension__ typedef __int128 Int128;
using Grid = std::array<std::int64_t, 3>;
inline constexpr std::uint32_t none = 0xffffffffu;

struct Triangle {
  std::array<std::uint32_t, 3> corner;
  std::array<std::uint32_t, 3> across;  // the triangle on the other side of the edge corner[i] -> corner[i + 1]
  std::vector<std::uint32_t> outside;   // points that see this triangle and wait for their turn
  bool alive = true;
};

class Builder {
 public:
  explicit Builder(std::span<const PlumbVec3> points) : points_(points) {}

  ConvexHull build() {
    snap();
    start();
    for (std::uint32_t at = 0; at < triangles_.size(); ++at)
      if (triangles_[at].alive && !triangles_[at].outside.empty()) add_furthest(at);
    return collect();
  }

 private:
  void snap() {
    const auto refuse = [](const std::string& text) { throw Error(PLUMB_E_INVALID_ARGUMENT, "convex hull: " + text); };
    if (points_.size() < 4)
      refuse(std::to_string(points_.size()) + " points; a hull needs at least 4 that are not in one plane");
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
    for (const PlumbVec3& p : points_)
      grid_.push_back({to_grid(p.x - low.x), to_grid(p.y - low.y), to_grid(p.z - low.z)});
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

  // The first tetrahedron: a triangle with a second one on its back, and the point furthest from them as the first
  // cone.
  void start() {
    const auto furthest = [this](auto&& measure) {
      std::uint32_t best = 0;
      for (std::uint32_t i = 1; i < points_.size(); ++i)
        if (measure(i) > measure(best)) best = i;
      return best;
    };
    std::uint32_t a = 0, b = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint32_t low = furthest([&](std::uint32_t i) { return -grid_[i][axis]; });
      const std::uint32_t high = furthest([&](std::uint32_t i) { return grid_[i][axis]; });
      if (grid_[high][axis] - grid_[low][axis] == std::int64_t{1} << 40) a = low, b = high;
    }
    const PlumbVec3 edge = sub(points_[b], points_[a]);
    const auto from_line = [&](std::uint32_t i) { return length(cross(edge, sub(points_[i], points_[a]))); };
    std::uint32_t c = furthest(from_line);
    if (from_line(c) <= hull_flat_tolerance * extent_ * length(edge)) refuse_flat("on one line");
    const PlumbVec3 normal = cross(edge, sub(points_[c], points_[a]));
    const std::uint32_t d = furthest([&](std::uint32_t i) { return std::abs(side(a, b, c, i)); });
    if (std::abs(dot(normal, sub(points_[d], points_[a]))) <= hull_flat_tolerance * extent_ * length(normal))
      refuse_flat("in one plane");
    if (side(a, b, c, d) > 0) std::swap(b, c);
    triangles_.push_back({{a, b, c}, {1, 1, 1}, {}});
    triangles_.push_back({{a, c, b}, {0, 0, 0}, {d}});
    cone_from_.assign(points_.size(), none);
    add_furthest(1);
    std::vector<std::uint32_t> all(points_.size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    hand_out(all, 0);
  }

  [[noreturn]] void refuse_flat(const std::string& how) const {
    throw Error(PLUMB_E_INVALID_ARGUMENT, "convex hull: all " + std::to_string(points_.size()) + " points lie " + how +
                                              " (within " + std::to_string(hull_flat_tolerance * extent_) +
                                              " m); a hull needs volume");
  }

  // Each point waits at one triangle that sees it. One that no new triangle sees is inside: if it saw an old one that
  // stays, its line of sight to the triangle that it waited at would have to enter the new hull through a new one.
  void hand_out(std::span<const std::uint32_t> waiting, std::uint32_t first) {
    for (const std::uint32_t p : waiting)
      for (std::uint32_t t = first; t < triangles_.size(); ++t)
        if (triangles_[t].alive && side(triangles_[t], p) > 0) {
          triangles_[t].outside.push_back(p);
          break;
        }
  }

  // Replaces all triangles that the furthest point waiting at `at` sees by a cone from their rim to that point.
  void add_furthest(std::uint32_t at) {
    std::uint32_t apex = none;
    double furthest = 0;
    for (const std::uint32_t p : triangles_[at].outside)
      if (const double height = side(triangles_[at], p); height > furthest) furthest = height, apex = p;

    std::vector<std::uint32_t> seen = {at}, waiting;
    std::vector<std::pair<std::uint32_t, std::size_t>> rim;  // triangle that stays, its edge
    triangles_[at].alive = false;
    for (std::size_t i = 0; i < seen.size(); ++i) {
      const Triangle& t = triangles_[seen[i]];
      waiting.insert(waiting.end(), t.outside.begin(), t.outside.end());
      for (std::size_t e = 0; e < 3; ++e) {
        Triangle& next = triangles_[t.across[e]];
        if (!next.alive) continue;
        if (side(next, apex) > 0) {
          next.alive = false;
          seen.push_back(t.across[e]);
        } else {
          for (std::size_t f = 0; f < 3; ++f)
            if (next.corner[f] == t.corner[(e + 1) % 3] && next.corner[(f + 1) % 3] == t.corner[e])
              rim.emplace_back(t.across[e], f);
        }
      }
    }
    for (const std::uint32_t t : seen) triangles_[t].outside = {};

    const auto first = static_cast<std::uint32_t>(triangles_.size());
    for (const auto& [stays, f] : rim) {
      const std::uint32_t from = triangles_[stays].corner[(f + 1) % 3], to = triangles_[stays].corner[f];
      const auto fresh = static_cast<std::uint32_t>(triangles_.size());
      triangles_[stays].across[f] = fresh;
      cone_from_[from] = fresh;
      triangles_.push_back({{from, to, apex}, {stays, none, none}, {}});
    }
    for (std::uint32_t t = first; t < triangles_.size(); ++t) {
      const std::uint32_t next = cone_from_[triangles_[t].corner[1]];
      triangles_[t].across[1] = next;
      triangles_[next].across[2] = t;
    }
    hand_out(waiting, first);
  }

  ConvexHull collect() {
    ConvexHull hull;
    hull.extent = extent_;
    std::erase_if(triangles_, [](const Triangle& t) { return !t.alive; });
    std::vector<std::uint32_t> vertex_of(points_.size(), none);
    for (const Triangle& t : triangles_)
      for (const std::uint32_t p : t.corner) vertex_of[p] = 0;
    for (std::uint32_t p = 0; p < points_.size(); ++p)
      if (vertex_of[p] != none) {
        vertex_of[p] = static_cast<std::uint32_t>(hull.vertices.size());
        hull.vertices.push_back(points_[p]);
        hull.sources.push_back(p);
      }
    for (const Triangle& t : triangles_)
      hull.triangles.push_back({vertex_of[t.corner[0]], vertex_of[t.corner[1]], vertex_of[t.corner[2]]});
    return hull;
  }

  std::span<const PlumbVec3> points_;
  std::vector<Grid> grid_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> cone_from_;  // of a rim corner: the newest triangle whose first edge starts there
  double extent_ = 0;
};

// Grows faces from the largest triangles by neighbours in their plane, always keeping each a disc.
class FaceMerger {
 public:
  explicit FaceMerger(ConvexHull& hull) : hull_(hull), face_of_(hull.triangles.size(), none) {
    for (std::uint32_t t = 0; t < hull.triangles.size(); ++t)
      for (std::size_t e = 0; e < 3; ++e) triangle_of_[key(hull.triangles[t][e], hull.triangles[t][(e + 1) % 3])] = t;
  }

  void merge() {
    std::vector<std::uint32_t> order(hull_.triangles.size());
    std::vector<double> area(order.size());
    for (std::uint32_t t = 0; t < order.size(); ++t) order[t] = t, area[t] = length(area_vector(t));
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return area[a] > area[b]; });
    std::vector<std::uint32_t> faces_at(hull_.vertices.size(), 0);
    for (const std::uint32_t seed : order)
      if (face_of_[seed] == none) {
        hull_.faces.push_back(face_of(grow(seed)));
        for (const std::uint32_t v : hull_.faces.back().loop) ++faces_at[v];
      }
    for (HullFace& face : hull_.faces)  // where only two faces meet there is an edge that runs on, not a corner
      if (std::count_if(face.loop.begin(), face.loop.end(), [&](std::uint32_t v) { return faces_at[v] >= 3; }) >= 3)
        std::erase_if(face.loop, [&](std::uint32_t v) { return faces_at[v] < 3; });
  }

 private:
  static std::uint64_t key(std::uint32_t from, std::uint32_t to) { return (std::uint64_t{from} << 32) | to; }

  [[nodiscard]] PlumbVec3 area_vector(std::uint32_t t) const {
    const auto& [a, b, c] = hull_.triangles[t];
    return cross(sub(hull_.vertices[b], hull_.vertices[a]), sub(hull_.vertices[c], hull_.vertices[a]));
  }

  std::vector<std::uint32_t> grow(std::uint32_t seed) {
    const auto face = static_cast<std::uint32_t>(hull_.faces.size());
    const PlumbVec3 area = area_vector(seed);
    const PlumbVec3 normal = scale(1 / std::max(length(area), 1e-300), area);
    const PlumbVec3 origin = hull_.vertices[hull_.triangles[seed][0]];
    const auto in_plane = [&](std::uint32_t v) {
      return std::abs(dot(normal, sub(hull_.vertices[v], origin))) <= hull_merge_tolerance * hull_.extent;
    };
    std::vector<std::uint32_t> members = {seed};
    std::vector<bool> corner_used(hull_.vertices.size(), false);
    for (const std::uint32_t v : hull_.triangles[seed]) corner_used[v] = true;
    face_of_[seed] = face;
    for (bool grew = true; grew;) {  // again while one was taken: it may have made room for one that was passed over
      grew = false;
      for (std::size_t i = 0; i < members.size(); ++i)
        for (std::size_t e = 0; e < 3; ++e) {
          const auto& corners = hull_.triangles[members[i]];
          const std::uint32_t t = triangle_of_.at(key(corners[(e + 1) % 3], corners[e]));
          if (face_of_[t] != none || !std::all_of(hull_.triangles[t].begin(), hull_.triangles[t].end(), in_plane) ||
              !keeps_disc(t, face, corner_used))
            continue;
          face_of_[t] = face;
          members.push_back(t);
          for (const std::uint32_t v : hull_.triangles[t]) corner_used[v] = true;
          grew = true;
        }
    }
    return members;
  }

  // A triangle may join along two edges, or along one when its third corner is new to the face.
  bool keeps_disc(std::uint32_t t, std::uint32_t face, const std::vector<bool>& corner_used) const {
    std::size_t shared = 0;
    std::uint32_t opposite = none;
    for (std::size_t e = 0; e < 3; ++e) {
      const auto& c = hull_.triangles[t];
      if (face_of_[triangle_of_.at(key(c[(e + 1) % 3], c[e]))] == face) {
        ++shared;
        opposite = c[(e + 2) % 3];
      }
    }
    return shared == 2 || (shared == 1 && !corner_used[opposite]);
  }

  HullFace face_of(const std::vector<std::uint32_t>& members) const {
    std::map<std::uint32_t, std::uint32_t> next;  // of the rim, so that a loop starts at its lowest corner
    PlumbVec3 area{0, 0, 0};
    for (const std::uint32_t t : members) {
      area = add(area, area_vector(t));
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t from = hull_.triangles[t][e], to = hull_.triangles[t][(e + 1) % 3];
        if (face_of_[triangle_of_.at(key(to, from))] != face_of_[t]) next[from] = to;
      }
    }
    HullFace face{{}, scale(1 / std::max(length(area), 1e-300), area), -std::numeric_limits<double>::infinity()};
    const std::uint32_t start = next.begin()->first;
    for (std::uint32_t v = start; face.loop.empty() || v != start; v = next.at(v)) face.loop.push_back(v);
    for (const std::uint32_t t : members)
      for (const std::uint32_t v : hull_.triangles[t])
        face.offset = std::max(face.offset, dot(face.normal, hull_.vertices[v]));
    return face;
  }

  ConvexHull& hull_;
  std::vector<std::uint32_t> face_of_;
  std::unordered_map<std::uint64_t, std::uint32_t> triangle_of_;  // by directed edge
};

}  // namespace

ConvexHull convex_hull(std::span<const PlumbVec3> points) {
  ConvexHull hull = Builder(points).build();
  FaceMerger(hull).merge();
  return hull;
}

ConvexHull convex_hull(const PlumbShapeDesc& desc) {
  std::vector<PlumbVec3> points;
  for (std::size_t i = 0; i < desc.vertex_count; ++i)
    points.push_back({desc.vertices[3 * i], desc.vertices[3 * i + 1], desc.vertices[3 * i + 2]});
  return convex_hull(points);
}

}  // namespace plumb::backend
