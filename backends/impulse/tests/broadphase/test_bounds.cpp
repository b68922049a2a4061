// The box about a shape holds it, fits it, and never parts two shapes that touch.
#include <gtest/gtest.h>

#include "geometry/shape_box.hpp"
#include "tests/rigs/narrow_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;
using enum ShapeType;

class Bounds : public ::testing::TestWithParam<ShapeType> {
 protected:
  Bounds() {
    std::vector<PlumbVec3> points;
    for (int i = 0; i < 30; ++i) {
      const V v = dice_.direction();
      points.push_back({v.x + 0.2, 0.6 * v.y, 0.8 * v.z});
    }
    pool_.add(points);
  }
  Shape shape(ShapeType type) {
    const Real x = random(), y = random();
    if (type == kSphere) return {type, 0, {x, 0, 0}, x};
    if (type == kBox) return make_box(dice_.uniform(0.1, 1), dice_.uniform(0.1, 1), dice_.uniform(0.1, 1));
    if (type == kCapsule) return {type, 0, {x, y, 0}, x + y};
    return {type, 0, {0, 0, 0}, pool_.reach(0)};
  }
  Real random() { return static_cast<Real>(dice_.uniform(0.1, 1)); }

  /// The furthest point of the shape along a unit vector, and how far that is, in double.
  double reach(const Shape& s, const Quat& q, const V& n) {
    if (s.type == kBox || s.type == kHull) return polyhedron(s, pool_.host(), q, {0, 0, 0}).high(n);
    const double along = s.type == kCapsule ? std::abs(dot(rotate(unit(q), V{0, 1, 0}), n)) : 0;
    return static_cast<double>(s.size.x) + along * static_cast<double>(s.size.y);
  }

  Dice dice_{21};
  HullPool pool_;
};

constexpr double kRounding = 20 * static_cast<double>(kEpsilon);

TEST_P(Bounds, FitTheirShapeOnEverySide) {
  const Hulls hulls = pool_.host();
  for (int i = 0; i < 500; ++i) {
    const Shape s = shape(GetParam());
    const Quat q = Dice::to_real(dice_.orientation());
    const auto expect_reach = [&](double bound, const V& n) {
      EXPECT_NEAR(bound, reach(s, q, unit(n)) * length(n), kRounding);
    };

    const Box box = shape_box(s, q, hulls);
    for (int axis = 0; axis < 3; ++axis) {
      V n = {0, 0, 0};
      n[axis] = 1;
      expect_reach(static_cast<double>(box.high[axis]), n);
      expect_reach(-static_cast<double>(box.low[axis]), -n);
    }
  }
}

TEST_P(Bounds, NeverPartShapesThatTouch) {
  const Hulls hulls = pool_.host();
  constexpr ShapeType types[] = {kSphere, kBox, kCapsule, kHull};
  int touching = 0, boxes = 0;
  for (int i = 0; i < 20000; ++i) {
    const Shape a = shape(GetParam()), b = shape(types[dice_.below(4)]);
    const Quat qa = Dice::to_real(dice_.orientation()), qb = Dice::to_real(dice_.orientation());
    const V u = dice_.uniform(0, 2.5) * dice_.direction();
    const Vec d = {static_cast<Real>(u.x), static_cast<Real>(u.y), static_cast<Real>(u.z)};
    Manifold m{};
    collide({a, b, qa, qb, d, 0}, hulls, m);
    const Box box = shape_box(b, qb, hulls);
    const bool by_box = overlap(shape_box(a, qa, hulls), Box{box.low + d, box.high + d});
    Real least = 0;
    for (std::uint32_t k = 0; k < m.count; ++k) least = min(least, m.points[k].separation);
    ASSERT_TRUE(least >= -static_cast<Real>(kRounding) || by_box);
    touching += m.count > 0 ? 1 : 0;
    boxes += by_box ? 1 : 0;
  }
  EXPECT_GT(touching, 1000);
  EXPECT_LE(touching, boxes);
}
INSTANTIATE_TEST_SUITE_P(All, Bounds, ::testing::Values(kSphere, kBox, kCapsule, kHull));

}  // namespace
}  // namespace plumb::impulse
