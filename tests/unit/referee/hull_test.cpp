// The referee's hull held against its definition, and against the one that backends are offered: two ways to one body.
#include "referee/hull.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "plumb/backend/convex_hull.hpp"
#include "plumb/backend/small_math.hpp"

namespace plumb::referee {
namespace {

using Points = std::vector<Vec3>;

double volume_of(const Hull& hull) {
  double six = 0;
  for (const auto& [a, b, c] : hull.triangles) six += hull.corners[a].dot(hull.corners[b].cross(hull.corners[c]));
  return six / 6;
}

double backend_volume_of(const Points& points) {
  std::vector<PlumbVec3> plain_points;
  for (const Vec3& point : points) plain_points.push_back(plain(point));
  const backend::ConvexHull hull = backend::convex_hull(plain_points);
  double six = 0;
  for (const auto& [a, b, c] : hull.triangles)
    six += backend::dot(hull.vertices[a], backend::cross(hull.vertices[b], hull.vertices[c]));
  return six / 6;
}

void expect_closed(const std::vector<std::vector<std::uint32_t>>& loops) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& loop : loops)
    for (std::size_t i = 0; i < loop.size(); ++i) ++edges[{loop[i], loop[(i + 1) % loop.size()]}];
  for (const auto& [edge, count] : edges) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(edges.contains({edge.second, edge.first}));
  }
}

/// Closed, outward, no point outside any face, and as much volume as by the other way.
void expect_hull(const Points& points, const Hull& hull) {
  std::vector<std::vector<std::uint32_t>> triangles, faces;
  for (const auto& t : hull.triangles) triangles.emplace_back(t.begin(), t.end());
  for (const Hull::Face& face : hull.faces) faces.push_back(face.loop);
  expect_closed(triangles);
  expect_closed(faces);
  double extent = 0;
  for (const Vec3& point : points) extent = std::max(extent, (point - points[0]).norm());
  for (const Hull::Face& face : hull.faces) {
    ASSERT_GE(face.loop.size(), 3u);
    ASSERT_NEAR(face.normal.norm(), 1, 1e-12);
    for (const Vec3& point : points) ASSERT_LE(face.normal.dot(point - hull.corners[face.loop[0]]), 1e-5 * extent);
  }
  EXPECT_NEAR(volume_of(hull) / backend_volume_of(points), 1, 1e-12);
}

Points random_points(unsigned seed, std::size_t count, bool on_sphere) {
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal;
  Points points;
  while (points.size() < count) {
    const Vec3 p(normal(engine), normal(engine), normal(engine));
    points.push_back(on_sphere ? p.normalized() : p);
  }
  return points;
}

const Eigen::Matrix3d turn = Eigen::Quaterniond(0.7, 0.5, -0.2, 0.3).normalized().toRotationMatrix();

TEST(Hull, OfRandomClouds) {
  for (unsigned seed = 1; seed <= 60; ++seed) {
    const Points points = random_points(seed, 4 + seed * 5, seed % 2 == 0);
    expect_hull(points, convex_hull(points));
  }
}

TEST(Hull, OfALatticeHasTheFacesOfItsCube) {
  for (const bool turned : {false, true}) {
    Points points;
    for (int i = 0; i < 125; ++i) {
      const Vec3 p(0.25 * (i % 5), 0.25 * (i / 5 % 5), 0.25 * (i / 25));
      points.push_back(turned ? Vec3(turn * p) : p);
    }
    const Hull hull = convex_hull(points);
    expect_hull(points, hull);
    EXPECT_EQ(hull.faces.size(), 6u);
    for (const Hull::Face& face : hull.faces) EXPECT_EQ(face.loop.size(), 4u);
  }
}

TEST(Hull, OfFloat32PointsStillHasWholeFaces) {
  Points points;
  for (int i = 0; i < 12; ++i) {  // a hexagonal prism
    const double angle = (i % 6) * 1.0471975511965976;
    points.push_back((turn * Vec3(std::cos(angle), i < 6 ? 0.5 : -0.5, std::sin(angle))).cast<float>().cast<double>());
  }
  const Hull hull = convex_hull(points);
  expect_hull(points, hull);
  EXPECT_EQ(hull.faces.size(), 8u);
}

TEST(Hull, OfAPlateIsNotFlat) {
  Points points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1, (i >> 1) & 1, 1e-5 * (i >> 2));
  const Hull hull = convex_hull(points);
  expect_hull(points, hull);
  EXPECT_EQ(hull.faces.size(), 6u);
}

TEST(Hull, LeavesOutDuplicatesAndInnerPoints) {
  Points points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (int i = 0; i < 5; ++i) points.insert(points.end(), {{0.1, 0.1, 0.1}, {0, 0, 0}, {1, 0, 0}, {0.5, 0.5, 0}});
  const Hull hull = convex_hull(points);
  EXPECT_EQ(hull.corners.size(), 4u);
  EXPECT_EQ(hull.faces.size(), 4u);
  EXPECT_NEAR(volume_of(hull), 1.0 / 6, 1e-15);
}

TEST(Hull, RefusesWhatHasNoVolume) {
  const auto refused = [](const Points& points, const char* word) {
    try {
      static_cast<void>(convex_hull(points));
      ADD_FAILURE() << "took " << points.size() << " points, not refused for: " << word;
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), PLUMB_E_INVALID_ARGUMENT);
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, "at least 4");
  refused({{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}}, "coincide");
  refused({{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}}, "plane");
  refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0.3, 0.2, 1e-9}}, "plane");
  refused({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, std::nan("")}}, "point 3");
}

}  // namespace
}  // namespace plumb::referee
