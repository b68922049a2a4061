// Random pairs of convex shapes against the definition of depth itself, and against rigid motions of the whole.
#include <gtest/gtest.h>

#include <cmath>

#include "referee/convex_distance.hpp"
#include "referee/expanding_polytope.hpp"
#include "referee/polytope_penetration.hpp"
#include "shapes.hpp"

namespace plumb::referee::testing {
namespace {

TEST(RandomPairs, DepthIsTheShortestWayOut) {
  Random random(1);
  int overlapping = 0;
  for (int i = 0; i < 4000; ++i) {
    const ShapePtr a = random.convex(), b = random.convex();
    const Pose pose_a = random.pose(0.5), pose_b = random.pose(0.5);
    const Penetration found = penetration(*a, pose_a, *b, pose_b);
    ASSERT_NEAR(found.normal.norm(), 1, 1e-12);
    if (found.depth <= 0) continue;
    ++overlapping;
    // The way out: along the normal the shapes overlap by just that much, and along no other direction by less.
    ASSERT_NEAR(overlap_along(*a, pose_a, *b, pose_b, found.normal), found.depth, 1e-9)
        << a->type() << ' ' << b->type();
    for (int k = 0; k < 200; ++k)
      ASSERT_GE(overlap_along(*a, pose_a, *b, pose_b, random.direction()), found.depth - 1e-9)
          << a->type() << ' ' << b->type();
    for (int k = 0; k < 50; ++k) {  // nor near the normal, where a better one would hide
      const Vec3 near = (found.normal + random.vector(1e-3)).normalized();
      ASSERT_GE(overlap_along(*a, pose_a, *b, pose_b, near), found.depth - 1e-9) << a->type() << ' ' << b->type();
    }
    // And the move works.
    Pose moved = pose_b;
    moved.position += found.depth * found.normal;
    ASSERT_NEAR(penetration(*a, pose_a, *b, moved).depth, 0, 1e-8) << a->type() << ' ' << b->type();
  }
  EXPECT_GT(overlapping, 1500);
}

TEST(RandomPairs, DistanceIsTheWidestSlab) {
  Random random(2);
  int apart = 0;
  for (int i = 0; i < 4000; ++i) {
    const ShapePtr a = random.convex(), b = random.convex();
    const Pose pose_a = random.pose(1.5), pose_b = random.pose(1.5);
    const Penetration found = penetration(*a, pose_a, *b, pose_b);
    if (found.depth >= 0) continue;
    ++apart;
    // A slab as wide as the distance lies between them, square to the normal; no slab is wider.
    ASSERT_NEAR(overlap_along(*a, pose_a, *b, pose_b, found.normal), found.depth, 1e-8)
        << a->type() << ' ' << b->type();
    for (int k = 0; k < 200; ++k)
      ASSERT_GE(overlap_along(*a, pose_a, *b, pose_b, random.direction()), found.depth - 1e-9);
    const Penetration bound = penetration(*a, pose_a, *b, pose_b, Apart::lower_bound);
    ASSERT_LT(bound.depth, 0);
    ASSERT_GE(bound.depth, found.depth - 1e-9);
    ASSERT_NEAR(overlap_along(*a, pose_a, *b, pose_b, bound.normal), bound.depth, 1e-7);
  }
  EXPECT_GT(apart, 1500);
}

TEST(RandomPairs, NothingChangesUnderRigidMotionOrExchange) {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    const ShapePtr a = random.convex(), b = random.convex();
    const Pose pose_a = random.pose(0.8), pose_b = random.pose(0.8), motion = random.pose(1000);
    const Penetration found = penetration(*a, pose_a, *b, pose_b);
    const Penetration swapped = penetration(*b, pose_b, *a, pose_a);
    const Penetration moved = penetration(*a, motion * pose_a, *b, motion * pose_b);
    ASSERT_NEAR(swapped.depth, found.depth, 1e-8);
    ASSERT_NEAR(moved.depth, found.depth, 1e-8);
  }
}

// The 15 axes, the Gauss map and the expanding polytope are three ways to one depth.
TEST(RandomPairs, ThreeWaysAgreeOnBoxes) {
  Random random(4);
  int overlapping = 0;
  for (int i = 0; i < 20000; ++i) {
    const ShapePtr a = random.box(), b = random.box();
    const Pose pose_b = random.pose(0.9);
    const Penetration axes = box_penetration(a->half_extents(), b->half_extents(), pose_b);
    const Penetration mapped = polytope_penetration(a->core(), b->core(), pose_b);
    ASSERT_NEAR(axes.depth, mapped.depth, 1e-11);
    if (axes.depth <= 1e-6) continue;
    ++overlapping;
    const Penetration grown = expanding_polytope({a.get(), nullptr, Pose{}}, {b.get(), nullptr, pose_b});
    ASSERT_NEAR(axes.depth, grown.depth, 1e-9);
    ASSERT_EQ(convex_distance({a.get(), nullptr, Pose{}}, {b.get(), nullptr, pose_b}).distance, 0);
  }
  EXPECT_GT(overlapping, 5000);
}

TEST(RandomPairs, GaussMapFindsWhatTheExpandingPolytopeFinds) {
  Random random(5);
  int overlapping = 0;
  for (int i = 0; i < 2000; ++i) {
    const ShapePtr a = random.hull(), b = random.hull();
    const Pose pose_b = random.pose(0.7);
    const Penetration mapped = polytope_penetration(a->core(), b->core(), pose_b);
    const double distance = convex_distance({a.get(), nullptr, Pose{}}, {b.get(), nullptr, pose_b}).distance;
    if (mapped.depth > 1e-6) {
      ++overlapping;
      ASSERT_EQ(distance, 0);
      ASSERT_NEAR(mapped.depth, expanding_polytope({a.get(), nullptr, Pose{}}, {b.get(), nullptr, pose_b}).depth, 1e-9);
    } else if (mapped.depth < -1e-6) {
      ASSERT_GE(distance, -mapped.depth - 1e-9);
    }
  }
  EXPECT_GT(overlapping, 500);
}

// Far from the origin only the subtraction of positions loses digits.
TEST(RandomPairs, FarFromTheOrigin) {
  const ShapePtr a = box(0.5, 0.5, 0.5), b = box(0.5, 0.5, 0.5);
  EXPECT_NEAR(penetration(*a, at(1e5, 1e5, 0), *b, at(1e5, 1e5 + 0.99, 0)).depth, 0.01, 2e-11);
}

}  // namespace
}  // namespace plumb::referee::testing
