// Shapes of many parts for tests: compounds, triangulated planes and cubes, height fields.
#pragma once

#include <functional>
#include <utility>
#include <vector>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {

inline PlumbShape make_compound(Scene& scene, const std::vector<PlumbCompoundChild>& children) {
  PlumbShapeDesc desc = shape_desc(PLUMB_COMPOUND);
  desc.children = children.data();
  desc.child_count = static_cast<std::uint32_t>(children.size());
  return scene.make(desc);
}
inline PlumbCompoundChild child(PlumbShape shape, const PlumbVec3& position = {0, 0, 0}) {
  return {shape, {position, {0, 0, 0, 1}}, 0, 0, {}};
}

/// Vertices and triangles.
struct TriangleSet {
  std::vector<double> vertices;
  std::vector<std::uint32_t> indices;

  std::uint32_t add(double x, double y, double z) {
    vertices.insert(vertices.end(), {x, y, z});
    return static_cast<std::uint32_t>(vertices.size() / 3 - 1);
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { indices.insert(indices.end(), {a, b, c}); }
  [[nodiscard]] PlumbShapeDesc desc() const {
    PlumbShapeDesc desc = shape_desc(PLUMB_TRIANGLE_MESH);
    desc.vertices = vertices.data();
    desc.vertex_count = static_cast<std::uint32_t>(vertices.size() / 3);
    desc.indices = indices.data();
    desc.triangle_count = static_cast<std::uint32_t>(indices.size() / 3);
    return desc;
  }
};

/// cells x cells squares of the given side about the origin, in two triangles each; y = height(x, z).
inline TriangleSet grid(std::uint32_t cells, double side, const std::function<double(double, double)>& height) {
  TriangleSet set;
  const std::uint32_t across = cells + 1;
  for (std::uint32_t r = 0; r < across; ++r)
    for (std::uint32_t c = 0; c < across; ++c) {
      const double x = (c - cells / 2.0) * side, z = (r - cells / 2.0) * side;
      set.add(x, height(x, z), z);
    }
  for (std::uint32_t r = 0; r < cells; ++r)
    for (std::uint32_t c = 0; c < cells; ++c) {
      const std::uint32_t i = r * across + c;
      set.triangle(i, i + across, i + 1);
      set.triangle(i + 1, i + across, i + across + 1);
    }
  return set;
}
inline TriangleSet flat_grid(std::uint32_t cells, double side) {
  return grid(cells, side, [](double, double) { return 0.0; });
}

/// The cube of that half edge; each side in n x n squares of two triangles.
inline TriangleSet cube(double half, std::uint32_t n) {
  TriangleSet set;
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0}) {
      const auto at = [&](std::uint32_t i, std::uint32_t j) {
        double p[3];
        p[axis] = sign * half;
        p[(axis + 1) % 3] = half * (2.0 * i / n - 1);
        p[(axis + 2) % 3] = half * (2.0 * j / n - 1);
        return set.add(p[0], p[1], p[2]);
      };
      for (std::uint32_t i = 0; i < n; ++i)
        for (std::uint32_t j = 0; j < n; ++j) {
          const std::uint32_t a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1), d = at(i, j + 1);
          set.triangle(a, sign > 0 ? b : c, sign > 0 ? c : b);
          set.triangle(a, sign > 0 ? c : d, sign > 0 ? d : c);
        }
    }
  return set;
}

inline PlumbShapeDesc field_desc(const std::vector<double>& heights, std::uint32_t rows, std::uint32_t columns,
                                 double side) {
  PlumbShapeDesc desc = shape_desc(PLUMB_HEIGHT_FIELD);
  desc.heights = heights.data();
  desc.rows = rows;
  desc.columns = columns;
  desc.spacing = {side, 0, side};
  return desc;
}

/// A flat surface about the origin, of cells x cells squares of a side.
enum class Flat { kMesh, kBackOfMesh, kField };
inline PlumbShape make_flat(Scene& scene, Flat flat, std::uint32_t cells, double side) {
  if (flat == Flat::kField)
    return scene.make(
        field_desc(std::vector<double>(std::size_t{cells + 1} * (cells + 1), 0.0), cells + 1, cells + 1, side));
  TriangleSet set = flat_grid(cells, side);
  if (flat == Flat::kBackOfMesh)
    for (std::size_t i = 0; i < set.indices.size(); i += 3) std::swap(set.indices[i], set.indices[i + 1]);
  return scene.make(set.desc());
}

}  // namespace plumb::impulse::test
