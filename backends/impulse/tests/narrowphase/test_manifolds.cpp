// What must not change: manifolds of turned, scaled and swapped pairs, and the ids of a contact that trembles.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "tests/rigs/narrow_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;
using enum ShapeType;

constexpr ShapeType kTypes[] = {kSphere, kBox, kCapsule, kHull};

struct PosedPair {
  Shape a, b;
  Quat qa, qb;
  Vec d;
};

/// A pool with one lumpy hull, and shapes of every type, all `scale` times as large as at 1.
class Shapes {
 public:
  explicit Shapes(double scale) : scale_(scale) {
    Dice dice(99);
    std::vector<PlumbVec3> points;
    for (int i = 0; i < 40; ++i) {
      const V v = dice.direction();
      points.push_back({scale * v.x, 0.7 * scale * v.y, 0.8 * scale * v.z});
    }
    pool_.add(points);
  }
  Hulls hulls() { return pool_.host(); }
  [[nodiscard]] Shape of(ShapeType type) const {
    const Real s = static_cast<Real>(scale_);
    if (type == kSphere) return {type, 0, {Real(0.75) * s, 0, 0}, Real(0.75) * s};
    if (type == kBox) return make_box(0.5 * scale_, 0.75 * scale_, scale_);
    if (type == kCapsule) return {type, 0, {Real(0.5) * s, s, 0}, Real(1.5) * s};
    return {type, 0, {0, 0, 0}, pool_.reach(0)};
  }

 private:
  double scale_;
  HullPool pool_;
};

Manifold manifold_of(const PosedPair& p, Real margin, const Hulls& hulls) {
  Manifold m{};
  collide({p.a, p.b, p.qa, p.qb, p.d, margin}, hulls, m);
  return m;
}
PosedPair random_pair(Dice& dice, const Shapes& shapes, ShapeType a, ShapeType b) {
  const V d = dice.uniform(0.3, 2) * dice.direction();
  return {shapes.of(a),
          shapes.of(b),
          Dice::to_real(dice.orientation()),
          Dice::to_real(dice.orientation()),
          {static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z)}};
}
Real least(const Manifold& m) {
  Real s = kHuge;
  for (std::uint32_t i = 0; i < m.count; ++i) s = min(s, m.points[i].separation);
  return s;
}
std::multiset<std::uint32_t> features(const Manifold& m) {
  std::multiset<std::uint32_t> f;
  for (std::uint32_t i = 0; i < m.count; ++i) f.insert(m.points[i].feature);
  return f;
}

TEST(Manifolds, ScalingByAPowerOfTwoScalesEveryBit) {
  Shapes at_one(1), tiny(0x1p-10), huge(0x1p10);
  Dice dice(5);
  for (const ShapeType a : kTypes)
    for (const ShapeType b : kTypes)
      for (int i = 0; i < 200; ++i) {
        const PosedPair p = random_pair(dice, at_one, a, b);
        const Manifold m = manifold_of(p, Real(0.125), at_one.hulls());
        for (const auto& [shapes, scale] : {std::pair{&tiny, Real(0x1p-10)}, std::pair{&huge, Real(0x1p10)}}) {
          const Manifold s =
              manifold_of({shapes->of(a), shapes->of(b), p.qa, p.qb, scale * p.d}, scale / 8, shapes->hulls());
          ASSERT_EQ(s.count, m.count);
          for (std::uint32_t k = 0; k < m.count; ++k) {
            ASSERT_EQ(s.normal, m.normal);
            ASSERT_EQ(s.points[k].separation, scale * m.points[k].separation);
            ASSERT_EQ(s.points[k].position, scale * m.points[k].position);
            ASSERT_EQ(s.points[k].feature, m.points[k].feature);
          }
        }
      }
}

TEST(Manifolds, OfSwappedShapesMirrorEachOther) {
  Shapes shapes(1);
  Dice dice(6);
  int touching = 0, same_points = 0;
  for (const ShapeType a : kTypes)
    for (const ShapeType b : kTypes)
      for (int i = 0; i < 300; ++i) {
        const PosedPair p = random_pair(dice, shapes, a, b);
        const Manifold m = manifold_of(p, 0, shapes.hulls());
        const Manifold s = manifold_of({p.b, p.a, p.qb, p.qa, -p.d}, 0, shapes.hulls());
        ASSERT_EQ(m.count > 0, s.count > 0);
        if (m.count == 0) continue;
        ++touching;
        ASSERT_NEAR(least(m), least(s), 200 * kEpsilon);
        ASSERT_NEAR(length(m.normal + s.normal), 0, std::sqrt(kEpsilon)) << i;
        std::multiset<std::uint32_t> swapped;
        for (const std::uint32_t f : features(s)) swapped.insert(swapped_feature(f));
        same_points += swapped == features(m) ? 1 : 0;
      }
  EXPECT_GT(touching, 1000);
  EXPECT_GT(same_points, 0.9 * touching);  // of more than four points another four may be kept
}

TEST(Manifolds, TurnWithTheWorld) {
  Shapes shapes(1);
  Dice dice(7);
  for (const ShapeType a : kTypes)
    for (const ShapeType b : kTypes)
      for (int i = 0; i < 300; ++i) {
        const PosedPair p = random_pair(dice, shapes, a, b);
        const Quat q = Dice::to_real(dice.orientation());
        const Manifold m = manifold_of(p, 0, shapes.hulls());
        const Manifold t = manifold_of({p.a, p.b, q * p.qa, q * p.qb, rotate(q, p.d)}, 0, shapes.hulls());
        if (m.count == 0 || t.count == 0) {
          ASSERT_GT(std::max(m.count == 0 ? Real(0) : least(m), t.count == 0 ? Real(0) : least(t)), -200 * kEpsilon);
          continue;
        }
        ASSERT_NEAR(least(m), least(t), 200 * kEpsilon);
        ASSERT_NEAR(length(rotate(q, m.normal) - t.normal), 0, std::sqrt(kEpsilon));
        for (std::uint32_t k = 0; k < m.count; ++k)
          for (std::uint32_t j = 0; j < t.count; ++j) {
            if (m.points[k].feature != t.points[j].feature || m.count != t.count) continue;
            ASSERT_NEAR(length(rotate(q, m.points[k].position) - t.points[j].position), 0, std::sqrt(kEpsilon));
          }
      }
}

/// A box that lies on another one: the ids must not depend on motions far below what anybody sees.
TEST(Manifolds, KeepTheirIdsWhileARestingBoxTrembles) {
  HullPool pool;
  const auto cube_hull = [&](double half) {
    std::vector<PlumbVec3> corners;
    for (int i = 0; i < 8; ++i)
      corners.push_back({(i & 1) != 0 ? half : -half, (i & 2) != 0 ? 0.5 : -0.5, (i & 4) != 0 ? half : -half});
    const std::uint32_t row = pool.add(corners);
    return Shape{kHull, row, {0, 0, 0}, pool.reach(row)};
  };
  const Shape box = make_box(0.5, 0.5, 0.5), wide = make_box(5, 0.5, 5), hull = cube_hull(0.5),
              wide_hull = cube_hull(5);
  const std::pair<Shape, Shape> pairs[] = {{box, box},  {wide, box}, {box, wide},       {hull, hull},
                                           {box, hull}, {hull, box}, {wide_hull, hull}, {wide, hull}};
  Dice dice(8);
  for (const auto& [below, above] : pairs)
    for (const double yaw : {0.0, 0.5, 0.7853981633974483}) {
      const auto turn = Dice::turn({0, 1, 0}, yaw);
      std::multiset<std::uint32_t> first;
      for (int step = 0; step < 500; ++step) {
        const V jitter = 1e-6 * dice.direction();
        const Quat q = Dice::to_real(turn * Dice::turn(dice.direction(), 1e-6));
        const Vec d = {static_cast<Real>(jitter.x), static_cast<Real>(1 + jitter.y), static_cast<Real>(jitter.z)};
        const Manifold m = manifold_of({below, above, {0, 0, 0, 1}, q, d}, Real(0.01), pool.host());
        ASSERT_EQ(m.count, 4U);
        ASSERT_EQ(features(m).count(m.points[0].feature), 1U) << "ids of one manifold differ";
        if (step == 0) first = features(m);
        ASSERT_EQ(features(m), first) << "types " << static_cast<int>(below.type) << ", "
                                      << static_cast<int>(above.type) << ", yaw " << yaw << ", step " << step;
      }
    }
}

}  // namespace
}  // namespace plumb::impulse
