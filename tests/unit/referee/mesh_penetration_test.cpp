// Meshes and height fields: flat ground in triangles answers as a plane, ridges and one-sidedness.
#include <gtest/gtest.h>

#include <cmath>

#include "shapes.hpp"

namespace plumb::referee::testing {
namespace {

// A square of side `2 * half` in the plane y = 0, seen from above, cut into n x n cells of two triangles.
ShapePtr flat_mesh(double half, std::uint32_t n) {
  std::vector<double> vertices;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t row = 0; row <= n; ++row)
    for (std::uint32_t column = 0; column <= n; ++column)
      vertices.insert(vertices.end(), {half * (2.0 * column / n - 1), 0, half * (2.0 * row / n - 1)});
  for (std::uint32_t row = 0; row < n; ++row)
    for (std::uint32_t column = 0; column < n; ++column) {
      const std::uint32_t at = row * (n + 1) + column;
      indices.insert(indices.end(), {at, at + n + 1, at + 1, at + 1, at + n + 1, at + n + 2});
    }
  return Shape::make(mesh_desc(vertices, indices));
}

ShapePtr field(std::uint32_t rows, std::uint32_t columns, const std::vector<double>& heights) {
  PlumbShapeDesc desc = shape_desc(PLUMB_HEIGHT_FIELD);
  desc.heights = heights.data();
  desc.rows = rows;
  desc.columns = columns;
  desc.spacing = {1, 0, 1};
  return Shape::make(desc);
}

TEST(MeshPenetration, FlatGroundAnswersAsAPlane) {
  Random random(21);
  const ShapePtr ground = flat_mesh(8, 5), level = plane();
  for (int i = 0; i < 1000; ++i) {
    const ShapePtr shape = random.convex();
    Pose pose = random.pose(1);
    const double lowest = (pose * shape->support(pose.rotation.transpose() * -Vec3::UnitY())).y();
    pose.position.y() += random.in(-0.05, 0.05) - lowest;  // near the ground, a little in or out of it
    const Penetration truth = penetration(*level, at(0, 0, 0), *shape, pose);
    const Penetration found = penetration(*ground, at(0, 0, 0), *shape, pose);
    ASSERT_NEAR(found.depth, truth.depth, 1e-8) << shape->type();
    if (found.depth > 0) {
      ASSERT_NEAR(found.normal.y(), 1, 1e-6) << shape->type();
    }
  }
}

TEST(MeshPenetration, OnARidgeTheShortestWayCounts) {
  // Two slopes that fall from the line x = 0, and a box whose bottom cuts the crest by 1 mm: up, not through the
  // slopes.
  const std::vector<double> vertices = {0, 0, -5, 0, 0, 5, 5, -5, 5, 5, -5, -5, -5, -5, 5, -5, -5, -5};
  const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3, 0, 4, 1, 0, 5, 4};
  const ShapePtr roof = Shape::make(mesh_desc(vertices, indices));
  for (const auto& triangle : roof->triangles())
    ASSERT_GT((triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).y(), 0);
  const Penetration found = penetration(*roof, at(0, 0, 0), *box(1, 1, 1), at(0, 0.999, 0));
  EXPECT_NEAR(found.depth, 0.001, 1e-12);
  EXPECT_NEAR(found.normal.y(), 1, 1e-9);
}

TEST(MeshPenetration, TrianglesHaveAFront) {
  const ShapePtr ground = flat_mesh(5, 1);
  // The centre is below the surface: the way out is up through the front, not down by less.
  const Penetration sunk = penetration(*ground, at(0, 0, 0), *sphere(0.5), at(0.3, -0.2, 0.1));
  EXPECT_NEAR(sunk.depth, 0.7, 1e-12);
  EXPECT_NEAR(sunk.normal.y(), 1, 1e-12);
  const Penetration box_sunk = penetration(*ground, at(0, 0, 0), *box(0.5, 0.5, 0.5), at(0.3, -0.2, 0.1));
  EXPECT_NEAR(box_sunk.depth, 0.7, 1e-12);
  // Wholly through: apart, as said.
  EXPECT_NEAR(penetration(*ground, at(0, 0, 0), *sphere(0.5), at(0.3, -0.7, 0.1)).depth, -0.2, 1e-12);
}

TEST(MeshPenetration, HeightFieldIsCentredAndFacesUp) {
  const ShapePtr hill = field(3, 3, {0, 0, 0, 0, 1, 0, 0, 0, 0});
  EXPECT_EQ(hill->triangles().size(), 8u);
  for (const auto& triangle : hill->triangles())
    EXPECT_GT((triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).y(), 0);
  EXPECT_NEAR(penetration(*hill, at(0, 0, 0), *sphere(0.5), at(0, 1.4, 0)).depth, 0.1, 1e-12);  // on the top
  const Aabb bounds = hill->bounds(at(10, 0, 0));
  EXPECT_EQ(bounds.low.x(), 9);
  EXPECT_EQ(bounds.high.x(), 11);
  EXPECT_EQ(bounds.high.y(), 1);
  const Penetration bound = penetration(*hill, at(0, 0, 0), *sphere(0.1), at(0, 3, 0), Apart::lower_bound);
  EXPECT_LT(bound.depth, 0);
  EXPECT_GE(bound.depth, -1.9 - 1e-12);
}

TEST(MeshPenetration, TheDeepestTriangleCounts) {
  // Two tables of different heights below one box, in either order.
  for (const bool high_first : {false, true}) {
    std::vector<double> vertices;
    for (const bool left : {true, false}) {
      const double x = left ? -2 : 2, y = left == high_first ? 0.05 : 0;
      vertices.insert(vertices.end(), {x - 1, y, -1, x - 1, y, 1, x + 1, y, 0});
    }
    const ShapePtr tables = Shape::make(mesh_desc(vertices, {0, 1, 2, 3, 4, 5}));
    const Penetration found = penetration(*tables, at(0, 0, 0), *box(4, 1, 1), at(0, 0.99, 0));
    EXPECT_NEAR(found.depth, 0.06, 1e-9) << high_first;
  }
}

TEST(MeshPenetration, APeakBesideAValleyHoldsWhatLiesOnIt) {
  // Seven corners of a rough field: the middle one is the highest, and some edges at it are valleys. A level box cuts
  // 1 cm of it off: up is the way out, though no triangle alone lets go so.
  std::vector<double> heights(49, -1.0);
  const double ring[] = {-0.9, -0.1, -0.9, -0.1, -0.9, -0.1};
  heights[3 * 7 + 3] = 0;
  heights[2 * 7 + 3] = ring[0], heights[2 * 7 + 4] = ring[1], heights[3 * 7 + 4] = ring[2];
  heights[4 * 7 + 3] = ring[3], heights[4 * 7 + 2] = ring[4], heights[3 * 7 + 2] = ring[5];
  const ShapePtr peak = field(7, 7, heights);
  const Penetration found = penetration(*peak, at(0, 0, 0), *box(0.05, 0.3, 0.05), at(0, 0.29, 0));
  EXPECT_NEAR(found.depth, 0.01, 1e-6);
  EXPECT_NEAR(found.normal.y(), 1, 1e-6);
}

TEST(MeshPenetration, OfRoughGroundTheDepthSeparates) {
  Random random(77);
  int cut = 0;
  for (int i = 0; i < 400; ++i) {
    std::vector<double> heights;
    for (int k = 0; k < 64; ++k) heights.push_back(random.in(-0.5, 0));
    const ShapePtr ground = field(8, 8, heights);
    const ShapePtr shape = random.convex();
    Pose pose = random.pose(1);
    const double lowest = (pose * shape->support(pose.rotation.transpose() * -Vec3::UnitY())).y();
    pose.position.y() += random.in(-0.4, 0) - lowest;
    const Penetration found = penetration(*ground, at(0, 0, 0), *shape, pose);
    if (found.depth <= 0) continue;
    ++cut;
    pose.position += found.depth * (1 + 1e-5) * found.normal + 1e-6 * found.normal;
    // Over a single triangle's own way another one may still be cut, but never as deep.
    EXPECT_LT(penetration(*ground, at(0, 0, 0), *shape, pose).depth, 0.5 * found.depth) << i;
  }
  EXPECT_GT(cut, 100);
}

}  // namespace
}  // namespace plumb::referee::testing
