// How deep shapes overlap bodies: the bodies are those of overlaps, depth and way out those of the two shapes posed
// against each other, of compounds of their deepest child.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "tests/rigs/surface_fixture.hpp"

namespace plumb::impulse::test {
namespace {

class Penetrations : public SurfaceQueries {
 protected:
  struct Standing {
    PlumbShape shape;
    PlumbPose pose;
  };

  PlumbBody stand(PlumbShape shape, const PlumbPose& pose) {
    const PlumbBody body = scene_->add_static(shape, pose.position, pose.orientation);
    standing_[body] = {shape, pose};
    return body;
  }
  std::vector<PlumbPenetration> find(const std::vector<PlumbOverlap>& overlaps) {
    const plumb::Penetrations found = ask().penetrations(overlaps);
    check(scene_->world(), found.result);
    return {found.rows.begin(), found.rows.end()};
  }
  /// Of a body and a shape, by plumb.collide/1; below 0: overlap.
  double distance(PlumbBody body, const PlumbOverlap& overlap) {
    const PlumbPosedPair pair = {standing_[body].shape, overlap.shape, standing_[body].pose, overlap.pose};
    PlumbPairResult result{};
    std::span<const PlumbPairPoint> points;
    check(scene_->world(), scene_->world().collide()->collide_pairs({&pair, 1}, {&result, 1}, points));
    return result.distance;
  }
  void compare(const std::vector<PlumbOverlap>& overlaps, int& deep) {
    const std::vector<PlumbPenetration> rows = find(overlaps);
    std::set<std::pair<std::uint32_t, PlumbBody>> told, known;
    for (const PlumbHit& hit : ask().overlap_shapes(overlaps).hits) known.emplace(hit.query, hit.body);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      const PlumbPenetration& row = rows[i];
      EXPECT_TRUE(told.emplace(row.query, row.body).second) << "told twice";
      if (i > 0) {
        const PlumbPenetration& before = rows[i - 1];
        EXPECT_LT(std::tuple(before.query, -before.depth, slot_of(before.body)),
                  std::tuple(row.query, -row.depth, slot_of(row.body)));
      }
      EXPECT_NEAR(length(to_vec64(row.normal)), 1, 1e-5);
      const double apart = distance(row.body, overlaps[row.query]);
      EXPECT_NEAR(row.depth, std::max(-apart, 0.0), 1e-5) << "row " << i;  // turns are rounded in a world
      if (apart < 0) ++deep;
    }
    EXPECT_EQ(told, known);
  }

  std::map<PlumbBody, Standing> standing_;
};

TEST_F(Penetrations, AreThoseOfTheShapesPosedAgainstEachOther) {
  const PlumbShape shapes[4] = {scene_->sphere(0.4), scene_->box({0.3, 0.4, 0.5}), scene_->capsule(0.2, 0.4),
                                scene_->sphere(0.7)};
  for (int i = 0; i < 400; ++i) stand(shapes[i % 4], pose_about(4));
  stand(scene_->make(shape_desc(PLUMB_PLANE)), {{0, -3, 0}, {0, 0, 0, 1}});
  std::vector<PlumbOverlap> overlaps;
  for (int i = 0; i < 1500; ++i) overlaps.push_back({shapes[i % 4], pose_about(5), kSeesAll});
  int deep = 0;
  compare(overlaps, deep);
  EXPECT_GT(deep, 3000);
}

TEST_F(Penetrations, OfSurfacesAreThoseOfTheDeepestTriangle) {
  const TriangleSet hills = grid(12, 0.5, [&](double x, double z) { return 0.5 * std::sin(2 * x) * std::cos(z); });
  stand(scene_->make(hills.desc()), {{0, 0, 0}, pose_about(0).orientation});
  const std::vector<double> heights(81, 0.25);
  stand(scene_->make(field_desc(heights, 9, 9, 0.5)), {{0, 0.5, 0}, pose_about(0).orientation});
  const PlumbShape shapes[3] = {scene_->sphere(0.4), scene_->box({0.3, 0.4, 0.5}), scene_->capsule(0.2, 0.4)};
  std::vector<PlumbOverlap> overlaps;
  for (int i = 0; i < 600; ++i) overlaps.push_back({shapes[i % 3], pose_about(2), kSeesAll});
  int deep = 0;
  compare(overlaps, deep);
  EXPECT_GT(deep, 200);
}

TEST_F(Penetrations, OfCompoundsAreThoseOfTheDeepestChildFarOutToo) {
  const double far = kEpsilon < 1e-10 ? 1e5 : 1e3;
  const PlumbShape ball = scene_->sphere(0.5);
  std::vector<PlumbCompoundChild> children(40);
  for (std::size_t i = 0; i < children.size(); ++i) {
    children[i].shape = ball;
    children[i].pose = {{0.25 * static_cast<double>(i), 0, 0}, {0, 0, 0, 1}};
  }
  PlumbShapeDesc desc = shape_desc(PLUMB_COMPOUND);
  desc.children = children.data();
  desc.child_count = 40;
  const PlumbShape row = scene_->make(desc);
  for (const double x : {0.0, far}) {
    const PlumbBody body = stand(row, {{x, 0, 0}, {0, 0, 0, 1}});
    for (std::uint32_t k = 0; k < 40; ++k) {
      const PlumbOverlap overlap = {ball, {{x + 0.25 * k, 0.75, 0}, {0, 0, 0, 1}}, kSeesAll};
      const std::vector<PlumbPenetration> rows = find({overlap});
      ASSERT_EQ(rows.size(), 1U);
      EXPECT_EQ(rows[0].body, body);
      EXPECT_EQ(rows[0].child, k);
      EXPECT_NEAR(rows[0].depth, 0.25, 1e-6);
      EXPECT_NEAR(rows[0].normal.y, 1, 1e-6);
      EXPECT_NEAR(rows[0].position.y, 0.375, 1e-6) << "midway in the overlap";
      EXPECT_NEAR(rows[0].position.x, x + 0.25 * k, 1e-6);
    }
  }
}

}  // namespace
}  // namespace plumb::impulse::test
