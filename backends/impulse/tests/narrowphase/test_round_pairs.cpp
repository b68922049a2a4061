// Pairs with a sphere or a capsule against brute force in double: distances by search, depths by all axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "tests/rigs/narrow_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;

/// Any shape as a core (point, segment or polyhedron) with a radius about it.
struct Rounded {
  Polyhedron core;
  double radius = 0;
  std::vector<std::array<V, 3>> triangles;
};

Rounded rounded(const Shape& s, const Hulls& hulls, const Quat& q, const Vec& origin) {
  Rounded r;
  const auto fan = [&](const auto& view) {
    r.core = polyhedron(s, hulls, q, origin);
    for (std::uint32_t f = 0; f < view.face_count(); ++f)
      for (std::uint32_t k = 2; k < view.loop_size(f); ++k)
        r.triangles.push_back(
            {r.core.vertices[view.loop(f, 0)], r.core.vertices[view.loop(f, k - 1)], r.core.vertices[view.loop(f, k)]});
  };
  if (s.type == ShapeType::kBox) {
    fan(BoxView{s.size});
  } else if (s.type == ShapeType::kHull) {
    fan(HullView(hulls, s.hull));
  } else {
    r.radius = static_cast<double>(s.size.x);
    r.core.size = static_cast<double>(s.reach);
    const V half = s.type == ShapeType::kCapsule ? rotate(unit(q), V{0, static_cast<double>(s.size.y), 0}) : V{0, 0, 0};
    r.core.vertices = {to_double(origin) - half};
    if (s.type == ShapeType::kCapsule) {
      r.core.vertices.push_back(to_double(origin) + half);
      r.core.edges = {unit(half)};
    }
  }
  return r;
}

double to_segment(const V& p, const V& a, const V& b) {
  const V d = b - a;
  const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
  return length(p - a - t * d);
}
double to_triangle(const V& p, const std::array<V, 3>& t) {
  const V n = cross(t[1] - t[0], t[2] - t[0]);
  bool over = true;
  for (std::size_t k = 0; k < 3; ++k) over = over && dot(cross(t[(k + 1) % 3] - t[k], p - t[k]), n) >= 0;
  if (over) return std::abs(dot(p - t[0], unit(n)));
  return std::min({to_segment(p, t[0], t[1]), to_segment(p, t[1], t[2]), to_segment(p, t[2], t[0])});
}
double to_core(const V& p, const Rounded& r) {
  if (r.core.vertices.size() == 1) return length(p - r.core.vertices[0]);
  if (r.core.vertices.size() == 2) return to_segment(p, r.core.vertices[0], r.core.vertices[1]);
  if (r.core.outside(p) <= 0) return 0;
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : r.triangles) best = std::min(best, to_triangle(p, t));
  return best;
}
/// The distance to a convex core along a segment is convex: ternary search.
double between_cores(const Rounded& a, const Rounded& b) {
  if (a.core.vertices.size() > 2) return between_cores(b, a);
  const V from = a.core.vertices[0], along = a.core.vertices.back() - from;
  double low = 0, high = 1;
  for (int i = 0; i < 90 && high > low; ++i) {
    const double l = low + (high - low) / 3, h = high - (high - low) / 3;
    (to_core(from + l * along, b) < to_core(from + h * along, b) ? high : low) =
        to_core(from + l * along, b) < to_core(from + h * along, b) ? h : l;
  }
  return to_core(from + low * along, b);
}
/// How far p is from the surface of a shape.
double from_surface(const V& p, const Rounded& r) {
  if (r.radius > 0) return to_core(p, r) - r.radius;
  return r.core.outside(p) < 0 ? r.core.outside(p) : to_core(p, r);
}

constexpr double kRoundError = 200 * static_cast<double>(kEpsilon);

void expect_true(const RandomPair& p, const Hulls& hulls, Real margin, std::uint32_t trial) {
  Manifold m{};
  const bool touch = collide({p.a, p.b, p.qa, p.qb, p.d, margin}, hulls, m);
  const Rounded a = rounded(p.a, hulls, p.qa, {0, 0, 0}), b = rounded(p.b, hulls, p.qb, p.d);
  const double size = a.core.size + b.core.size, tolerance = kRoundError * size, radii = a.radius + b.radius;
  const double apart = between_cores(a, b), gap_there = greatest_gap(a.core, b.core);
  const bool deep = apart < tolerance;
  const double core = deep ? std::min(gap_there, 0.0) : apart;
  SCOPED_TRACE("pair " + std::to_string(trial) + ", types " + std::to_string(static_cast<int>(p.a.type)) + " and " +
               std::to_string(static_cast<int>(p.b.type)) + ", cores " + std::to_string(core / size) +
               " of their size apart");
  if (core - radii > static_cast<double>(margin) + tolerance) {
    EXPECT_FALSE(touch);
    return;
  }
  EXPECT_EQ(touch, m.count > 0);
  EXPECT_TRUE(touch || core - radii > static_cast<double>(margin) - tolerance);
  if (!touch) return;
  const V n = to_double(m.normal);
  EXPECT_NEAR(length(n), 1, 1e-5);
  // The direction between cores that nearly touch is only as good as their distance; and a distance that is right to
  // eps leaves sqrt(eps) to the direction where it hardly depends on it.
  const double turned = deep ? 0 : 4 * std::sqrt(static_cast<double>(kEpsilon)) + 4 * tolerance / core;
  EXPECT_GE(gap(a.core, b.core, n), core - 4 * tolerance - turned * size);
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t i = 0; i < m.count; ++i) {
    const double separation = static_cast<double>(m.points[i].separation);
    least = std::min(least, separation);
    const V middle = to_double(m.points[i].position);
    EXPECT_LE(separation, static_cast<double>(margin));
    const double slack = 3e-3 * size;
    // On the flat surfaces, and on the ball about some point of a segment, which may be inside a slanting capsule.
    const double on_a = from_surface(middle - 0.5 * separation * n, a);
    const double on_b = from_surface(middle + 0.5 * separation * n, b);
    EXPECT_LE(on_a, slack) << "point " << i << " of " << m.count;
    EXPECT_LE(on_b, slack) << "point " << i << " of " << m.count;
    EXPECT_TRUE(a.radius > 0 || on_a >= -slack) << "point " << i << " of " << m.count;
    EXPECT_TRUE(b.radius > 0 || on_b >= -slack) << "point " << i << " of " << m.count;
  }
  EXPECT_NEAR(least, core - radii, 4 * tolerance);
}

Shape random_shape(Dice& dice, ShapeType type, HullPool& pool, double scale) {
  const auto length = [&] { return static_cast<Real>(scale * (dice.below(8) == 0 ? 0.01 : 1) * dice.uniform(0.2, 1)); };
  if (type == ShapeType::kSphere) {
    const Real r = length();
    return {type, 0, {r, 0, 0}, r};
  }
  if (type == ShapeType::kCapsule) {
    const Real r = length(), h = length();
    return {type, 0, {r, h, 0}, r + h};
  }
  return type == ShapeType::kBox ? random_box(dice, scale) : random_hull(dice, pool, scale, 16);
}

class RoundPairs : public ::testing::TestWithParam<std::pair<ShapeType, ShapeType>> {};

TEST_P(RoundPairs, AgreeWithSearchInDouble) {
  const auto [type_a, type_b] = GetParam();
  Dice dice(17 + 4 * static_cast<std::uint32_t>(type_a) + static_cast<std::uint32_t>(type_b));
  const char* wanted = std::getenv("PLUMB_NARROW_PAIRS");
  const std::uint32_t trials = wanted != nullptr ? static_cast<std::uint32_t>(std::atol(wanted)) : 3000;
  for (std::uint32_t i = 0; i < trials && !HasFailure();) {
    HullPool pool;
    const double scale = dice.below(4) == 0 ? dice.log_uniform(1e-3, 1e3) : 1;
    for (int k = 0; k < 4 && !HasFailure(); ++k) {
      const Shape a = random_shape(dice, type_a, pool, scale), b = random_shape(dice, type_b, pool, scale);
      for (int j = 0; j < 8 && !HasFailure(); ++j, ++i) {
        RandomPair p = {a, b, Dice::to_real(dice.orientation()), {}, {}};
        const bool along = dice.below(3) == 0;  // capsules that lie on what they touch, or nearly
        p.qb = along ? p.qa : Dice::to_real(dice.orientation());
        if (along && dice.below(2) == 0)
          p.qb = Dice::to_real(unit(p.qb) * Dice::turn(dice.direction(), dice.log_uniform(1e-7, 0.2)));
        const V d = dice.uniform(0, 1.1 * static_cast<double>(a.reach + b.reach)) *
                    (along ? rotate(unit(p.qa), V{1, 0.3 * dice.uniform(-1, 1), 0}) : dice.direction());
        p.d = {static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z)};
        expect_true(p, pool.host(), static_cast<Real>(dice.below(2) * 0.02) * a.reach, i);
      }
    }
  }
}
using enum ShapeType;
INSTANTIATE_TEST_SUITE_P(All, RoundPairs,
                         ::testing::Values(std::pair{kSphere, kSphere}, std::pair{kSphere, kBox},
                                           std::pair{kSphere, kCapsule}, std::pair{kSphere, kHull},
                                           std::pair{kBox, kCapsule}, std::pair{kCapsule, kCapsule},
                                           std::pair{kCapsule, kHull}, std::pair{kHull, kSphere}));

TEST(RoundPairs, CapsuleOnAFaceHasTwoPoints) {
  const Shape ground = make_box(10, 1, 10), capsule = {kCapsule, 0, {Real(0.5), 1, 0}, Real(1.5)};
  const Quat lying = Dice::to_real(Dice::turn({0, 0, 1}, 1.5707963267948966));
  Manifold m{};
  ASSERT_TRUE(collide({ground, capsule, {0, 0, 0, 1}, lying, {0, Real(1.5), 0}, Real(0.01)}, {}, m));
  ASSERT_EQ(m.count, 2U);
  EXPECT_NE(m.points[0].feature, m.points[1].feature);
  EXPECT_NEAR(m.normal.y, 1, 1e-6);
  EXPECT_NEAR(std::abs(m.points[0].position.x), 1, 1e-5);
  EXPECT_NEAR(m.points[0].position.x, -m.points[1].position.x, 1e-5);
  for (const int i : {0, 1}) EXPECT_NEAR(m.points[i].separation, 0, 1e-6);
}

}  // namespace
}  // namespace plumb::impulse
