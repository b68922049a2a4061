// Distances of convex shapes and casts of one at another, in float and in double, against brute force in double.
#include "narrowphase/convex/distance.hpp"

#include <gtest/gtest.h>

#include "tests/rigs/convex_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;

template <class N>
class Distance : public ::testing::Test {
 protected:
  /// B somewhere about A: apart, touching, or one within the other.
  struct Placed {
    Shape a, b;
    Quat4<double> turn;
    V shift;
  };
  Placed place(double scale) {
    Placed p{random_shape(dice_, pool_, scale), random_shape(dice_, pool_, scale), dice_.orientation(), {}};
    if (dice_.below(4) == 0) {  // faces and edges in parallel
      p.turn = {0, 0, 0, 1};
      if (dice_.below(2) == 0) p.turn = Dice::turn({0, 1, 0}, 1.5707963267948966 * dice_.below(4));
    }
    p.turn = rounded(p.turn);
    const double reach = static_cast<double>(p.a.reach + p.b.reach);
    const V way = dice_.below(3) == 0 ? V{0, 1, 0} : dice_.direction();
    p.shift = rounded(dice_.uniform(0, 2) * reach * way);
    if (dice_.below(3) == 0) {  // nearly touching along the direction that parts them
      const Features a = features_of(p.a, hulls(), {0, 0, 0, 1}, {0, 0, 0}), b = features_of(p.b, hulls(), p.turn, {});
      const double away = high(a, way) + high(b, -way);
      p.shift = rounded((away + reach * dice_.log_uniform(1e-9, 1e-2)) * way);
    }
    return p;
  }
  Hulls hulls() { return pool_.host(); }
  PlacedPair<N> pair(const Placed& p) {
    return {p.a, p.b, to_matrix(to_numbers<N>(p.turn)), to_numbers<N>(p.shift), hulls()};
  }
  static V rounded(const V& v) { return to_numbers<double>(to_numbers<N>(v)); }
  static Quat4<double> rounded(const Quat4<double>& q) { return to_numbers<double>(to_numbers<N>(q)); }

  Dice dice_{5};
  HullPool pool_;
};
using Numbers = ::testing::Types<float, double>;
TYPED_TEST_SUITE(Distance, Numbers);

TYPED_TEST(Distance, IsThatOfBruteForce) {
  constexpr double rounding = 100 * static_cast<double>(kRounding<TypeParam>);
  int apart = 0, overlapping = 0, round = 0;
  for (int i = 0; i < 6000; ++i) {
    const double scale = i % 3 == 0 ? 1e-3 : i % 3 == 1 ? 1 : 1e3;
    const auto p = this->place(scale);
    const Features a = features_of(p.a, this->hulls(), {0, 0, 0, 1}, {0, 0, 0}),
                   b = features_of(p.b, this->hulls(), p.turn, p.shift);
    const double truth = distance(a, b), size = static_cast<double>(p.a.reach + p.b.reach) + length(p.shift);
    const ShapeGap<TypeParam> gap = shape_gap(this->pair(p));
    EXPECT_TRUE(shapes_overlap(this->pair(p)) == (truth <= 0) || std::abs(truth) < rounding * size) << i;
    if (gap.cores_overlap) {
      ASSERT_LE(truth + a.radius + b.radius, rounding * size) << i << ": the cores are apart";
      ++overlapping;
      continue;
    }
    ASSERT_NEAR(static_cast<double>(gap.distance), truth, rounding * size) << i;
    ++(truth < 0 ? round : apart);
    // The plane across the normal parts the shapes by that much, and the points are that far apart.
    const V n = to_numbers<double>(gap.normal);
    const double core = truth + a.radius + b.radius;
    EXPECT_NEAR(-high(b, -n) - high(a, n), truth, rounding * size) << i;
    EXPECT_NEAR(length(n), 1, rounding) << i;
    const V between_points = to_numbers<double>(gap.on_b) - to_numbers<double>(gap.on_a);
    EXPECT_NEAR(dot(n, between_points), truth, rounding * size * (1 + size / core * 1e-3)) << i;
  }
  EXPECT_GT(apart, 2000);
  EXPECT_GT(overlapping, 500);
  EXPECT_GT(round, 100) << "balls that overlap but are not concentric";
}

TYPED_TEST(Distance, OfWhatIsFarIsRelativelyAsTrue) {
  for (int i = 0; i < 300; ++i) {
    auto p = this->place(1);
    p.shift = this->rounded(this->dice_.log_uniform(10, 1e4) * this->dice_.direction());
    const Features a = features_of(p.a, this->hulls(), {0, 0, 0, 1}, {0, 0, 0}),
                   b = features_of(p.b, this->hulls(), p.turn, p.shift);
    const double truth = distance(a, b);
    EXPECT_NEAR(static_cast<double>(shape_gap(this->pair(p)).distance), truth,
                100 * static_cast<double>(kRounding<TypeParam>) * truth);
  }
}

/// The distance to a convex shape is a convex function of the way, so its least is found by narrowing.
double least_on_way(Features b, const Features& a, const V& along, double most) {
  const auto at = [&](double s) {
    Features moved = b;
    moved.move(s * along);
    return distance(a, moved);
  };
  double low = 0, high = most;
  for (int i = 0; i < 60; ++i) {
    const double l = low + (high - low) / 3, h = high - (high - low) / 3;
    (at(l) < at(h) ? high : low) = at(l) < at(h) ? h : l;
  }
  return at(low);
}

TYPED_TEST(Distance, OfACastIsClosedWhereItEnds) {
  constexpr double rounding = 2000 * static_cast<double>(kRounding<TypeParam>);
  int hits = 0, misses = 0, starts = 0;
  for (int i = 0; i < 1500; ++i) {
    const auto p = this->place(i % 2 == 0 ? 1 : 1e-2);
    const double reach = static_cast<double>(p.a.reach + p.b.reach), most = (i % 5 == 0 ? 0.5 : 5) * reach;
    const V aim = this->dice_.uniform(0, 1.2) * reach * this->dice_.direction();
    const V along = unit(aim - p.shift);
    const Features a = features_of(p.a, this->hulls(), {0, 0, 0, 1}, {0, 0, 0}),
                   b = features_of(p.b, this->hulls(), p.turn, p.shift);
    CastTouch<TypeParam> touch;
    const bool hit = cast_shape(this->pair(p), to_numbers<TypeParam>(along), static_cast<TypeParam>(most), touch);
    const double at_first = distance(a, b);
    if (!hit) {
      EXPECT_GT(least_on_way(b, a, along, most), -rounding * reach) << i << ": it passes through";
      ++misses;
      continue;
    }
    const auto at = static_cast<double>(touch.at);
    if (touch.at_start) {
      EXPECT_LE(at_first, rounding * reach) << i;
      EXPECT_EQ(at, 0);
      ++starts;
      continue;
    }
    ++hits;
    EXPECT_LE(at, most);
    EXPECT_GT(at_first, -rounding * reach) << i;
    Features there = b;
    there.move(at * along);
    const V n = to_numbers<double>(touch.normal);
    EXPECT_NEAR(distance(a, there), 0, rounding * reach) << i << ": it ends where it does not touch";
    EXPECT_NEAR(-high(there, -n) - high(a, n), 0, rounding * reach) << i << ": the normal does not part them";
    EXPECT_LT(dot(n, along), rounding);
    const V on_a = to_numbers<double>(touch.on_a);
    EXPECT_NEAR(dot(n, on_a), high(a, n), 1e-3 * reach) << i << ": the place is not on the surface";
  }
  EXPECT_GT(hits, 400);
  EXPECT_GT(misses, 200);
  EXPECT_GT(starts, 100);
}

}  // namespace
}  // namespace plumb::impulse
