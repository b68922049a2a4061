// Cylinders against all convex shapes: the gap along the normal in double, the greatest gap over all directions, and
// the same pair the other way round and turned as a whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/rigs/support_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;
using enum ShapeType;

Shape make_cylinder(double radius, double half) {
  return {kCylinder,
          0,
          {static_cast<Real>(radius), static_cast<Real>(half), 0},
          static_cast<Real>(std::hypot(radius, half))};
}
Shape any_shape(Dice& dice, ShapeType type, HullPool& pool) {
  const auto length = [&] { return dice.below(6) == 0 ? dice.uniform(0.03, 0.2) : dice.uniform(0.2, 1); };
  if (type == kCylinder) return make_cylinder(length(), length());
  if (type == kSphere || type == kCapsule) {
    const auto r = static_cast<Real>(length()), h = static_cast<Real>(length());
    return type == kSphere ? Shape{type, 0, {r, 0, 0}, r} : Shape{type, 0, {r, h, 0}, r + h};
  }
  return type == kBox ? random_box(dice, 1) : random_hull(dice, pool, 1, 20);
}

double least_separation(const Manifold& m) {
  double least = 1e300;
  for (std::uint32_t i = 0; i < m.count; ++i) least = std::min(least, static_cast<double>(m.points[i].separation));
  return least;
}

class Cylinders : public ::testing::TestWithParam<ShapeType> {};

TEST_P(Cylinders, AreApartByTheGreatestGap) {
  const ShapeType type = GetParam();
  Dice dice(31 + static_cast<std::uint32_t>(type));
  int touching = 0, apart = 0;
  for (int i = 0; i < 1500 && !HasFailure(); ++i) {
    HullPool pool;
    const Shape a = any_shape(dice, type, pool), b = any_shape(dice, kCylinder, pool);
    const Hulls hulls = pool.host();
    auto qa = dice.orientation(), qb = dice.orientation();
    if (dice.below(3) == 0) {  // lying on each other, or nearly
      qb = qa;
      if (dice.below(2) == 0) qb = qb * Dice::turn({0, 0, 1}, 1.5707963267948966);
      if (dice.below(2) == 0) qb = qb * Dice::turn(dice.direction(), dice.log_uniform(1e-6, 0.2));
    }
    const Quat ra = Dice::to_real(qa), rb = Dice::to_real(qb);
    Solid solid_a = {a, &hulls, unit(ra), {0, 0, 0}}, solid_b = {b, &hulls, unit(rb), {0, 0, 0}};
    // Placed so that along some direction the gap is small.
    const V way = dice.below(2) == 0 ? dice.direction() : rotate(qa, V{0, 1, 0});
    const double size = static_cast<double>(min(a.reach, b.reach));
    const double wanted = (dice.below(2) == 0 ? -1 : 1) * dice.log_uniform(1e-4, 0.1) * size;
    const V aside = dice.uniform(0, 0.7) * size * dice.direction();
    const V d = (solid_a.high(way) + solid_b.high(-way) + wanted) * way + (aside - dot(aside, way) * way);
    const Vec rd = {static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z)};
    solid_b.at = to_double(rd);
    const double best = greatest_over_directions([&](const V& n) { return gap(solid_a, solid_b, n); }, dice);
    const Real margin = static_cast<Real>(0.3 * size);
    Manifold m{};
    const bool touch = collide({a, b, ra, rb, rd, margin}, hulls, m);
    SCOPED_TRACE("trial " + std::to_string(i) + " gap " + std::to_string(best) + " size " + std::to_string(size));
    const double tolerance = 2e-4 * size;
    if (best > static_cast<double>(margin) + tolerance) {
      EXPECT_FALSE(touch);
      continue;
    }
    if (!touch) {
      EXPECT_GT(best, static_cast<double>(margin) - tolerance);
      continue;
    }
    best < 0 ? ++touching : ++apart;
    const V n = to_double(m.normal);
    EXPECT_NEAR(length(n), 1, 1e-5);
    const double least = least_separation(m);
    EXPECT_GE(gap(solid_a, solid_b, n), best - 10 * tolerance) << "the normal separates as much as any";
    EXPECT_NEAR(least, gap(solid_a, solid_b, n), 10 * tolerance);
    for (std::uint32_t k = 0; k < m.count;
         ++k) {  // midway between the surfaces, so within neither by more than the gap
      const V p = to_double(m.points[k].position);
      const double s = static_cast<double>(m.points[k].separation);
      EXPECT_LE(dot(n, p) - 0.5 * s - solid_a.high(n), 10 * tolerance);
      EXPECT_LE(-(dot(n, p) + 0.5 * s) - solid_b.high(-n), 10 * tolerance);
    }
    Manifold back{};
    EXPECT_TRUE(collide({b, a, rb, ra, -rd, margin}, hulls, back));
    EXPECT_NEAR(least_separation(back), least, 10 * tolerance);
    const auto turn = dice.orientation();
    const V turned = rotate(turn, to_double(rd));
    Manifold whole{};
    EXPECT_TRUE(collide({a,
                         b,
                         Dice::to_real(turn * qa),
                         Dice::to_real(turn * qb),
                         {static_cast<Real>(turned.x), static_cast<Real>(turned.y), static_cast<Real>(turned.z)},
                         margin},
                        hulls, whole));
    EXPECT_NEAR(least_separation(whole), least, 10 * tolerance);
  }
  EXPECT_GT(touching, 60);
  EXPECT_GT(apart, 60);
}
INSTANTIATE_TEST_SUITE_P(All, Cylinders, ::testing::Values(kSphere, kBox, kCapsule, kHull, kCylinder));

/// To come out of a cylinder a capsule has to go at least as far as the point of its segment that is deepest within.
TEST(CylinderDepths, OfCapsulesThatRunThroughAreAtLeastThoseOfTheirPoints) {
  Dice dice(5);
  int through = 0;
  for (int i = 0; i < 40000; ++i) {
    const double radius = dice.uniform(0.2, 1), half = dice.uniform(0.2, 1), around = dice.uniform(0.05, 0.4),
                 length_of_half = dice.uniform(0.1, 1);
    const auto turn = dice.orientation();
    const Quat lies = Dice::to_real(turn);
    // Its middle near the rim, where it cuts off little.
    const V to_rim = {radius, half, 0}, at = to_rim + dice.uniform(0, 0.7) * dice.direction();
    const Vec place = {static_cast<Real>(at.x), static_cast<Real>(at.y), static_cast<Real>(at.z)};
    const V along = rotate(unit(lies), V{0, length_of_half, 0});
    double deepest = 0;
    for (int k = -200; k <= 200; ++k) {
      const V p = to_double(place) + (k / 200.0) * along;
      deepest = std::max(deepest, std::min(radius - std::hypot(p.x, p.z), half - std::abs(p.y)));
    }
    if (deepest < 1e-5) continue;
    ++through;
    const Shape capsule = {kCapsule,
                           0,
                           {static_cast<Real>(around), static_cast<Real>(length_of_half), 0},
                           static_cast<Real>(around + length_of_half)};
    Manifold m{};
    ASSERT_TRUE(collide({make_cylinder(radius, half), capsule, {0, 0, 0, 1}, lies, place, Real(0.01)}, {}, m));
    ASSERT_LE(least_separation(m), -around - deepest + 1e-5) << "trial " << i;
  }
  EXPECT_GT(through, 5000);
}

constexpr Quat kUpright = {0, 0, 0, 1};
const Quat kLying = Dice::to_real(Dice::turn({0, 0, 1}, 1.5707963267948966));

// An edge is left out where the gap along all directions between its faces' normals is widest at one of the two.
TEST(CylinderEdges, AreLeftOutOnlyWhereAFaceDecides) {
  Dice dice(77);
  int left_out = 0;
  for (int i = 0; i < 20000; ++i) {
    const double radius = dice.uniform(0.02, 1), half = dice.uniform(0.02, 1), angle = dice.uniform(0.05, 1.5707963);
    const V from = dice.direction(), across = dice.direction();
    const double along = dot(across, from);
    const V side = (1 / length(across - along * from)) * (across - along * from);
    const V to = std::cos(angle) * from + std::sin(angle) * side;
    const double reach = std::hypot(radius, half);
    const V v = dice.uniform(0, 8) * reach * dice.direction();
    const auto real = [](const V& u) {
      return Vec{static_cast<Real>(u.x), static_cast<Real>(u.y), static_cast<Real>(u.z)};
    };
    const cylinder::Cylinder c = {static_cast<Real>(radius), static_cast<Real>(half)};
    if (!cylinder::narrows_from(c, real(v), real(from), real(to))) continue;
    ++left_out;
    const auto gap = [&](double turn) {
      const V n = std::cos(turn) * from + std::sin(turn) * side;
      return dot(n, v) - half * std::abs(n.y) - radius * std::hypot(n.x, n.z);
    };
    for (int k = 1; k <= 64; ++k) ASSERT_LE(gap(angle * k / 64), gap(0) + 1e-12 * reach) << i;
  }
  EXPECT_GT(left_out, 500);
}

TEST(CylinderPoints, StandingOnABoxAreFourOfTheRim) {
  Manifold m{};
  ASSERT_TRUE(
      collide({make_box(2, 1, 2), make_cylinder(0.5, 0.7), kUpright, kUpright, {0.1F, 1.7F, 0}, Real(0.01)}, {}, m));
  ASSERT_EQ(m.count, 4U);
  EXPECT_NEAR(m.normal.y, 1, 1e-6);
  for (const ManifoldPoint& p : m.points) {
    EXPECT_NEAR(p.separation, 0, 1e-6);
    EXPECT_NEAR(std::hypot(p.position.x - Real(0.1), p.position.z), 0.5, 1e-5);
    EXPECT_NEAR(p.position.y, 1, 1e-5);
  }
}
TEST(CylinderPoints, OverTheRimOfABoxStayOnIt) {
  Manifold m{};
  ASSERT_TRUE(collide(
      {make_box(1, 1, 1), make_cylinder(0.5, 0.5), kUpright, kUpright, {Real(0.8), Real(1.5), 0}, Real(0.01)}, {}, m));
  ASSERT_GE(m.count, 3U);
  for (std::uint32_t i = 0; i < m.count; ++i) EXPECT_LE(m.points[i].position.x, 1.001);
}
TEST(CylinderPoints, LyingOnABoxAreTheEndsOfALine) {
  Manifold m{};
  ASSERT_TRUE(
      collide({make_box(2, 1, 2), make_cylinder(0.5, 0.7), kUpright, kLying, {0, Real(1.5), 0}, Real(0.01)}, {}, m));
  ASSERT_EQ(m.count, 2U);
  EXPECT_NEAR(std::abs(m.points[0].position.x), 0.7, 1e-5);
  EXPECT_NEAR(m.points[0].position.x, -m.points[1].position.x, 1e-5);
  EXPECT_NE(m.points[0].feature, m.points[1].feature);
}
/// Its line ends beside the face, by so little that across the face's normal the two overlap as much as anywhere.
TEST(CylinderPoints, LyingBesideAFaceMeetsTheNearestSide) {
  for (double angle = 0.1; angle < 3.1; angle += 0.1)
    for (const double beside : {1e-5, 1e-4, 1e-3}) {
      const auto turn = Dice::turn({0, 1, 0}, angle) * Dice::turn({0, 0, 1}, 1.5707963267948966);
      const double end = 0.1 * std::sin(angle);  // of the line, along z from its middle
      Manifold m{};
      if (!collide({make_box(0.5, 0.5, 0.5),
                    make_cylinder(0.3, 0.1),
                    kUpright,
                    Dice::to_real(turn),
                    {Real(0.1), Real(0.79999), static_cast<Real>(-0.5 - end - beside)},
                    Real(0.01)},
                   {}, m))
        continue;
      for (std::uint32_t i = 0; i < m.count; ++i) {
        const Vec& p = m.points[i].position;
        EXPECT_LT(std::abs(p.x - Real(0.1)), 0.15) << angle << " " << beside;
        EXPECT_NEAR(p.y, 0.5, 0.01);
        EXPECT_NEAR(p.z, -0.5, 0.01);
      }
    }
}
TEST(CylinderPoints, OfTwoThatStandOnEachOtherAreOfTheSmallerRim) {
  Manifold m{};
  ASSERT_TRUE(
      collide({make_cylinder(1, 0.5), make_cylinder(0.5, 0.5), kUpright, kUpright, {0, 1, 0}, Real(0.01)}, {}, m));
  ASSERT_EQ(m.count, 4U);
  for (const ManifoldPoint& p : m.points) EXPECT_NEAR(std::hypot(p.position.x, p.position.z), 0.5, 1e-5);
}

}  // namespace
}  // namespace plumb::impulse
