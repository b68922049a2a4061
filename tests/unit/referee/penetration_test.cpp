// Overlaps whose answer is known in closed form, among them the static cases of the catalogue (B9).
#include "referee/penetration.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "shapes.hpp"

namespace plumb::referee::testing {
namespace {

void expect_vector(const Vec3& value, const Vec3& truth, double tolerance = 1e-12) {
  EXPECT_LE((value - truth).norm(), tolerance) << value.transpose() << " instead of " << truth.transpose();
}

TEST(Penetration, CrossingEdges) {
  const ShapePtr cube = box(0.5, 0.5, 0.5);
  const Pose a = turned(45, Vec3::UnitZ()), b = turned(45, Vec3::UnitX(), {0, 1.40, 0});
  const Penetration found = penetration(*cube, a, *cube, b);
  EXPECT_NEAR(found.depth, std::sqrt(2) - 1.40, 1e-12);  // .01421356
  expect_vector(found.normal, {0, 1, 0}, 1e-9);
  expect_vector(found.point, {0, 0.70, 0}, 1e-9);
}

TEST(Penetration, FaceOnFace) {
  const ShapePtr cube = box(0.5, 0.5, 0.5);
  const Penetration found = penetration(*cube, at(0, 0, 0), *cube, at(0, 0.99, 0));
  EXPECT_NEAR(found.depth, 0.01, 1e-15);
  expect_vector(found.normal, {0, 1, 0});
  expect_vector(found.point, {0, 0.495, 0});
}

TEST(Penetration, ParallelEdges) {  // edges side by side: the face of the one that is not turned wins
  const ShapePtr cube = box(0.5, 0.5, 0.5);
  const double reach = 0.5 + std::sqrt(0.5);
  const Penetration found = penetration(*cube, at(0, 0, 0), *cube, turned(45, Vec3::UnitZ(), {0, reach - 0.02, 0}));
  EXPECT_NEAR(found.depth, 0.02, 1e-12);
  expect_vector(found.normal, {0, 1, 0}, 1e-9);
  expect_vector(found.point, {0, 0.49, 0}, 1e-9);
}

TEST(Penetration, CubeOnItsDiagonalTouchesThePlane) {
  const ShapePtr cube = box(0.5, 0.5, 0.5), ground = plane();
  const Quat upright = Quat::FromTwoVectors(Vec3(1, 1, 1), Vec3::UnitY());
  const Pose pose{upright.toRotationMatrix(), {0, std::sqrt(3) / 2, 0}};  // .86602540
  EXPECT_NEAR(penetration(*ground, at(0, 0, 0), *cube, pose).depth, 0, 1e-15);
  const ShapePtr slab = box(5, 0.5, 5);
  EXPECT_NEAR(penetration(*slab, at(0, -0.5, 0), *cube, pose).depth, 0, 1e-12);
}

TEST(Penetration, SphereOnBoxEdgeAndCorner) {  // B8
  const ShapePtr ball = sphere(0.5), cube = box(1, 1, 1);
  const Penetration edge =
      penetration(*cube, at(0, 0, 0), *ball, at(1.25, 1 + 0.5 * std::cos(std::numbers::pi / 6), 0));
  EXPECT_NEAR(edge.depth, 0, 1e-15);
  expect_vector(edge.normal, {0.5, std::sqrt(0.75), 0});
  const double up = std::sqrt(0.25 - 0.08);
  const Penetration corner = penetration(*ball, at(1.2, 1 + up, 1.2), *cube, at(0, 0, 0));
  EXPECT_NEAR(corner.depth, 0, 1e-15);
  expect_vector(corner.normal, {-0.4, -2 * up, -0.4});
}

TEST(Penetration, SphereInsideBoxLeavesByTheNearestFace) {
  const Penetration found = penetration(*box(1, 2, 3), at(0, 0, 0), *sphere(0.25), at(-0.75, 0.5, 1));
  EXPECT_NEAR(found.depth, 0.25 + 0.25, 1e-15);
  expect_vector(found.normal, {-1, 0, 0});
}

TEST(Penetration, RoundedPairs) {
  const ShapePtr bar = capsule(0.25, 1), ball = sphere(0.5);
  EXPECT_NEAR(penetration(*bar, at(0, 0, 0), *ball, at(0.6, 0.7, 0)).depth, 0.15, 1e-15);
  EXPECT_NEAR(penetration(*bar, at(0, 0, 0), *ball, at(0, 2, 0)).depth, -0.25, 1e-15);
  const Penetration crossed = penetration(*bar, at(0, 0, 0), *bar, turned(90, Vec3::UnitX(), {0.1, 0, 0}));
  EXPECT_NEAR(crossed.depth, 0.4, 1e-15);
  expect_vector(crossed.normal, {1, 0, 0});
  const Penetration same = penetration(*bar, at(0, 0, 0), *bar, turned(90, Vec3::UnitX()));  // axes cross
  EXPECT_NEAR(same.depth, 0.5, 1e-15);
  EXPECT_NEAR(std::abs(same.normal.x()), 1, 1e-15);
}

TEST(Penetration, CapsuleThroughBox) {  // the axis cuts the box: depth counts the axis' own and the radius
  const Penetration found =
      penetration(*box(1, 1, 1), at(0, 0, 0), *capsule(0.2, 3), turned(90, Vec3::UnitX(), {0, 0.9, 0}));
  EXPECT_NEAR(found.depth, 0.1 + 0.2, 1e-12);
  expect_vector(found.normal, {0, 1, 0}, 1e-9);
}

TEST(Penetration, Cylinders) {
  const ShapePtr can = cylinder(0.5, 1);
  EXPECT_NEAR(penetration(*can, at(0, 0, 0), *can, at(0, 1.9, 0)).depth, 0.1, 1e-9);  // end on end
  EXPECT_NEAR(penetration(*can, at(0, 0, 0), *can, at(0.6, 0, 0.6)).depth, 1 - std::hypot(0.6, 0.6),
              1e-9);  // side by side
  EXPECT_NEAR(penetration(*can, at(0, 0, 0), *can, turned(90, Vec3::UnitX(), {0.95, 0, 0})).depth, 0.05, 1e-9);
  EXPECT_NEAR(penetration(*can, at(0, 0, 0), *box(1, 1, 1), at(1.4, 0, 0)).depth, 0.1, 1e-9);
  EXPECT_NEAR(penetration(*can, at(0, 0, 0), *sphere(0.5), at(0.8, 1.4, 0)).depth, 0, 1e-15);  // 3 4 5 off the rim
  EXPECT_NEAR(penetration(*plane(), at(0, 0, 0), *can, turned(30, Vec3::UnitZ(), {0, 1, 0})).depth,
              std::cos(std::numbers::pi / 6) + 0.25 - 1, 1e-12);
}

TEST(Penetration, PlaneTakesEveryConvexShape) {
  const ShapePtr ground = plane();
  EXPECT_NEAR(penetration(*ground, at(0, 0, 0), *sphere(0.5), at(7, 0.4, 0)).depth, 0.1, 1e-15);
  EXPECT_NEAR(penetration(*ground, at(0, 0, 0), *capsule(0.25, 1), turned(90, Vec3::UnitX(), {0, 0.2, 0})).depth, 0.05,
              1e-15);
  const Penetration swapped = penetration(*hull(box_corners(1, 1, 1)), at(0, 0.9, 0), *ground, at(0, 0, 0));
  EXPECT_NEAR(swapped.depth, 0.1, 1e-15);
  expect_vector(swapped.normal, {0, -1, 0});
  // Tilted: 30 degrees about z.
  const Penetration tilted = penetration(*ground, turned(30, Vec3::UnitZ()), *sphere(1), at(0, 1, 0));
  EXPECT_NEAR(tilted.depth, 1 - std::cos(std::numbers::pi / 6), 1e-15);
  expect_vector(tilted.normal, {-0.5, std::sqrt(0.75), 0});
}

TEST(Penetration, CompoundIsItsDeepestChild) {
  const ShapePtr ball = sphere(0.5);
  PlumbCompoundChild children[2] = {};
  children[0].pose = {{-1, 0, 0}, {0, 0, 0, 1}};
  children[1].pose = {{1, 0, 0}, {0, 0, 0, 1}};
  PlumbShapeDesc desc = shape_desc(PLUMB_COMPOUND);
  desc.children = children;
  desc.child_count = 2;
  const ShapePtr parts[2] = {ball, sphere(0.75)};
  const ShapePtr dumbbell = Shape::make(desc, parts);
  EXPECT_NEAR(penetration(*dumbbell, at(0, 1, 0), *plane(), at(0, 0.4, 0)).depth, 0.15, 1e-15);
  EXPECT_NEAR(
      penetration(*dumbbell, turned(90, Vec3::UnitY()), *dumbbell, turned(90, Vec3::UnitY(), {1.4, 0, 0})).depth, 0.1,
      1e-12);
  EXPECT_THROW(Shape::make(desc), Error);
}

TEST(Penetration, WhatCannotTouch) {
  EXPECT_EQ(penetration(*plane(), at(0, 0, 0), *plane(), at(0, 1, 0)).depth, -std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace plumb::referee::testing
