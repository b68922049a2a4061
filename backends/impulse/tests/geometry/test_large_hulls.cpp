// Hulls of several hundred corners and faces.
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "tests/rigs/shape_scenes.hpp"
#include "tests/rigs/support_reference.hpp"

namespace plumb::impulse {
namespace {

using namespace reference;

/// Points on a ball of radius .5, all of them corners.
std::vector<PlumbVec3> ball_points(std::uint32_t count) {
  std::vector<PlumbVec3> points;
  for (std::uint32_t i = 0; i < count; ++i) {  // on a spiral
    const double y = 1 - 2 * (i + 0.5) / count, across = std::sqrt(1 - y * y), turn = 2.399963229728653 * i;
    points.push_back({0.5 * across * std::cos(turn), 0.5 * y, 0.5 * across * std::sin(turn)});
  }
  return points;
}

TEST(LargeHulls, KeepAllCornersAndAreApartByTheGreatestGap) {
  HullPool pool;
  const std::uint32_t row = pool.add(ball_points(400));
  const Hulls hulls = pool.host();
  EXPECT_EQ(hulls.ranges[row].vertex_count, 400U);
  EXPECT_EQ(hulls.ranges[row].face_count, 796U);
  const Shape ball = {ShapeType::kHull, row, {0, 0, 0}, pool.reach(row)};
  Dice dice(4);
  for (int i = 0; i < 40; ++i) {
    const Quat qa = Dice::to_real(dice.orientation()), qb = Dice::to_real(dice.orientation());
    const Shape other = i % 2 == 0 ? ball : make_box(0.4, 0.3, 0.5);
    const V d = (0.5 + (i % 2 == 0 ? 0.5 : dice.uniform(0.3, 0.6)) + dice.uniform(-0.04, 0.0)) * dice.direction();
    const Vec rd = {static_cast<Real>(d.x), static_cast<Real>(d.y), static_cast<Real>(d.z)};
    const Solid a = {ball, &hulls, unit(qa), {0, 0, 0}}, b = {other, &hulls, unit(qb), to_double(rd)};
    Manifold m{};
    if (!collide({ball, other, qa, qb, rd, Real(0.05)}, hulls, m)) continue;
    const double best = greatest_over_directions([&](const V& n) { return gap(a, b, n); }, dice);
    EXPECT_GE(gap(a, b, to_double(m.normal)), best - 1e-4) << i;
  }
}

TEST(LargeHulls, EdgesOfManyCornersHaveNamesOfTheirOwn) {
  std::set<std::uint32_t> names;
  HullPool pool;
  const std::uint32_t row = pool.add(ball_points(255));
  const HullView view(pool.host(), row);
  for (std::uint32_t e = 0; e < view.edge_count(); ++e)
    names.insert(edge_between(view.edge(e).from, view.edge(e).to) & 0x3fffU);
  EXPECT_GT(names.size(), view.edge_count() * 95 / 100) << "of the 14 bits that a feature has";
}

TEST(LargeHulls, RestOnTheGroundAndOnEachOther) {
  test::Scene scene(test::engine(), PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION, {0, -9.81, 0}, 1);
  scene.ground();
  std::vector<PlumbVec3> drum;  // of 128 sides
  for (int i = 0; i < 128; ++i) {
    const double turn = 2 * 3.14159265358979323846 * i / 128;
    for (const double y : {-0.5, 0.5}) drum.push_back({0.5 * std::cos(turn), y, 0.5 * std::sin(turn)});
  }
  const PlumbShape shape = scene.hull(drum);
  for (int i = 0; i < 3; ++i) scene.add(shape, {0, 0.51 + 1.01 * i, 0});
  scene.run(200);
  for (int i = 0; i < 3; ++i) {
    const PlumbVec3 at = scene.poses()[static_cast<std::size_t>(i) + 1].position;
    EXPECT_NEAR(at.y, 0.5 + i, 0.01);
    EXPECT_NEAR(std::hypot(at.x, at.z), 0, 0.01);
  }
}

}  // namespace
}  // namespace plumb::impulse
