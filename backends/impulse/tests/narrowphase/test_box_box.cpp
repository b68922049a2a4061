// Boxes against boxes: answers known in closed form, ids that stay, four points and which.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "narrowphase/collide.hpp"

namespace plumb::impulse {
namespace {

constexpr Quat kUnturned = {0, 0, 0, 1};
constexpr Hulls kNoHulls = {};

Shape box(Real x, Real y, Real z) { return {ShapeType::kBox, 0, {x, y, z}, std::sqrt(x * x + y * y + z * z)}; }
Quat turned(double degrees, double x, double y, double z) {
  const double half = degrees * 3.14159265358979323846 / 360, s = std::sin(half) / std::sqrt(x * x + y * y + z * z);
  return {static_cast<Real>(x * s), static_cast<Real>(y * s), static_cast<Real>(z * s),
          static_cast<Real>(std::cos(half))};
}
Manifold touch(const ShapePair& pair) {
  Manifold m{};
  collide(pair, kNoHulls, m);
  return m;
}

TEST(BoxBox, RestingCubesTouchAtFourCornersExactly) {
  const Shape cube = box(Real(0.5), Real(0.5), Real(0.5));
  const Manifold m = touch({cube, cube, kUnturned, kUnturned, {0, 1, 0}, Real(0.01)});
  ASSERT_EQ(m.count, 4U);
  EXPECT_EQ(m.normal, (Vec{0, 1, 0}));
  std::set<std::pair<Real, Real>> corners;
  for (const ManifoldPoint& p : m.points) {
    EXPECT_EQ(p.separation, 0);
    EXPECT_EQ(p.position.y, Real(0.5));
    EXPECT_EQ(std::abs(p.position.x), Real(0.5));
    EXPECT_EQ(std::abs(p.position.z), Real(0.5));
    corners.insert({p.position.x, p.position.z});
  }
  EXPECT_EQ(corners.size(), 4U);
}

/// A cube that has sunk by .3 mm into the tile that it slides on, and comes to the next: the floor holds it up, and the
/// next one's side is no wall. Queries, which ask with no margin, are told of any overlap.
TEST(BoxBox, SidesOfLevelTilesAreNoWalls) {
  const Shape cube = box(Real(0.5), Real(0.5), Real(0.5));
  const auto at = [&](double x, double y, Real margin) {
    return touch({cube, cube, kUnturned, turned(30, 0, 1, 0), {static_cast<Real>(x), static_cast<Real>(y), 0}, margin});
  };
  const double reach = 0.5 + 0.5 * (std::cos(30 * 3.14159265358979323846 / 180) + 0.5);  // along x
  for (const double sunk : {0.0003, 0.004, -0.004})
    for (const double gap : {0.03, 0.001, -0.0001}) {
      EXPECT_EQ(at(-reach - gap, 1 - sunk, Real(0.05)).count, 0U) << sunk << ", " << gap;
      EXPECT_EQ(at(-reach - gap, 1 - sunk, 0).count != 0, sunk > 0 && gap < 0) << sunk << ", " << gap;
    }
  const Manifold on = at(-reach + 0.02, 1 - 0.0003, Real(0.05));
  EXPECT_GT(on.count, 0U);
  EXPECT_EQ(std::abs(on.normal.y), 1);
  const Manifold wall = at(-reach - 0.03, 0.9, Real(0.05));
  EXPECT_GT(wall.count, 0U);
  EXPECT_LT(std::abs(wall.normal.y), 0.1);
}

TEST(BoxBox, CrossingEdgesTouchAtOnePoint) {
  const Shape cube = box(Real(0.5), Real(0.5), Real(0.5));
  const Manifold m = touch({cube, cube, turned(45, 0, 0, 1), turned(45, 1, 0, 0), {0, Real(1.4), 0}, 0});
  ASSERT_EQ(m.count, 1U);
  EXPECT_NEAR(m.normal.y, 1, 1e-6);
  EXPECT_NEAR(m.points[0].separation, -0.01421356, 1e-6);
  EXPECT_NEAR(m.points[0].position.x, 0, 1e-6);
  EXPECT_NEAR(m.points[0].position.y, 0.7, 1e-6);
  EXPECT_NEAR(m.points[0].position.z, 0, 1e-6);
}

TEST(BoxBox, EdgesThatAreAllButParallelTouchWithinBoth) {
  const Shape cube = box(Real(0.5), Real(0.5), Real(0.5));
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  int touching = 0;
  for (int i = 0; i < 100000; ++i) {  // corner line to corner line, tilted across it by 3e-5 to 3e-3 degrees
    const double tilt = std::pow(10, -3.5 + unit(random)), roll = 45 + 5 * unit(random);
    const Vec d = {static_cast<Real>(0.02 * unit(random)), static_cast<Real>(1.425 + 0.01 * unit(random)),
                   static_cast<Real>(0.9 * unit(random))};
    const Quat q = normalized(turned(tilt, unit(random), unit(random), 0) * turned(roll + unit(random), 0, 0, 1));
    const Manifold m = touch({cube, cube, turned(roll, 0, 0, 1), q, d, Real(0.02)});
    touching += m.count != 0;
    for (std::uint32_t p = 0; p < m.count; ++p) {
      const Vec& at = m.points[p].position;
      ASSERT_TRUE(length(at) < Real(0.95) && length(at - d) < Real(0.95))
          << tilt << " degrees: " << at.x << ' ' << at.y << ' ' << at.z;
    }
  }
  EXPECT_GT(touching, 500);
}

TEST(BoxBox, CubeOnItsDiagonalTouchesWithOneCorner) {
  const Shape cube = box(Real(0.5), Real(0.5), Real(0.5)), ground = box(10, 1, 10);
  const double tilt = std::acos(1 / std::sqrt(3.0)) * 180 / 3.14159265358979323846;
  const Quat q = turned(tilt, 1, 0, -1);  // takes the diagonal (1, 1, 1) to y
  const Manifold m = touch({ground, cube, kUnturned, q, {0, Real(1.86602540), 0}, Real(1e-4)});
  ASSERT_EQ(m.count, 1U);
  EXPECT_NEAR(m.normal.y, 1, 1e-6);
  EXPECT_NEAR(m.points[0].separation, 0, 1e-6);
}

TEST(BoxBox, EightCornersAreReducedToFourThatSpanTheOctagon) {
  const Shape cube = box(1, 1, 1);
  const Manifold m = touch({cube, cube, kUnturned, turned(45, 0, 1, 0), {0, Real(1.999), 0}, 0});
  ASSERT_EQ(m.count, 4U);
  for (const ManifoldPoint& p : m.points) EXPECT_NEAR(p.position.y, 0.9995, 1e-6) << "midway between the surfaces";
  double area = 0;  // of the quadrangle by its diagonals: sort by angle first
  std::array<Vec, 4> p;
  for (std::size_t i = 0; i < 4; ++i) p[i] = m.points[i].position;
  std::sort(p.begin(), p.end(), [](const Vec& a, const Vec& b) { return std::atan2(a.z, a.x) < std::atan2(b.z, b.x); });
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec &a = p[i], &b = p[(i + 1) % 4];
    area += 0.5 * static_cast<double>(a.x * b.z - a.z * b.x);
  }
  EXPECT_GT(area, 2.0);  // the octagon has 8 (sqrt 2 - 1) = 3.31, its best quadrangle 2.34
}

}  // namespace
}  // namespace plumb::impulse
