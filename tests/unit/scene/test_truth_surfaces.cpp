// Where polytopes can stand, and where spheres touch triangles, against brute force and solids that one knows.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "truth/surfaces.hpp"

namespace plumb::truth {
namespace {

using Eigen::Vector3d;

struct Solid {
  std::vector<Vector3d> corners;
  std::vector<HalfSpace> faces;
};

Solid box(const Vector3d& half) {
  Solid solid;
  for (int i = 0; i < 8; ++i)
    solid.corners.emplace_back((i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(), (i & 4 ? 1 : -1) * half.z());
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0}) solid.faces.push_back({side * Vector3d::Unit(axis), half[axis]});
  return solid;
}

TEST(Stands, BoxOnAnyFaceAtHalfItsSide) {
  const Solid solid = box({1, 2, 3});
  const auto stands = stable_stands(solid.corners, solid.faces, Vector3d::Zero(), 1e-12);
  ASSERT_EQ(stands.size(), 6u);
  for (const Stand& stand : stands) EXPECT_NEAR(stand.height, std::abs(stand.down.dot(Vector3d(1, 2, 3))), 1e-15);
}

TEST(Stands, CentreBesideAFaceDoesNotStandThere) {
  // The centre of mass outside of the box's shadow on x and y faces: only x faces bear a body that is loaded at x > 1.
  const Solid solid = box({1, 1, 1});
  const auto stands = stable_stands(solid.corners, solid.faces, {1.5, 0, 0}, 1e-12);
  ASSERT_EQ(stands.size(), 2u);
  for (const Stand& stand : stands) EXPECT_EQ(std::abs(stand.down.x()), 1);
}

TEST(Stands, StableFacesAreTheLocalMinimaOfTheHeight) {
  // Second way: tilt the body a little from the face in every direction; its centre must rise.
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 20; ++trial) {
    Solid solid = box({1, 1.3, .8});
    const Eigen::Quaterniond turn = Eigen::Quaterniond::UnitRandom();
    for (Vector3d& p : solid.corners) p = turn * p;
    for (HalfSpace& face : solid.faces) face.normal = turn * face.normal;
    const double x = normal(random), y = normal(random), z = normal(random);
    const Vector3d centre = .7 * Vector3d(x, y, z);
    const auto height = [&](const Vector3d& down) {
      double most = -1e9;
      for (const Vector3d& p : solid.corners) most = std::max(most, down.dot(p - centre));
      return most;
    };
    std::size_t minima = 0;
    for (const HalfSpace& face : solid.faces) {
      const Vector3d u = face.normal.unitOrthogonal(), v = face.normal.cross(u);
      bool rises = true;
      for (int i = 0; i < 720; ++i) {
        const double a = i * M_PI / 360;
        const Vector3d tilted = (face.normal + 1e-6 * (std::cos(a) * u + std::sin(a) * v)).normalized();
        rises = rises && height(tilted) > height(face.normal);
      }
      minima += rises;
    }
    EXPECT_EQ(stable_stands(solid.corners, solid.faces, centre, 1e-12).size(), minima) << "trial " << trial;
  }
}

double distance_to(const Triangle& t, const Vector3d& p) {
  // By barycentric search, coarse to fine: slow, and nothing like the code under test.
  double best = 1e9, s = 0, u = 0;
  for (double step = .05; step > 1e-12; step /= 4) {
    const double s0 = s, u0 = u;
    for (int i = -20; i <= 20; ++i)
      for (int j = -20; j <= 20; ++j) {
        const double a = std::clamp(s0 + i * step, 0.0, 1.0), b = std::clamp(u0 + j * step, 0.0, 1.0 - a);
        const double d = (t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]) - p).norm();
        if (d < best) {
          best = d;
          s = a;
          u = b;
        }
      }
  }
  return best;
}

TEST(FirstTouch, SphereIsARadiusAwayThereAndNowhereBefore) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  const auto vector = [&] {
    const double x = place(random), y = place(random), z = place(random);
    return Vector3d(x, y, z);
  };
  int touched = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Vector3d a = vector(), b = vector(), c = vector();
    const Triangle t{a, b, c};
    Vector3d start = 4 * vector().normalized();
    if ((b - a).cross(c - a).dot(start - a) < 0) start = -start;  // a face is seen from its front
    if ((b - a).cross(c - a).dot(start - a) < 0) continue;
    const Vector3d aim = .6 * vector(), direction = (aim - start).normalized();
    const double radius = .2;
    const auto touch = first_touch(std::span(&t, 1), start, direction, radius, 10);
    if (!touch) {
      for (double way = 0; way < 10; way += .02)
        ASSERT_GT(distance_to(t, start + way * direction), radius - 1e-6) << "trial " << trial;
      continue;
    }
    ++touched;
    EXPECT_NEAR(distance_to(t, start + touch->distance * direction), radius, 1e-7) << "trial " << trial;
    for (double share = 0; share < 1; share += .02)
      EXPECT_GT(distance_to(t, start + share * touch->distance * direction), radius - 1e-7) << "trial " << trial;
    EXPECT_NEAR(touch->normal.norm(), 1, 1e-12);
    EXPECT_LT(touch->normal.dot(direction), 0);
  }
  EXPECT_GT(touched, 20);
}

TEST(FirstTouch, FaceEdgeAndCornerOfAFloor) {
  const std::vector<Triangle> floor{{Vector3d(0, 0, 0), Vector3d(0, 0, 1), Vector3d(1, 0, 0)},
                                    {Vector3d(1, 0, 0), Vector3d(0, 0, 1), Vector3d(1, 0, 1)}};
  const auto face = first_touch(floor, {.4, 3, .4}, -Vector3d::UnitY(), .5, 10);
  ASSERT_TRUE(face);
  EXPECT_NEAR(face->distance, 2.5, 1e-15);
  EXPECT_NEAR((face->normal - Vector3d::UnitY()).norm(), 0, 1e-15);
  const auto edge = first_touch(floor, {-.3, 3, .4}, -Vector3d::UnitY(), .5, 10);  // 3-4-5
  ASSERT_TRUE(edge);
  EXPECT_NEAR(edge->distance, 2.6, 1e-14);
  EXPECT_NEAR((edge->normal - Vector3d(-.6, .8, 0)).norm(), 0, 1e-14);
  const auto corner = first_touch(floor, {-.3, 3, -.3}, -Vector3d::UnitY(), .5, 10);
  ASSERT_TRUE(corner);
  EXPECT_NEAR(corner->distance, 3 - std::sqrt(.25 - .18), 1e-14);
  EXPECT_FALSE(first_touch(floor, {.4, 3, .4}, -Vector3d::UnitY(), .5, 2.4));
  EXPECT_FALSE(first_touch(floor, {.4, .6, .4}, Vector3d::UnitY(), .5, 10));
}

}  // namespace
}  // namespace plumb::truth
