// Collision without a step, what the engine lets one see, and what is refused at both and at queries.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "queries/probes.hpp"
#include "tests/rigs/convex_reference.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

using namespace reference;

constexpr PlumbNeeds kCollideNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_QUERIES;
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

class Collide : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string unmet = Executor::unmet_requirement(); !unmet.empty()) GTEST_SKIP() << unmet;
    scene_ = std::make_unique<Scene>(engine(), kCollideNeeds, PlumbVec3{0, -9.81, 0}, 1);
  }
  IPhysicsWorld& world() { return scene_->world(); }

  std::unique_ptr<Scene> scene_;
};

TEST_F(Collide, TellsDistancesAndDepthsAtAnyPlace) {
  Dice dice(31);
  const Shape shapes[] = {{ShapeType::kSphere, 0, {Real(0.4), 0, 0}, Real(0.4)},
                          {ShapeType::kCapsule, 0, {Real(0.3), Real(0.5), 0}, Real(0.8)},
                          make_box(0.5, 0.6, 0.7)};
  const PlumbShape ids[] = {scene_->sphere(static_cast<double>(shapes[0].size.x)),
                            scene_->capsule(static_cast<double>(shapes[1].size.x), 0.5),
                            scene_->box(to_plumb_vec3(to_double(shapes[2].size)))};
  int apart = 0, touching = 0;
  for (const double far : {0.0, 1e6}) {
    std::vector<PlumbPosedPair> pairs;
    std::vector<double> truths;
    for (int i = 0; i < 600; ++i) {
      const std::uint32_t a = dice.below(3), b = dice.below(3);
      const auto qa = dice.orientation(), qb = dice.orientation();
      const V d = dice.uniform(0.1, 2) * dice.direction();
      pairs.push_back({ids[a],
                       ids[b],
                       {{far, 0, -far}, {qa.x, qa.y, qa.z, qa.w}},
                       {{far + d.x, d.y, -far + d.z}, {qb.x, qb.y, qb.z, qb.w}}});
      truths.push_back(distance(features_of(shapes[a], {}, qa, {0, 0, 0}), features_of(shapes[b], {}, qb, d)));
    }
    std::vector<PlumbPairResult> results(pairs.size());
    std::span<const PlumbPairPoint> points;
    check(world(), world().collide()->collide_pairs(pairs, results, points));
    std::uint32_t next = 0;
    const double near = 4e-6;  // the pair functions work in the engine's numbers
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      EXPECT_EQ(results[i].first_point, next);
      next += results[i].point_count;
      if (truths[i] > 1e-5) {
        EXPECT_NEAR(results[i].distance, truths[i], far == 0 ? 1e-6 : 1e-9 * far) << i;
        EXPECT_EQ(results[i].point_count, 0U);
        ++apart;
        continue;
      }
      if (truths[i] > -1e-5) continue;
      ++touching;
      ASSERT_GT(results[i].point_count, 0U) << i;
      double deepest = 0;
      for (std::uint32_t k = 0; k < results[i].point_count; ++k) {
        const PlumbPairPoint& point = points[results[i].first_point + k];
        deepest = std::max(deepest, point.depth);
        EXPECT_NEAR(length(to_vec64(point.normal)), 1, 1e-5);
        EXPECT_LT(length(to_vec64(point.position) - to_vec64(pairs[i].pose_a.position)), 1.2);
        EXPECT_NE(point.feature, 0U);
      }
      EXPECT_EQ(results[i].distance, -deepest);
      const bool round = pairs[i].shape_a != ids[2] && pairs[i].shape_b != ids[2];
      if (round) {  // their depth is the distance of their cores, but where those cross
        EXPECT_TRUE(deepest >= -truths[i] - near - 1e-9 * far);
      }
    }
    EXPECT_EQ(points.size(), next);
  }
  EXPECT_GT(apart, 200);
  EXPECT_GT(touching, 200);
}

TEST_F(Collide, OfNothingIsNothing) {
  std::span<const PlumbPairPoint> points;
  EXPECT_EQ(world().collide()->collide_pairs({}, {}, points), PLUMB_OK);
  EXPECT_TRUE(points.empty());
}

TEST_F(Collide, RefusesWhatIsStaleOrNotANumber) {
  const PlumbShape ball = scene_->sphere(1);
  const PlumbFilter all = {1, ~0u, 0, 0};
  PlumbPairResult result{};
  std::span<const PlumbPairPoint> points;
  const auto collide = [&](const PlumbPosedPair& pair) {
    return world().collide()->collide_pairs({&pair, 1}, {&result, 1}, points);
  };
  const PlumbPose here = identity_pose(), nowhere = {{kNaN, 0, 0}, {0, 0, 0, 1}}, crooked = {{0, 0, 0}, {0, 0, 0, 2}};
  const PlumbShape stale = ball + (std::uint64_t{1} << 32);
  EXPECT_EQ(collide({ball, ball, here, here}), PLUMB_OK);
  EXPECT_EQ(collide({ball, stale, here, here}), PLUMB_E_STALE_HANDLE);
  EXPECT_EQ(collide({ball, ball, nowhere, here}), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_EQ(collide({ball, ball, here, crooked}), PLUMB_E_INVALID_ARGUMENT);
  const auto ray = [&](const PlumbRay& r) { return world().queries()->cast_rays(PLUMB_HIT_CLOSEST, {&r, 1}).result; };
  EXPECT_EQ(ray({{0, 0, 0}, {0, 1, 0}, all}), PLUMB_OK);
  EXPECT_EQ(ray({{0, 0, kNaN}, {0, 1, 0}, all}), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_EQ(ray({{0, 0, 0}, {0, 0, 0}, all}), PLUMB_E_INVALID_ARGUMENT);
  EXPECT_EQ(ray({{0, 0, 0}, {0, INFINITY, 0}, all}), PLUMB_E_INVALID_ARGUMENT);
  const auto cast = [&](const PlumbCast& c) { return world().queries()->cast_shapes(PLUMB_HIT_ALL, {&c, 1}).result; };
  EXPECT_EQ(cast({ball, here, {0, 1, 0}, all}), PLUMB_OK);
  EXPECT_EQ(cast({stale, here, {0, 1, 0}, all}), PLUMB_E_STALE_HANDLE);
  EXPECT_EQ(cast({ball, nowhere, {0, 1, 0}, all}), PLUMB_E_INVALID_ARGUMENT);
  const auto overlap = [&](const PlumbOverlap& o) { return world().queries()->overlap_shapes({&o, 1}).result; };
  EXPECT_EQ(overlap({ball, here, all}), PLUMB_OK);
  EXPECT_EQ(overlap({stale, here, all}), PLUMB_E_STALE_HANDLE);
}

/// Some cubes that have fallen onto the ground, one of them destroyed.
class Debug : public Collide {
 protected:
  void SetUp() override {
    Collide::SetUp();
    if (IsSkipped()) return;
    scene_->ground();
    const PlumbShape cube = scene_->box({0.4, 0.4, 0.4});
    for (int i = 0; i < 30; ++i) bodies_.push_back(scene_->add(cube, {0.5 * (i % 5), 1 + 0.9 * i, 0.3 * (i % 3)}));
    scene_->run(90);
  }
  std::vector<PlumbBody> bodies_;
};

TEST_F(Debug, BoxesHoldTheirBodiesAndNestInEachOther) {
  std::span<const PlumbDebugBox> boxes;
  check(world(), world().debug()->tree_boxes(boxes));
  std::set<PlumbBody> seen;
  std::vector<PlumbDebugBox> about;  // from the root to the last box
  for (const PlumbDebugBox& box : boxes) {
    ASSERT_LE(static_cast<std::size_t>(box.depth), about.size());
    if (box.depth == 0) about.clear();
    about.resize(static_cast<std::size_t>(box.depth));
    if (!about.empty()) {
      const PlumbDebugBox& parent = about.back();
      EXPECT_EQ(parent.tree, box.tree);
      EXPECT_TRUE(parent.lower.x <= box.lower.x && parent.upper.y >= box.upper.y && parent.lower.z <= box.lower.z);
    }
    about.push_back(box);
    if (box.body == 0) continue;
    EXPECT_TRUE(seen.insert(box.body).second) << "a body in two leaves";
    double row[7];
    check(world(), world().read(PLUMB_FIELD_POSE, {&box.body, 1}, rows_over(std::span(&row, 1))));
    EXPECT_TRUE(box.lower.y <= row[1] && row[1] <= box.upper.y && box.lower.x <= row[0] && row[0] <= box.upper.x);
  }
  EXPECT_EQ(seen.size(), bodies_.size() + 1);
  EXPECT_EQ(boxes.size(), 2 * bodies_.size() - 1 + 1) << "a tree of all that moves, and the ground alone";
  scene_->remove(bodies_[3]);
  check(world(), world().debug()->tree_boxes(boxes));
  for (const PlumbDebugBox& box : boxes) EXPECT_NE(box.body, bodies_[3]);
}

TEST_F(Debug, AxesAreThoseOfBruteForce) {
  std::span<const PlumbDebugAxis> axes;
  check(world(), world().debug()->separating_axes(axes));
  EXPECT_GT(axes.size(), bodies_.size());
  const auto at = [&](PlumbBody body) {
    double row[7];
    check(world(), world().read(PLUMB_FIELD_POSE, {&body, 1}, rows_over(std::span(&row, 1))));
    const bool cube = std::find(bodies_.begin(), bodies_.end(), body) != bodies_.end();
    const Shape shape = cube ? make_box(0.4, 0.4, 0.4) : make_box(50, 0.5, 50);
    return features_of(shape, {}, normalized(Quat64{row[3], row[4], row[5], row[6]}), {row[0], row[1], row[2]});
  };
  int apart = 0, overlapping = 0;
  for (const PlumbDebugAxis& axis : axes) {
    const Features a = at(axis.body_a), b = at(axis.body_b);
    const V n = to_vec64(axis.axis);
    EXPECT_NEAR(length(n), 1, 1e-5);
    const double size = std::max(high(a, {1, 0, 0}) + high(a, {-1, 0, 0}), high(b, {1, 0, 0}) + high(b, {-1, 0, 0}));
    EXPECT_NEAR(-high(b, -n) - high(a, n), axis.separation, 100 * static_cast<double>(kEpsilon) * size);
    ++(axis.separation > 0 ? apart : overlapping);
  }
  EXPECT_GT(apart, 0);
  EXPECT_GT(overlapping, 0);
}

TEST_F(Debug, PairsOfTheDeadAreLeftOut) {
  std::span<const PlumbDebugPair> pairs;
  check(world(), world().debug()->candidate_pairs(pairs));
  const std::size_t before = pairs.size();
  const PlumbBody gone = pairs[0].body_a == 0 ? 0 : pairs[0].body_a;
  scene_->remove(gone);
  scene_->add(scene_->box({0.4, 0.4, 0.4}), {50, 50, 50});  // takes the slot
  check(world(), world().debug()->candidate_pairs(pairs));
  EXPECT_LT(pairs.size(), before);
  for (const PlumbDebugPair& pair : pairs) EXPECT_TRUE(pair.body_a != gone && pair.body_b != gone && pair.body_a != 0);
}

}  // namespace
}  // namespace plumb::impulse::test
