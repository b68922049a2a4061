#include "geometry/mesh_topology.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "geometry/key_order.hpp"
#include "geometry/tolerance.hpp"

namespace plumb::impulse {

namespace {

/// One triangle's side of an edge.
struct Side {
  std::uint32_t low, high;  ///< corners
  std::uint32_t triangle, k;
  [[nodiscard]] std::uint64_t edge() const { return static_cast<std::uint64_t>(low) << 32 | high; }
};

/// Whether the corners span a plane at all: of those that lie in a line nearly, the normal would be rounding.
bool has_area(const Vec& a, const Vec& b, const Vec& c) {
  const Vec u = b - a, v = c - a, w = c - b;
  const Real longest = max(length_squared(u), max(length_squared(v), length_squared(w)));
  return length(cross(u, v)) > kParallel * longest;
}

/// The same for vertices at the same place, and of others hardly ever (finished as SplitMix64 does; Steele, Lea and
/// Flood 2014).
std::uint64_t place_key(const PlumbVec3& v) {
  std::uint64_t key = 0;
  for (const double x : {v.x, v.y, v.z}) {
    const double positive = x + 0.0;  // 0 is -0
    std::uint64_t bits = 0;
    std::memcpy(&bits, &positive, sizeof bits);
    key = (key ^ bits) * 0xbf58476d1ce4e5b9U;
    key = (key ^ key >> 27) * 0x94d049bb133111ebU;
    key ^= key >> 31;
  }
  return key;
}

/// For each vertex the first one at its place.
std::vector<std::uint32_t> first_at_place(Executor& executor, std::span<const PlumbVec3> vertices) {
  std::vector<std::uint64_t> keys(vertices.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) keys[v] = place_key(vertices[v]);
  const std::vector<std::uint32_t> order = order_by_key(executor, keys);
  std::vector<std::uint32_t> first(vertices.size()), places;
  for (std::size_t i = 0; i < order.size(); ++i) {
    if (i == 0 || keys[order[i]] != keys[order[i - 1]]) places.clear();
    const auto same = [&](std::uint32_t v) { return same_place(vertices[v], vertices[order[i]]); };
    const auto found = std::find_if(places.begin(), places.end(), same);
    first[order[i]] = found == places.end() ? order[i] : *found;
    if (found == places.end()) places.push_back(order[i]);
  }
  return first;
}

/// For each vertex the number of its place, by the order of their first vertices.
std::vector<std::uint32_t> number_corners(Executor& executor, std::span<const PlumbVec3> vertices) {
  const std::vector<std::uint32_t> first = first_at_place(executor, vertices);
  std::vector<std::uint32_t> corner_of(vertices.size());
  std::uint32_t corners = 0;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) corner_of[i] = first[i] == i ? corners++ : corner_of[first[i]];
  return corner_of;
}

}  // namespace

MeshPlaces place_corners(std::span<const PlumbVec3> vertices, std::span<const std::uint32_t> corner_of) {
  PlumbVec3 low = vertices[0], high = vertices[0];
  for (const PlumbVec3& v : vertices) {
    low = {std::min(low.x, v.x), std::min(low.y, v.y), std::min(low.z, v.z)};
    high = {std::max(high.x, v.x), std::max(high.y, v.y), std::max(high.z, v.z)};
  }
  MeshPlaces places = {
      {0.5 * (low.x + high.x), 0.5 * (low.y + high.y), 0.5 * (low.z + high.z)}, {0, 0, 0}, 0, {}, true};
  std::vector<std::uint32_t> first;
  for (std::uint32_t i = 0; i < vertices.size(); ++i) {
    const PlumbVec3& v = vertices[i];
    if (corner_of[i] != first.size()) {
      places.joined = places.joined && same_place(v, vertices[first[corner_of[i]]]);
      continue;
    }
    first.push_back(i);
    const Vec at = {static_cast<Real>(v.x - places.centre.x), static_cast<Real>(v.y - places.centre.y),
                    static_cast<Real>(v.z - places.centre.z)};
    places.corners.push_back(at);
    places.half = max(places.half, abs(at));
    places.reach = max(places.reach, length(at));
  }
  return places;
}

Box box_of(const MeshTriangle& triangle, const Vec* corners) {
  const Vec &a = corners[triangle.corner[0]], &b = corners[triangle.corner[1]], &c = corners[triangle.corner[2]];
  return has_area(a, b, c) ? Box{min(a, min(b, c)), max(a, max(b, c))} : empty_box();
}

MeshTopology::MeshTopology(Executor& executor, std::span<const PlumbVec3> vertices,
                           std::span<const std::uint32_t> indices)
    : corner_of(number_corners(executor, vertices)), places(place_corners(vertices, corner_of)) {
  triangles.resize(indices.size() / 3);
  boxes.resize(triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    MeshTriangle& triangle = triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      triangle.corner[k] = corner_of[indices[3 * t + k]];
      triangle.across[k] = kNoCorner;
    }
    boxes[t] = box_of(triangle, places.corners.data());
  }
  find_neighbours(executor);
}

void MeshTopology::find_neighbours(Executor& executor) {
  std::vector<Side> unsorted;
  std::vector<std::uint64_t> keys;
  unsorted.reserve(3 * triangles.size());
  keys.reserve(3 * triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (boxes[t].low.x > boxes[t].high.x) continue;
    for (std::uint32_t k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[t].corner[k], b = triangles[t].corner[(k + 1) % 3];
      unsorted.push_back({std::min(a, b), std::max(a, b), t, k});
      keys.push_back(unsorted.back().edge());
    }
  }
  std::vector<Side> sides(unsorted.size());
  const std::vector<std::uint32_t> order = order_by_key(executor, keys);
  for (std::size_t i = 0; i < order.size(); ++i) sides[i] = unsorted[order[i]];
  closed = true;
  first_neighbour.assign(places.corners.size() + 1, 0);
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].edge() == sides[i].edge()) ++end;
    closed = closed && end > i + 1;
    for (std::size_t j = i; j < end && end > i + 1; ++j) {
      const Side &side = sides[j], &other = sides[j + 1 < end ? j + 1 : i];
      triangles[side.triangle].across[side.k] = triangles[other.triangle].corner[(other.k + 2) % 3];
    }
    ++first_neighbour[sides[i].low + 1];
    ++first_neighbour[sides[i].high + 1];
    sides[i].k = 3;  // the edge's first
    i = end;
  }
  std::partial_sum(first_neighbour.begin(), first_neighbour.end(), first_neighbour.begin());
  neighbours.resize(first_neighbour.back());
  std::vector<std::uint32_t> next(first_neighbour.begin(), first_neighbour.end() - 1);
  for (const Side& side : sides) {
    if (side.k != 3) continue;
    neighbours[next[side.low]++] = side.high;
    neighbours[next[side.high]++] = side.low;
  }
}

}  // namespace plumb::impulse
