// A hull in bytes.
#include "geometry/cooked_bytes.hpp"
#include "geometry/hull_pool.hpp"

namespace plumb::impulse {

namespace {

/// Of numbers alone, without padding.
struct HullCounts {
  std::uint32_t vertices, faces, loops, edges;
};

bool is_in_bounds(const HullRows& hull) {
  bool sound = is_in_range(hull.centre) && is_finite(hull.inner_radius) && hull.vertices.size() >= 4;
  for (const Vec& vertex : hull.vertices) sound = sound && is_in_range(vertex);
  for (const std::uint32_t vertex : hull.loops) sound = sound && vertex < hull.vertices.size();
  for (const HullFace& face : hull.faces)
    sound = sound && is_in_range(face.normal) && is_finite(face.offset) && face.count >= 3 &&
            face.count <= hull.loops.size() && face.first <= hull.loops.size() - face.count;
  for (const HullEdge& edge : hull.edges)
    sound = sound && edge.from < hull.vertices.size() && edge.to < hull.vertices.size() &&
            edge.left < hull.faces.size() && edge.right < hull.faces.size();
  return sound && hull.faces.size() >= 4 && hull.edges.size() >= 6;
}

}  // namespace

void HullRows::cook(backend::CookedWriter& bytes) const {
  const auto size = [](const auto& rows) { return static_cast<std::uint32_t>(rows.size()); };
  bytes.value(HullCounts{size(vertices), size(faces), size(loops), size(edges)});
  bytes.value(centre);
  bytes.value(inner_radius);
  bytes.items(vertices.data(), vertices.size());
  bytes.items(faces.data(), faces.size());
  bytes.items(loops.data(), loops.size());
  bytes.items(edges.data(), edges.size());
}

HullRows::HullRows(backend::CookedReader& bytes) {
  const auto counts = bytes.value<HullCounts>();
  centre = bytes.value<Vec>();
  inner_radius = bytes.value<Real>();
  vertices = bytes.list<Vec>(counts.vertices);
  faces = bytes.list<HullFace>(counts.faces);
  loops = bytes.list<std::uint32_t>(counts.loops);
  edges = bytes.list<HullEdge>(counts.edges);
  bytes.finish();
  if (!is_in_bounds(*this)) backend::CookedReader::corrupt("is of no hull");
}

}  // namespace plumb::impulse
