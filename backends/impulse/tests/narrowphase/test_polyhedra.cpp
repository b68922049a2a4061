// Boxes and hulls against brute force in double. PLUMB_NARROW_PAIRS sets how many random pairs of each kind are tried.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/rigs/narrow_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;

std::uint32_t pair_count(std::uint32_t normal) {
  const char* wanted = std::getenv("PLUMB_NARROW_PAIRS");
  return wanted != nullptr ? static_cast<std::uint32_t>(std::atol(wanted)) : normal;
}

/// What rounding may do to a separation, of the sizes involved.
constexpr double kHullError = 100 * static_cast<double>(kEpsilon);

/// How deep edges of two boxes may graze without a touch, where points ahead of time are asked for (box_box.hpp).
double most_grazing(const RandomPair& p) {
  const Vec a = p.a.size, b = p.b.size;
  return 0.01 * static_cast<double>(std::min({a.x, a.y, a.z, b.x, b.y, b.z}));
}

void expect_true_to_reference(const RandomPair& p, const Hulls& hulls, Real margin, std::uint32_t trial) {
  Manifold m{};
  const bool touch = collide({p.a, p.b, p.qa, p.qb, p.d, margin}, hulls, m);
  const Polyhedron a = polyhedron(p.a, hulls, p.qa, {0, 0, 0}), b = polyhedron(p.b, hulls, p.qb, p.d);
  const double size = a.size + b.size, tolerance = kHullError * size, best = greatest_gap(a, b);
  SCOPED_TRACE("pair " + std::to_string(trial) + ", gap " + std::to_string(best / size) + " of its size");
  const bool all_axes = p.a.type == ShapeType::kBox && p.b.type == ShapeType::kBox;
  if (best > tolerance + (all_axes ? static_cast<double>(margin) : 0)) {
    // Between hulls apart, brute force also tries cross products of edges that face away, which may fit better.
    EXPECT_FALSE(touch && (all_axes || margin == 0));
    for (std::uint32_t i = 0; i < m.count; ++i) EXPECT_GT(m.points[i].separation, 0);
    if (all_axes) return;
  }
  EXPECT_EQ(touch, m.count > 0);
  EXPECT_TRUE(touch || best >= -tolerance - (all_axes && margin > 0 ? most_grazing(p) : 0));
  if (!touch) return;

  const V n = to_double(m.normal);
  EXPECT_NEAR(length(n), 1, 10 * kHullError);
  const double along = gap(a, b, n);
  if (all_axes || best < 0) {
    EXPECT_GE(along, best - 2 * tolerance) << "along the normal";
  }
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < m.count; ++i) {
    const double separation = static_cast<double>(m.points[i].separation);
    least = std::min(least, separation);
    EXPECT_LE(separation, static_cast<double>(margin));
    // A corner may count as within a face that it misses by 1e-3 of the face's width.
    const V middle = to_double(m.points[i].position);
    const double slack = 2e-3 * std::max(a.size, b.size) + tolerance;
    EXPECT_LE(std::abs(a.outside(middle - 0.5 * separation * n)), slack) << "point " << i << " on A";
    EXPECT_LE(std::abs(b.outside(middle + 0.5 * separation * n)), slack) << "point " << i << " on B";
  }
  EXPECT_GE(least, along - 2 * tolerance) << "the deepest point";
  if (best < -tolerance) {
    EXPECT_LE(least - along, 2 * tolerance) << "the deepest point";
  }
}

TEST(Polyhedra, BoxesAgreeWithBruteForce) {
  Dice dice(1);
  for (std::uint32_t i = 0; i < pair_count(100000) && !HasFailure(); ++i) {
    const double scale = dice.below(4) == 0 ? dice.log_uniform(1e-3, 1e3) : 1;
    const Shape a = random_box(dice, scale), b = random_box(dice, scale * (dice.below(8) == 0 ? 0.01 : 1));
    const RandomPair p = place(dice, a, b, {});
    expect_true_to_reference(p, {}, static_cast<Real>(dice.below(2) * 0.02) * p.a.reach, i);
  }
}

TEST(Polyhedra, HullsAgreeWithBruteForce) {
  Dice dice(2);
  for (std::uint32_t i = 0; i < pair_count(20000) && !HasFailure();) {
    HullPool pool;
    const double scale = dice.below(4) == 0 ? dice.log_uniform(1e-3, 1e3) : 1;
    Shape shapes[8];
    for (Shape& s : shapes) s = random_hull(dice, pool, scale, 12);
    for (std::uint32_t k = 0; k < 64 && !HasFailure(); ++k, ++i) {
      const RandomPair p = place(dice, shapes[dice.below(8)], shapes[dice.below(8)], pool.host());
      expect_true_to_reference(p, pool.host(), static_cast<Real>(dice.below(2) * 0.02) * p.a.reach, i);
    }
  }
}

TEST(Polyhedra, BoxAndHullAgreeWithBruteForce) {
  Dice dice(3);
  for (std::uint32_t i = 0; i < pair_count(20000) && !HasFailure();) {
    HullPool pool;
    Shape shapes[8];
    for (Shape& s : shapes) s = random_hull(dice, pool, 1, 12);
    for (std::uint32_t k = 0; k < 64 && !HasFailure(); ++k, ++i) {
      const RandomPair p = place(dice, random_box(dice, 1), shapes[dice.below(8)], pool.host());
      expect_true_to_reference(p, pool.host(), static_cast<Real>(dice.below(2) * 0.02) * p.a.reach, i);
    }
  }
}

}  // namespace
}  // namespace plumb::impulse
