// The convex hull that the backend side offers, held against its definition.
#include "plumb/backend/convex_hull.hpp"
#include "plumb/backend/small_math.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

namespace plumb::backend {
namespace {

std::vector<PlumbVec3> random_points(std::uint64_t seed, int count, bool on_sphere) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  std::vector<PlumbVec3> points;
  for (int i = 0; i < count; ++i) {
    const PlumbVec3 p = {normal(engine), normal(engine), normal(engine)};
    points.push_back(on_sphere ? scale(1 / length(p), p) : p);
  }
  return points;
}

double volume_of(const ConvexHull& hull) {
  double six = 0;
  for (const auto& t : hull.triangles) six += dot(hull.vertices[t[0]], cross(hull.vertices[t[1]], hull.vertices[t[2]]));
  return six / 6;
}

// Closed, outward, one piece (Euler), and no point outside any face.
void expect_hull(const std::vector<PlumbVec3>& points, const ConvexHull& hull) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : hull.triangles)
    for (std::size_t e = 0; e < 3; ++e) ++edges[{t[e], t[(e + 1) % 3]}];
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(edges.contains({edge.second, edge.first}));
  }
  ASSERT_EQ(hull.vertices.size() + hull.triangles.size(), edges.size() / 2 + 2);
  ASSERT_EQ(hull.sources.size(), hull.vertices.size());
  for (std::size_t v = 0; v < hull.vertices.size(); ++v) {
    ASSERT_EQ(hull.vertices[v].x, points[hull.sources[v]].x);
    if (v > 0) {
      ASSERT_LT(hull.sources[v - 1], hull.sources[v]);
    }
  }
  for (const auto& t : hull.triangles) {
    const PlumbVec3& a = hull.vertices[t[0]];
    const PlumbVec3 area = cross(sub(hull.vertices[t[1]], a), sub(hull.vertices[t[2]], a));
    for (const PlumbVec3& p : points) ASSERT_LE(dot(area, sub(p, a)), 1e-11 * std::pow(hull.extent, 3));
  }
  std::size_t corners = 0;
  for (const HullFace& face : hull.faces) {
    ASSERT_GE(face.loop.size(), 3u);
    ASSERT_NEAR(length(face.normal), 1, 1e-12);
    corners += face.loop.size();
    for (const PlumbVec3& p : points)
      ASSERT_LE(dot(face.normal, p) - face.offset, 2 * hull_merge_tolerance * hull.extent);
    double highest = -1e300;
    for (const std::uint32_t v : face.loop) highest = std::max(highest, dot(face.normal, hull.vertices[v]));
    ASSERT_LE(highest, face.offset);
    ASSERT_GE(highest, face.offset - hull_merge_tolerance * hull.extent);
  }
  ASSERT_EQ(corners % 2, 0u);  // every edge bounds two faces
}

TEST(ConvexHull, RandomClouds) {
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto points = random_points(seed, 4 + static_cast<int>(seed) * 5, seed % 2 == 0);
    expect_hull(points, convex_hull(points));
  }
}

TEST(ConvexHull, ThousandsOfPointsOnASphereAreAllCorners) {
  const auto points = random_points(7, 3000, true);
  const ConvexHull hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size(), 3000u);
  EXPECT_EQ(hull.triangles.size(), 2 * 3000u - 4);
  EXPECT_NEAR(volume_of(hull), 4.18879020, 0.02);
}

// A turned lattice: hundreds of points that lie in its six sides but for rounding.
TEST(ConvexHull, LatticeHasSixFaces) {
  const Matrix3 turn = rotation_matrix({0.1, 0.2, 0.3, 0.9});
  for (const double size : {1e-6, 1.0, 1e6}) {
    std::vector<PlumbVec3> points;
    for (int i = 0; i < 8; ++i)
      for (int j = 0; j < 8; ++j)
        for (int k = 0; k < 8; ++k) points.push_back(multiply(turn, PlumbVec3{size * i, size * j, size * k}));
    const ConvexHull hull = convex_hull(points);
    expect_hull(points, hull);
    ASSERT_EQ(hull.faces.size(), 6u);
    for (const HullFace& face : hull.faces) EXPECT_EQ(face.loop.size(), 4u);
    EXPECT_NEAR(volume_of(hull) / (343 * size * size * size), 1, 1e-11);
  }
}

// Upright, its points lie in the sides and on the edges exactly: no triangle may be without area.
TEST(ConvexHull, UprightLatticeHasEightCorners) {
  std::vector<PlumbVec3> points;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j)
      for (int k = 0; k < 5; ++k) points.push_back({0.25 * i, 0.25 * j, 0.25 * k});
  const ConvexHull hull = convex_hull(points);
  expect_hull(points, hull);
  EXPECT_EQ(hull.faces.size(), 6u);
  EXPECT_EQ(volume_of(hull), 1);
  for (const auto& t : hull.triangles) {
    const PlumbVec3& a = hull.vertices[t[0]];
    EXPECT_GT(length(cross(sub(hull.vertices[t[1]], a), sub(hull.vertices[t[2]], a))), 0);
  }
}

TEST(ConvexHull, Float32PointsStillMakeWholeFaces) {
  const Matrix3 turn = rotation_matrix({0.5, -0.2, 0.3, 0.7});
  std::vector<PlumbVec3> points;
  for (int i = 0; i < 12; ++i) {  // a hexagonal prism
    const double angle = (i % 6) * 1.0471975511965976;
    const PlumbVec3 p = multiply(turn, PlumbVec3{std::cos(angle), i < 6 ? 0.5 : -0.5, std::sin(angle)});
    points.push_back({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  }
  const ConvexHull hull = convex_hull(points);
  expect_hull(points, hull);
  EXPECT_EQ(hull.faces.size(), 8u);
}

TEST(ConvexHull, DuplicatesAndInnerPointsAreLeftOut) {
  std::vector<PlumbVec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 5; ++i) points.insert(points.end(), {{0.1, 0.1, 0.1}, {0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}});
  const ConvexHull hull = convex_hull(points);
  EXPECT_EQ(hull.vertices.size(), 4u);
  EXPECT_EQ(hull.faces.size(), 4u);
  EXPECT_NEAR(volume_of(hull), 1.0 / 6, 1e-15);
}

TEST(ConvexHull, NearlyEqualPointsAndTinyEdges) {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> noise(-1e-9, 1e-9);
  std::vector<PlumbVec3> points;
  for (int i = 0; i < 400; ++i)
    points.push_back({(i & 1) + noise(engine), ((i >> 1) & 1) + noise(engine), ((i >> 2) & 1) + noise(engine)});
  const ConvexHull hull = convex_hull(points);
  expect_hull(points, hull);
  EXPECT_NEAR(volume_of(hull), 1, 1e-8);
}

TEST(ConvexHull, ThinButNotFlat) {
  const std::vector<PlumbVec3> card = {{0, 0, 0},    {1, 0, 0},    {1, 1, 0},    {0, 1, 0},
                                       {0, 0, 1e-5}, {1, 0, 1e-5}, {1, 1, 1e-5}, {0, 1, 1e-5}};
  const ConvexHull hull = convex_hull(card);
  EXPECT_EQ(hull.faces.size(), 6u);
  EXPECT_NEAR(volume_of(hull) / 1e-5, 1, 1e-9);
}

TEST(ConvexHull, RefusesWhatHasNoVolume) {
  const auto refused = [](const std::vector<PlumbVec3>& points, const char* word) {
    try {
      (void)convex_hull(points);
      ADD_FAILURE() << "took " << points.size() << " points, not refused for: " << word;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), PLUMB_E_INVALID_ARGUMENT);
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "at least 4");
  refused({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, "coincide");
  refused({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, "line");
  refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 1e-9}}, "plane");
  refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}, "point 3");
}

}  // namespace
}  // namespace plumb::backend
