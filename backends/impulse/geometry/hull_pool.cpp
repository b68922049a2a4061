#include "geometry/hull_pool.hpp"

#include <algorithm>
#include <map>

#include "plumb/assert.hpp"
#include "plumb/backend/convex_hull.hpp"
#include "plumb/backend/small_math.hpp"

namespace plumb::impulse {

namespace {

using backend::ConvexHull;
constexpr std::uint32_t kNoVertex = 0xffffffffU;

Vec to_real(const PlumbVec3& p) { return {static_cast<Real>(p.x), static_cast<Real>(p.y), static_cast<Real>(p.z)}; }

/// Numbers the vertices that are corners of faces; the others lie within faces.
std::vector<std::uint32_t> number_corners(const ConvexHull& hull, std::uint32_t& count) {
  std::vector<std::uint32_t> number(hull.vertices.size(), kNoVertex);
  for (const backend::HullFace& face : hull.faces)
    for (const std::uint32_t v : face.loop) number[v] = 0;
  count = 0;
  for (std::uint32_t& n : number)
    if (n != kNoVertex) n = count++;
  return number;
}

/// The face other than `not_this` whose plane the edge's middle is closest to.
std::uint32_t face_across(const ConvexHull& hull, std::uint32_t from, std::uint32_t to, std::uint32_t not_this) {
  const PlumbVec3 middle = backend::scale(0.5, backend::add(hull.vertices[from], hull.vertices[to]));
  std::uint32_t best = not_this;
  double closest = 0;
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    const double distance = hull.faces[f].offset - backend::dot(hull.faces[f].normal, middle);
    if (f != not_this && (best == not_this || distance < closest)) {
      best = f;
      closest = distance;
    }
  }
  return best;
}

/// Every side of a loop meets the same side of the neighbour's loop the other way round, except where merging left a
/// corner in one loop only; such a side is an edge of its own.
std::vector<HullEdge> edges_of(const ConvexHull& hull) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> face_of;  // by directed side
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    const auto& loop = hull.faces[f].loop;
    for (std::size_t k = 0; k < loop.size(); ++k) face_of[{loop[k], loop[(k + 1) % loop.size()]}] = f;
  }
  std::vector<HullEdge> edges;
  for (const auto& [side, left] : face_of) {
    const auto [from, to] = side;
    const auto across = face_of.find({to, from});
    if (across == face_of.end())
      edges.push_back({from, to, left, face_across(hull, from, to, left)});
    else if (from < to)
      edges.push_back({from, to, left, across->second});
  }
  return edges;
}

template <class T>
void make_room(Mirror<T>& array, std::size_t count) {
  if (count > array.size()) array.grow(std::max<std::size_t>(count, 2 * array.size()));
}

}  // namespace

HullRows::HullRows(std::span<const PlumbVec3> points) {
  const ConvexHull hull = backend::convex_hull(points);
  std::uint32_t corners = 0;
  const std::vector<std::uint32_t> number = number_corners(hull, corners);
  PlumbVec3 sum{0, 0, 0};
  vertices.reserve(corners);
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] != kNoVertex) {
      vertices.push_back(to_real(hull.vertices[v]));
      sum = backend::add(sum, hull.vertices[v]);
    }
  centre = to_real(backend::scale(1.0 / corners, sum));
  inner_radius = kHuge;
  for (const backend::HullFace& given : hull.faces) {
    HullFace face = {to_real(given.normal), -kHuge, static_cast<std::uint32_t>(loops.size()),
                     static_cast<std::uint32_t>(given.loop.size())};
    for (const std::uint32_t v : given.loop) {
      loops.push_back(number[v]);
      face.offset = max(face.offset, dot(face.normal, vertices[number[v]]));
    }
    faces.push_back(face);
    inner_radius = min(inner_radius, face.offset - dot(face.normal, centre));
  }
  for (const HullEdge& edge : edges_of(hull))
    edges.push_back({number[edge.from], number[edge.to], edge.left, edge.right});
}

std::uint32_t HullPool::add(const HullRows& hull) {
  const auto size = [](const auto& rows) { return static_cast<std::uint32_t>(rows.size()); };
  const std::uint32_t row = find_room({size(hull.vertices), size(hull.faces), size(hull.loops), size(hull.edges)});
  HullRange& range = ranges_[row];
  range.vertex_count = size(hull.vertices);
  range.face_count = size(hull.faces);
  range.edge_count = size(hull.edges);
  range.centre = hull.centre;
  range.inner_radius = hull.inner_radius;
  std::copy(hull.vertices.begin(), hull.vertices.end(), vertices_.host() + range.first_vertex);
  std::copy(hull.faces.begin(), hull.faces.end(), faces_.host() + range.first_face);
  std::copy(hull.loops.begin(), hull.loops.end(), loops_.host() + range.first_loop);
  std::copy(hull.edges.begin(), hull.edges.end(), edges_.host() + range.first_edge);
  changed_ = true;
  return row;
}

/// A removed hull's room where one is large enough, else new room behind all.
std::uint32_t HullPool::find_room(const Room& need) {
  const auto fits = [&](std::uint32_t row) {
    const Room& room = rooms_[row];
    return room.vertices >= need.vertices && room.faces >= need.faces && room.loops >= need.loops &&
           room.edges >= need.edges;
  };
  if (const auto found = std::find_if(empty_.begin(), empty_.end(), fits); found != empty_.end()) {
    const std::uint32_t row = *found;
    empty_.erase(found);
    return row;
  }
  const std::uint32_t row = row_count_++;
  make_room(ranges_, row_count_);
  make_room(vertices_, vertex_count_ + need.vertices);
  make_room(faces_, face_count_ + need.faces);
  make_room(loops_, loop_count_ + need.loops);
  make_room(edges_, edge_count_ + need.edges);
  ranges_[row] = {vertex_count_, 0, face_count_, 0, loop_count_, edge_count_, 0, {0, 0, 0}, 0};
  vertex_count_ += need.vertices;
  face_count_ += need.faces;
  loop_count_ += need.loops;
  edge_count_ += need.edges;
  rooms_.push_back(need);
  return row;
}

void HullPool::remove(std::uint32_t row) {
  PLUMB_ASSERT(row < row_count_);
  PLUMB_ASSERT(std::find(empty_.begin(), empty_.end(), row) == empty_.end());
  empty_.push_back(row);
}

Real HullPool::reach(std::uint32_t row) const {
  PLUMB_ASSERT(row < row_count_);
  const HullRange& range = ranges_[row];
  Real most = 0;
  for (std::uint32_t v = 0; v < range.vertex_count; ++v) most = max(most, length(vertices_[range.first_vertex + v]));
  return most;
}

}  // namespace plumb::impulse
