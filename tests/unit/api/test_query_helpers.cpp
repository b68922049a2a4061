// What adapters take for queries and joints: one hit a body in the interface's order, and the coordinates of a joint.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <tuple>

#include "plumb/backend/hit_collector.hpp"
#include "plumb/backend/joint_coordinates.hpp"

namespace plumb::backend {
namespace {

constexpr PlumbBody first = (PlumbBody{1} << 32) | 4, second = (PlumbBody{1} << 32) | 7;

TEST(HitCollector, KeepsTheNearestOfAllAndTheLowerSlotOfTwo) {
  std::vector<PlumbHit> hits;
  HitCollector collector(hits, 3, PLUMB_HIT_CLOSEST);
  EXPECT_EQ(collector.nearest(), 1);
  collector.add(second, 0, 0.5, {}, {});
  EXPECT_EQ(collector.nearest(), 0.5);
  collector.add(first, 9, 0.5, {}, {});
  collector.add(second, 0, 0.75, {}, {});
  collector.finish();
  ASSERT_EQ(hits.size(), 1u);
  EXPECT_EQ(hits[0].body, first);
  EXPECT_EQ(hits[0].child, 9u);
  EXPECT_EQ(hits[0].query, 3u);
}

TEST(HitCollector, KeepsOneHitABodyAndSortsThem) {
  std::vector<PlumbHit> hits;
  HitCollector collector(hits, 0, PLUMB_HIT_ALL);
  collector.add(first, 0, 0.75, {}, {});
  collector.add(second, 1, 0.5, {}, {});
  collector.add(first, 2, 0.25, {}, {});
  EXPECT_EQ(collector.nearest(), 1) << "all are wanted, however far";
  collector.finish();
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].body, first);
  EXPECT_EQ(hits[0].child, 2u);
  EXPECT_EQ(hits[1].body, second);
}

TEST(HitCollector, SaysWhereNothingWasFoundAndLeavesOtherQueriesAlone) {
  std::vector<PlumbHit> hits;
  HitCollector one(hits, 0, PLUMB_HIT_CLOSEST);
  one.add(second, 0, 0.9, {}, {});
  one.finish();
  HitCollector other(hits, 1, PLUMB_HIT_CLOSEST);
  EXPECT_FALSE(other.any());
  other.finish();
  HitCollector all(hits, 2, PLUMB_HIT_ALL);
  all.finish();
  ASSERT_EQ(hits.size(), 2u);
  EXPECT_EQ(hits[0].body, second);
  EXPECT_EQ(hits[1].body, 0u);
  EXPECT_EQ(hits[1].query, 1u);
}

TEST(DeepestOfBodies, AreThoseOfBruteForce) {
  std::mt19937 random(1);
  const auto below = [&](std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); };
  std::vector<PlumbPenetration> pieces;
  for (std::uint32_t query = 0; query < 500; ++query)
    for (std::uint32_t i = below(7); i > 0; --i)
      pieces.push_back({PlumbBody{1} << 32 | below(4), query, below(5), below(8) / 8.0, {}, {}});
  const std::vector<PlumbPenetration> known = pieces;
  const auto deeper = [](const PlumbPenetration& a, const PlumbPenetration& b) {
    return a.depth > b.depth || (a.depth == b.depth && a.child < b.child);
  };
  const std::span<const PlumbPenetration> rows = deepest_of_bodies(pieces);
  std::set<std::pair<std::uint32_t, PlumbBody>> bodies, told;
  for (const PlumbPenetration& piece : known) bodies.emplace(piece.query, piece.body);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    told.emplace(rows[i].query, rows[i].body);
    for (const PlumbPenetration& piece : known)
      EXPECT_FALSE(piece.query == rows[i].query && piece.body == rows[i].body && deeper(piece, rows[i])) << i;
    if (i == 0) continue;
    EXPECT_LT(std::tuple(rows[i - 1].query, -rows[i - 1].depth, slot_of(rows[i - 1].body)),
              std::tuple(rows[i].query, -rows[i].depth, slot_of(rows[i].body)));
  }
  EXPECT_EQ(told, bodies);
  EXPECT_EQ(rows.size(), bodies.size());
  EXPECT_GT(known.size(), rows.size() + 100);
  EXPECT_TRUE(deepest_of_bodies({}).empty());
}

PlumbQuat about(const PlumbVec3& axis, double angle) {
  const PlumbVec3 u = scale(std::sin(angle / 2), axis);
  return {u.x, u.y, u.z, std::cos(angle / 2)};
}

TEST(JointCoordinates, AreTheTurnsAboutXThenYThenZ) {
  const PlumbPose a{{1, 2, 3}, normalized({0.3, -0.2, 0.5, 0.7})};
  const PlumbQuat turn = multiply(multiply(about({1, 0, 0}, 0.4), about({0, 1, 0}, -0.7)), about({0, 0, 1}, 1.1));
  const PlumbPose b = compose(a, {{0.5, -0.25, 2}, turn});
  double row[6];
  joint_coordinates(PLUMB_JOINT_GENERIC, a, b, row);
  const double expected[6] = {0.5, -0.25, 2, 0.4, -0.7, 1.1};
  for (int axis = 0; axis < 6; ++axis) EXPECT_NEAR(row[axis], expected[axis], 1e-12) << axis;
}

TEST(JointCoordinates, AreASwingAfterATwist) {
  for (const double twist : {-3.0, 0.0, 1.2})
    for (const double swing : {0.0, 1e-9, 0.8, 3.1})
      for (const double sign : {1.0, -1.0}) {  // both quaternions of a turn
        const PlumbQuat q = multiply(about({0, 0.6, -0.8}, swing), about({1, 0, 0}, twist));
        const PlumbPose a{{1, 2, 3}, normalized({0.3, -0.2, 0.5, 0.7})};
        const PlumbPose b = compose(a, {{0, 0, 0}, {sign * q.x, sign * q.y, sign * q.z, sign * q.w}});
        double row[6];
        joint_coordinates(PLUMB_JOINT_SWING_TWIST, a, b, row);
        const double expected[6] = {0, 0, 0, twist, 0.6 * swing, -0.8 * swing};
        for (int axis = 0; axis < 6; ++axis) EXPECT_NEAR(row[axis], expected[axis], 1e-12) << twist << " " << swing;
      }
  const PlumbVec3 opposite = swing_twist({0, 1, 0, 0});
  EXPECT_NEAR(std::hypot(opposite.y, opposite.z), std::numbers::pi, 1e-12);
}

}  // namespace
}  // namespace plumb::backend
