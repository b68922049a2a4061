// Lines against single shapes: the ends of the part within lie on the surface, and a line that is said to miss does.
#include "queries/line_shapes.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/rigs/convex_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;

/// Outside of the shape it is positive, inside negative, and a convex function everywhere.
double outside(const Shape& shape, const Hulls& hulls, const V& p) {
  const V size = to_double(shape.size);
  switch (shape.type) {
    case ShapeType::kSphere: return length(p) - size.x;
    case ShapeType::kCapsule: return distance(p, std::pair{V{0, -size.y, 0}, V{0, size.y, 0}}) - size.x;
    case ShapeType::kBox: return std::max({std::abs(p.x) - size.x, std::abs(p.y) - size.y, std::abs(p.z) - size.z});
    case ShapeType::kHull: return polyhedron(shape, hulls, {0, 0, 0, 1}, {0, 0, 0}).outside(p);
    case ShapeType::kCylinder: return std::max(std::hypot(p.x, p.z) - size.x, std::abs(p.y) - size.y);
    default: break;
  }
  return 0;
}
/// The furthest that the shape reaches along n.
double furthest(const Shape& shape, const Hulls& hulls, const V& n) {
  if (shape.type != ShapeType::kCylinder) return high(features_of(shape, hulls, {0, 0, 0, 1}, {0, 0, 0}), n);
  const V size = to_double(shape.size);
  return size.x * std::hypot(n.x, n.z) + size.y * std::abs(n.y);
}
Shape any_shape(Dice& dice, HullPool& pool, double scale) {
  if (dice.below(5) != 0) return random_shape(dice, pool, scale);
  const auto radius = static_cast<Real>(scale * dice.uniform(0.1, 1)),
             half = static_cast<Real>(scale * dice.uniform(0.1, 1));
  return {ShapeType::kCylinder, 0, {radius, half, 0}, sqrt(radius * radius + half * half)};
}

double least_outside(const Shape& shape, const Hulls& hulls, const V& p, const V& d) {
  const auto at = [&](double s) { return outside(shape, hulls, p + s * d); };
  const double middle = -dot(p, d), reach = 2 * static_cast<double>(shape.reach);
  double low = middle - reach, high = middle + reach;
  for (int i = 0; i < 100; ++i) {
    const double l = low + (high - low) / 3, h = high - (high - low) / 3;
    (at(l) < at(h) ? high : low) = at(l) < at(h) ? h : l;
  }
  return at(low);
}

TEST(LineShapes, AreEnteredAndLeftOnTheirSurface) {
  Dice dice(17);
  HullPool pool;
  int hits = 0, misses = 0;
  for (int i = 0; i < 3000; ++i) {
    const Shape shape = any_shape(dice, pool, i % 2 == 0 ? 1 : 1e-2);
    const Hulls hulls = pool.host();
    const double reach = static_cast<double>(shape.reach);
    V d = dice.direction();
    if (dice.below(3) == 0) {  // along an axis, or nearly
      d = {0, 0, 0};
      d[static_cast<int>(dice.below(3))] = dice.below(2) == 0 ? -1 : 1;
      if (dice.below(2) == 0) d = unit(d + dice.log_uniform(1e-12, 1e-2) * dice.direction());
    }
    const V through = dice.uniform(0, 1.1) * reach * dice.direction();
    const double away = i % 5 == 0 ? 1e5 : 3 * reach;
    const V p = through - away * d;
    const double near = 1e-12 * (reach + away), least = least_outside(shape, hulls, p, d);
    LinePart part{};
    const bool hit = cross_convex<true>(shape, hulls, p, d, part);
    if (!hit) {
      EXPECT_GT(least, -1e-7 * reach - near) << i;
      ++misses;
      continue;
    }
    ++hits;
    const double flat = 1e-6 * reach + near;  // the faces of hulls are floats
    EXPECT_LE(least, flat) << i;
    EXPECT_LE(part.enter, part.leave);
    EXPECT_NEAR(outside(shape, hulls, p + part.enter * d), 0, shape.type == ShapeType::kHull ? flat : 2 * near) << i;
    EXPECT_NEAR(outside(shape, hulls, p + part.leave * d), 0, shape.type == ShapeType::kHull ? flat : 2 * near) << i;
    EXPECT_NEAR(length(part.normal), 1, 1e-6) << i;
    EXPECT_LE(dot(part.normal, d), 1e-6) << i;
    EXPECT_NEAR(dot(part.normal, p + part.enter * d), furthest(shape, hulls, part.normal), flat) << i;
  }
  EXPECT_GT(hits, 1000);
  EXPECT_GT(misses, 400);
}

TEST(LineShapes, ThatAreOnlyTouchedAreCrossed) {
  LinePart part{};
  const Shape box = make_box(1, 2, 3), ball = {ShapeType::kSphere, 0, {1, 0, 0}, 1},
              capsule = {ShapeType::kCapsule, 0, {1, 2, 0}, 3};
  EXPECT_TRUE(cross_convex<true>(box, {}, {1, -9, 0}, {0, 1, 0}, part)) << "within a face";
  EXPECT_DOUBLE_EQ(part.enter, 7);
  EXPECT_TRUE(cross_convex<true>(box, {}, {1, -9, 3}, {0, 1, 0}, part)) << "along an edge";
  EXPECT_FALSE(cross_convex<true>(box, {}, {std::nextafter(1.0, 2.0), -9, 0}, {0, 1, 0}, part));
  EXPECT_TRUE(cross_convex<true>(ball, {}, {1, -9, 0}, {0, 1, 0}, part));
  EXPECT_DOUBLE_EQ(part.enter, 9);
  EXPECT_FALSE(cross_convex<true>(ball, {}, {std::nextafter(1.0, 2.0), -9, 0}, {0, 1, 0}, part));
  EXPECT_TRUE(cross_convex<true>(capsule, {}, {1, -9, 0}, {0, 1, 0}, part)) << "along the side";
  EXPECT_DOUBLE_EQ(part.enter, 7);
  EXPECT_TRUE(cross_convex<true>(capsule, {}, {0, -9, 0}, {0, 1, 0}, part)) << "through both ends";
  EXPECT_DOUBLE_EQ(part.enter, 6);
  EXPECT_DOUBLE_EQ(part.leave, 12);
}

}  // namespace
}  // namespace plumb::impulse
