// Contact points of convex pairs whose common part is known.
#include <gtest/gtest.h>

#include <algorithm>

#include "referee/contact_patch.hpp"
#include "shapes.hpp"

namespace plumb::referee {
namespace {

using namespace testing;

constexpr double flat = 0.01, reach = 0.05;

std::vector<PatchPoint> patch_of(const ShapePtr& a, const Pose& at_a, const ShapePtr& b, const Pose& at_b) {
  return contact_patch(*a, at_a, *b, at_b, flat, reach);
}

/// Every expected point is there, and no other.
void expect_points(const std::vector<PatchPoint>& patch, const std::vector<Vec3>& points) {
  EXPECT_EQ(patch.size(), points.size());
  for (const Vec3& point : points)
    EXPECT_TRUE(std::any_of(patch.begin(), patch.end(), [&](const PatchPoint& p) {
      return (p.point - point).norm() < 1e-9;
    })) << point.transpose();
}

TEST(ContactPatch, FacesMeetInTheirCommonPolygon) {
  const ShapePtr cube = box(0.5, 0.5, 0.5);
  const auto above = patch_of(cube, at(0, 0, 0), cube, at(0.25, 1.002, 0));
  expect_points(above, {{-0.25, 0.501, -0.5}, {0.5, 0.501, -0.5}, {0.5, 0.501, 0.5}, {-0.25, 0.501, 0.5}});
  for (const PatchPoint& p : above) {
    EXPECT_NEAR(p.gap, 0.002, 1e-12);
    EXPECT_LT((p.normal - Vec3::UnitY()).norm(), 1e-12);
  }
  const auto octagon = patch_of(cube, at(0, 0, 0), cube, turned(45, {0, 1, 0}, {0, 0.999, 0}));
  EXPECT_EQ(octagon.size(), 8u);
  for (const PatchPoint& p : octagon) EXPECT_NEAR(p.gap, -0.001, 1e-12);
  // A hull is as good as a box, and a large ground as a small one.
  const auto ground = patch_of(box(50, 1, 50), at(0, -1, 0), hull(box_corners(0.5, 0.5, 0.5)), at(3, 0.5, 0));
  expect_points(ground, {{2.5, 0, -0.5}, {3.5, 0, -0.5}, {3.5, 0, 0.5}, {2.5, 0, 0.5}});
}

TEST(ContactPatch, AFaceTiltedALittleKeepsItsCorners) {
  const double angle = 0.2;
  const Pose tilted = turned(angle, {0, 0, 1}, {0, 0.5, 0});
  const auto patch = patch_of(box(50, 1, 50), at(0, -1, 0), box(0.5, 0.5, 0.5), tilted);
  ASSERT_EQ(patch.size(), 4u);
  const double rise = std::sin(angle * std::numbers::pi / 180);
  double low = 1, high = -1;
  for (const PatchPoint& p : patch) low = std::min(low, p.gap), high = std::max(high, p.gap);
  EXPECT_NEAR(high - low, rise, 1e-5);
  EXPECT_EQ(patch_of(box(50, 1, 50), at(0, -1, 0), box(0.5, 0.5, 0.5), turned(10, {0, 0, 1}, {0, 0.57, 0})).size(), 2u);
}

TEST(ContactPatch, RoundShapes) {
  const auto one = patch_of(sphere(0.5), at(0, 0, 0), sphere(0.5), at(0.6, 0.8, 0));
  expect_points(one, {{0.3, 0.4, 0}});
  EXPECT_NEAR(one[0].gap, 0, 1e-15);
  EXPECT_LT((one[0].normal - Vec3(0.6, 0.8, 0)).norm(), 1e-15);
  const Pose lying = turned(90, {0, 0, 1}, {0, 0.1, 0});
  expect_points(patch_of(box(5, 1, 5), at(0, -1, 0), capsule(0.1, 1), lying), {{-1, 0, 0}, {1, 0, 0}});
  expect_points(patch_of(box(5, 1, 5), at(0, -1, 0), capsule(0.1, 1),
                         turned(30, {0, 0, 1}, {0, std::cos(std::numbers::pi / 6) + 0.1, 0})),
                {{0.5, 0, 0}});
  expect_points(patch_of(capsule(0.1, 1), lying, capsule(0.1, 1), turned(90, {0, 0, 1}, {0.5, 0.3, 0})),
                {{-0.5, 0.2, 0}, {1, 0.2, 0}});
  EXPECT_EQ(patch_of(capsule(0.1, 1), lying, capsule(0.1, 1), turned(90, {1, 0, 0}, {0.5, 0.3, 0})).size(), 1u);
}

TEST(ContactPatch, NothingBeyondReach) {
  EXPECT_TRUE(patch_of(sphere(0.5), at(0, 0, 0), sphere(0.5), at(0, 1.06, 0)).empty());
  EXPECT_EQ(patch_of(sphere(0.5), at(0, 0, 0), sphere(0.5), at(0, 1.04, 0)).size(), 1u);
}

TEST(ContactPatch, ShapesWithoutPointsAreRefused) {
  EXPECT_FALSE(has_patches(*cylinder(1, 1)));
  EXPECT_FALSE(has_patches(*plane()));
  EXPECT_TRUE(has_patches(*capsule(1, 1)));
  EXPECT_THROW(patch_of(plane(), at(0, 0, 0), sphere(1), at(0, 1, 0)), Error);
}

}  // namespace
}  // namespace plumb::referee
