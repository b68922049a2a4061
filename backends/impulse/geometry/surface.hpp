// Triangle meshes and height fields as kernels see them: triangles by number, what lies across their edges and around
// their corners, and which of them a box touches. Both are views with the same members:
//
//   triangle(t)          corners and their numbers
//   across(t, k)         the far corner of the triangle across the edge from corner k to the next; kNoCorner: none
//   corner(v)            the place of a corner
//   around(v, f)         f(w) for every corner w that shares an edge with v, until it returns false
//   overlaps(box, f)     f(t) for every triangle whose box touches the box
//   is_closed()          no edge has but one triangle
//   materials            of triangles, where they have their own
//
// Corners are relative to the middle of the surface's box.
#pragma once

#include "bvh/tree_view.hpp"
#include "geometry/material.hpp"
#include "geometry/shape.hpp"

#include "math/box.hpp"

namespace plumb::impulse {

constexpr std::uint32_t kNoCorner = 0xffffffffU;

struct Triangle {
  Vec at[3];
  std::uint32_t corner[3];
};

struct MeshTriangle {
  std::uint32_t corner[3];  ///< numbers after corners in one place are made one
  std::uint32_t across[3];
};

/// A surface became another: contacts of earlier steps are of what it was there.
struct LastChange {
  std::uint32_t before_step = 0;  ///< 0: it never did
  Box where{};                    ///< as seen from the middle of the surface's box
};

/// A mesh; all in the executor's memory.
struct MeshView {
  const Vec* corners;
  const MeshTriangle* triangles;
  const std::uint32_t* first_neighbour;  ///< by corner, and one more
  const std::uint32_t* neighbours;
  TreeView tree;
  std::uint32_t closed;
  TriangleMaterials materials;
  LastChange change = {};

  PLUMB_HD Vec corner(std::uint32_t v) const { return corners[v]; }
  PLUMB_HD Triangle triangle(std::uint32_t t) const {
    const MeshTriangle& m = triangles[t];
    return {{corners[m.corner[0]], corners[m.corner[1]], corners[m.corner[2]]},
            {m.corner[0], m.corner[1], m.corner[2]}};
  }
  PLUMB_HD std::uint32_t across(std::uint32_t t, int k) const { return triangles[t].across[k]; }
  template <class F>
  PLUMB_HD void around(std::uint32_t v, F& f) const {
    for (std::uint32_t i = first_neighbour[v]; i < first_neighbour[v + 1]; ++i)
      if (!f(neighbours[i])) return;
  }
  template <class F>
  PLUMB_HD void overlaps(const Box& box, F& f) const {
    tree.overlaps(box, tree.root(), f);
  }
  PLUMB_HD bool is_closed() const { return closed != 0; }
};

/// A height field. Corner row * columns + column; the cell of that corner has the triangles 2 c and 2 c + 1, c counting
/// cells row by row: (here, next row, next column) and (next column, next row, both).
struct HeightView {
  const Real* heights;  ///< relative to the middle between the lowest and the highest
  std::uint32_t rows, columns;
  Real spacing_x, spacing_z;
  Real x0, z0;  ///< of corner 0
  TriangleMaterials materials;
  LastChange change = {};

  PLUMB_HD Vec corner(std::uint32_t v) const {
    const std::uint32_t row = v / columns, column = v - row * columns;
    return {x0 + static_cast<Real>(column) * spacing_x, heights[v], z0 + static_cast<Real>(row) * spacing_z};
  }
  PLUMB_HD Triangle triangle(std::uint32_t t) const {
    const std::uint32_t cell = t / 2, row = cell / (columns - 1), here = row * columns + (cell - row * (columns - 1));
    const bool second = (t & 1U) != 0;
    const std::uint32_t a = second ? here + 1 : here, b = here + columns, c = second ? b + 1 : here + 1;
    return {{corner(a), corner(b), corner(c)}, {a, b, c}};
  }
  PLUMB_HD std::uint32_t across(std::uint32_t t, int k) const {
    const std::uint32_t cell = t / 2, row = cell / (columns - 1), column = cell - row * (columns - 1);
    const std::uint32_t here = row * columns + column;
    if ((t & 1U) == 0) {  // here, next row, next column
      if (k == 0) return column == 0 ? kNoCorner : here + columns - 1;
      if (k == 1) return here + columns + 1;
      return row == 0 ? kNoCorner : here - columns + 1;
    }  // next column, next row, both
    if (k == 0) return here;
    if (k == 1) return row + 2 == rows ? kNoCorner : here + 2 * columns;
    return column + 2 == columns ? kNoCorner : here + 2;
  }
  template <class F>
  PLUMB_HD void around(std::uint32_t v, F& f) const {
    const std::uint32_t row = v / columns, column = v - row * columns;
    const bool left = column > 0, right = column + 1 < columns, down = row > 0, up = row + 1 < rows;
    if (left && !f(v - 1)) return;
    if (right && !f(v + 1)) return;
    if (down && !f(v - columns)) return;
    if (up && !f(v + columns)) return;
    if (left && up && !f(v + columns - 1)) return;
    if (right && down) f(v - columns + 1);
  }
  template <class F>
  PLUMB_HD void overlaps(const Box& box, F& f) const {
    const std::uint32_t first_column = cell(box.low.x - x0, spacing_x, columns),
                        last_column = cell(box.high.x - x0, spacing_x, columns);
    const std::uint32_t first_row = cell(box.low.z - z0, spacing_z, rows),
                        last_row = cell(box.high.z - z0, spacing_z, rows);
    for (std::uint32_t row = first_row; row <= last_row; ++row)
      for (std::uint32_t column = first_column; column <= last_column; ++column)
        for (std::uint32_t k = 0; k < 2; ++k) {
          const std::uint32_t t = 2 * (row * (columns - 1) + column) + k;
          const Triangle triangle = this->triangle(t);
          const Box bounds = {min(triangle.at[0], min(triangle.at[1], triangle.at[2])),
                              max(triangle.at[0], max(triangle.at[1], triangle.at[2]))};
          if (overlap(box, bounds)) f(t);
        }
  }
  PLUMB_HD bool is_closed() const { return false; }

 private:
  /// The cell at a coordinate, of which there are corners - 1; the nearest where it is outside.
  PLUMB_HD static std::uint32_t cell(Real x, Real spacing, std::uint32_t corners) {
    const Real at = x / spacing, last = static_cast<Real>(corners - 2);
    return at > 0 ? static_cast<std::uint32_t>(min(at, last)) : 0U;
  }
};

/// All surfaces of a world, by row.
struct Surfaces {
  const MeshView* meshes;
  const HeightView* fields;
  std::uint32_t with_materials;  ///< how many have materials by triangle
  bool operator==(const Surfaces&) const = default;

  /// Of a shape that is one.
  [[nodiscard]] PLUMB_HD const LastChange& change(const Shape& shape) const {
    return shape.type == ShapeType::kMesh ? meshes[shape.hull].change : fields[shape.hull].change;
  }
};

}  // namespace plumb::impulse
