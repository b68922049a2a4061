// The pool of hulls, and hulls with many faces or with faces of many corners.
#include "geometry/hull_pool.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "plumb/physics_world.hpp"
#include "tests/rigs/narrow_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;

std::vector<PlumbVec3> prism(int sides, double radius, double half_height) {
  std::vector<PlumbVec3> points;
  for (int i = 0; i < sides; ++i)
    for (const double y : {-half_height, half_height}) {
      const double angle = 2 * 3.14159265358979323846 * i / sides;
      points.push_back({radius * std::cos(angle), y, radius * std::sin(angle)});
    }
  return points;
}
Shape hull_shape(HullPool& pool, const std::vector<PlumbVec3>& points) {
  const std::uint32_t row = pool.add(points);
  return {ShapeType::kHull, row, {0, 0, 0}, pool.reach(row)};
}

void expect_closed(const HullView& view) {
  EXPECT_EQ(view.vertex_count() + view.face_count(), view.edge_count() + 2);  // Euler
  for (std::uint32_t f = 0; f < view.face_count(); ++f) {
    EXPECT_NEAR(length(view.normal(f)), 1, 4 * kEpsilon);
    for (std::uint32_t v = 0; v < view.vertex_count(); ++v)
      EXPECT_LE(dot(view.normal(f), view.vertex(v)), view.offset(f) + Real(2e-6));
  }
  for (std::uint32_t e = 0; e < view.edge_count(); ++e) {
    const HullEdge edge = view.edge(e);
    const auto runs = [&](std::uint32_t face, std::uint32_t from, std::uint32_t to) {
      for (std::uint32_t k = 0; k < view.loop_size(face); ++k)
        if (view.loop(face, k) == from && view.loop(face, (k + 1) % view.loop_size(face)) == to) return true;
      return false;
    };
    EXPECT_TRUE(runs(edge.left, edge.from, edge.to));
    EXPECT_TRUE(runs(edge.right, edge.to, edge.from));
  }
}

TEST(HullPool, MergesFacesAndLeavesOutWhatIsNoCorner) {
  HullPool pool;
  std::vector<PlumbVec3> points = {{0, 0, 0}, {0.9, 1, 0.2}, {1, 0, 0}};  // inside, on a face, amid a face
  for (int i = 0; i < 8; ++i) points.push_back({(i & 1) * 2.0 - 1, (i & 2) * 1.0 - 1, (i & 4) * 0.5 - 1});
  ASSERT_EQ(pool.add(points), 0U);
  const HullView cube(pool.host(), 0);
  EXPECT_EQ(cube.vertex_count(), 8U);
  EXPECT_EQ(cube.face_count(), 6U);
  EXPECT_EQ(cube.edge_count(), 12U);
  expect_closed(cube);
  EXPECT_NEAR(pool.reach(0), std::sqrt(3.0), 1e-6);
}

TEST(HullPool, TheBoxViewIsAClosedHullToo) {
  const BoxView box{{1, 2, 3}};
  for (std::uint32_t e = 0; e < 12; ++e) {
    const HullEdge edge = box.edge(e);
    const auto runs = [&](std::uint32_t face, std::uint32_t from, std::uint32_t to) {
      for (std::uint32_t k = 0; k < 4; ++k)
        if (box.loop(face, k) == from && box.loop(face, (k + 1) % 4) == to) return true;
      return false;
    };
    EXPECT_TRUE(runs(edge.left, edge.from, edge.to)) << e;
    EXPECT_TRUE(runs(edge.right, edge.to, edge.from)) << e;
  }
}

TEST(HullPool, GivesTheRoomOfARemovedHullToOneThatFits) {
  HullPool pool;
  const std::uint32_t large = pool.add(prism(12, 1, 1)), small = pool.add(prism(3, 1, 1));
  pool.remove(large);
  EXPECT_EQ(pool.add(prism(20, 1, 1)), 2U);
  EXPECT_EQ(pool.add(prism(5, 1, 1)), large);
  expect_closed(HullView(pool.host(), large));
  expect_closed(HullView(pool.host(), small));
  expect_closed(HullView(pool.host(), 2));
  EXPECT_EQ(HullView(pool.host(), large).face_count(), 7U);

  pool.remove(2);  // 40 vertices and 22 faces: room for the vertices of a ball, not for its triangles
  Dice dice(1);
  std::vector<PlumbVec3> ball;
  for (int i = 0; i < 40; ++i) {
    const V v = dice.direction();
    ball.push_back({v.x, v.y, v.z});
  }
  EXPECT_EQ(pool.add(ball), 3U);
  expect_closed(HullView(pool.host(), 3));
}

TEST(HullPool, RefusesWhatHasNoVolume) {
  HullPool pool;
  const PlumbVec3 flat[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  EXPECT_THROW(pool.add(flat), Error);
}

TEST(HullPool, FacesOfAnyNumberOfCornersRestOnFourPoints) {
  HullPool pool;
  const Shape drum = hull_shape(pool, prism(100, 1, 0.5)), wide = hull_shape(pool, prism(200, 3, 0.5));
  expect_closed(HullView(pool.host(), drum.hull));
  EXPECT_EQ(HullView(pool.host(), drum.hull).face_count(), 102U);
  for (const Shape& below : {drum, wide, make_box(2, 0.5, 2)}) {
    Manifold m{};
    ASSERT_TRUE(collide({below, drum, {0, 0, 0, 1}, {0, 0, 0, 1}, {Real(0.1), Real(0.999), 0}, 0}, pool.host(), m));
    EXPECT_EQ(m.count, 4U);
    EXPECT_NEAR(std::abs(m.normal.y), 1, 1e-5);
    double low_x = 1e9, high_x = -1e9, low_z = 1e9, high_z = -1e9;
    for (const ManifoldPoint& p : m.points) {
      EXPECT_NEAR(p.separation, -0.001, 1e-5);
      low_x = std::min(low_x, static_cast<double>(p.position.x));
      high_x = std::max(high_x, static_cast<double>(p.position.x));
      low_z = std::min(low_z, static_cast<double>(p.position.z));
      high_z = std::max(high_z, static_cast<double>(p.position.z));
    }
    EXPECT_GT(high_x - low_x, 1.2);  // four points of a disc of radius 1 span it in every direction
    EXPECT_GT(high_z - low_z, 1.2);
  }
}

TEST(HullPool, RoundHullsOfManyFacesAgreeWithBruteForce) {
  HullPool pool;
  Dice dice(31);
  std::vector<PlumbVec3> points;
  for (int i = 0; i < 80; ++i) {
    const V v = dice.direction();
    points.push_back({v.x, v.y, v.z});
  }
  const Shape ball = hull_shape(pool, points);
  EXPECT_GE(HullView(pool.host(), ball.hull).face_count(), 64U);
  for (int i = 0; i < 40; ++i) {
    const V u = dice.uniform(1.6, 2.1) * dice.direction();
    const RandomPair p = {ball,
                          ball,
                          Dice::to_real(dice.orientation()),
                          Dice::to_real(dice.orientation()),
                          {static_cast<Real>(u.x), static_cast<Real>(u.y), static_cast<Real>(u.z)}};
    Manifold m{};
    collide({p.a, p.b, p.qa, p.qb, p.d, 0}, pool.host(), m);
    const double best =
        greatest_gap(polyhedron(ball, pool.host(), p.qa, {0, 0, 0}), polyhedron(ball, pool.host(), p.qb, p.d));
    EXPECT_EQ(m.count > 0, best <= 0);
    EXPECT_NEAR(m.count > 0 ? static_cast<double>(m.points[0].separation) : best, best, 1e-5);
  }
}

}  // namespace
}  // namespace plumb::impulse
