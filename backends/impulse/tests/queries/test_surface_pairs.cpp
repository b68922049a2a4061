// Collision without a step for pairs with planes, meshes, height fields, cylinders and compounds: distances by brute
// force over all triangles, in both orders, and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/rigs/surface_fixture.hpp"

namespace plumb::impulse::test {
namespace {

class SurfacePairs : public SurfaceQueries {
 protected:
  struct Answer {
    double distance;
    std::vector<PlumbPairPoint> points;
  };
  Answer collide(const PlumbPosedPair& pair) {
    PlumbPairResult result{};
    std::span<const PlumbPairPoint> points;
    check(scene_->world(), scene_->world().collide()->collide_pairs({&pair, 1}, {&result, 1}, points));
    EXPECT_EQ(result.first_point, 0U);
    EXPECT_EQ(result.point_count, points.size());
    return {result.distance, {points.begin(), points.end()}};
  }
  /// What holds for any answer, and for the same pair the other way round.
  Answer collide_both_ways(const PlumbPosedPair& pair) {
    const Answer answer = collide(pair), other = collide({pair.shape_b, pair.shape_a, pair.pose_b, pair.pose_a});
    const double near = 64 * static_cast<double>(kEpsilon);
    EXPECT_NEAR(answer.distance, other.distance, near);
    EXPECT_EQ(answer.points.size(), other.points.size());
    double deepest = -1;
    std::set<std::uint64_t> features;
    for (std::size_t i = 0; i < std::min(answer.points.size(), other.points.size()); ++i) {
      const PlumbPairPoint &p = answer.points[i], &q = other.points[i];
      EXPECT_NEAR(length(to_vec64(p.normal) + to_vec64(q.normal)), 0, near);
      EXPECT_NEAR(length(to_vec64(p.position) - to_vec64(q.position)), 0, near);
      EXPECT_NEAR(length(to_vec64(p.normal)), 1, near);
      EXPECT_NEAR(p.depth, q.depth, near);
      deepest = std::max(deepest, p.depth);
      EXPECT_NE(p.feature, 0U);
      features.insert(p.feature);
    }
    EXPECT_EQ(features.size(), answer.points.size()) << "a feature twice";
    if (!answer.points.empty()) {
      EXPECT_EQ(answer.distance, -deepest);
    }
    return answer;
  }
  PlumbShape cylinder(double radius, double half) {
    PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
    desc.radius = radius;
    desc.half_height = half;
    return scene_->make(desc);
  }
};

TEST_F(SurfacePairs, DistancesAreThoseOfBruteForce) {
  const double near = kEpsilon < 1e-10 ? 1e-8 : 1e-5;
  const TriangleSet hills = grid(10, 0.5, [](double x, double z) { return 0.5 * std::sin(2 * x) * std::cos(1.5 * z); });
  std::vector<double> heights;
  for (int i = 0; i < 8 * 11; ++i) heights.push_back(dice_.uniform(0, 0.6));
  const PlumbShapeDesc field = field_desc(heights, 8, 11, 0.45);
  const struct {
    PlumbShape shape;
    TriangleSet set;
  } grounds[] = {{scene_->make(hills.desc()), hills}, {scene_->make(field), triangles_of_field(field)}};
  const double radius = 0.3, half = 0.4;
  const PlumbShape round = cylinder(radius, half);
  int apart = 0, touching = 0;
  for (const auto& ground : grounds)
    for (int i = 0; i < 300; ++i) {
      SCOPED_TRACE(i);
      const PlumbPose pose = pose_about(1), other = pose_about(i % 3 == 0 ? 4 : 1.2);
      const std::vector<Corners> triangles = triangles_of(ground.set, pose);
      double truth = std::numeric_limits<double>::infinity();
      PlumbShape shape = round;
      if (i % 4 == 0) {
        const PlacedCylinder placed = {radius, half, normalized(to_quat64(other.orientation)),
                                       to_vec64(other.position)};
        for (const Corners& c : triangles) truth = std::min(truth, distance(c, placed));
      } else {
        const Shape random = random_shape(dice_, pool_, 0.5);
        shape = shape_in_world(random);
        const Features solid =
            features_of(random, pool_.host(), normalized(to_quat64(other.orientation)), to_vec64(other.position));
        for (const Corners& c : triangles) truth = std::min(truth, distance(features_of(c), solid));
      }
      const Answer answer = collide_both_ways({ground.shape, shape, pose, other});
      if (truth > near) {
        EXPECT_NEAR(answer.distance, truth, near);
        EXPECT_TRUE(answer.points.empty());
        ++apart;
      } else if (truth < -near) {
        EXPECT_LE(answer.distance, near);
        ++touching;
        EXPECT_FALSE(answer.points.empty());
      }
    }
  EXPECT_GT(apart, 150);
  EXPECT_GT(touching, 50);
}

TEST_F(SurfacePairs, OnLevelGroundAreClosedForms) {
  const std::vector<double> level(std::size_t{17} * 17, 1.0);
  const PlumbShape grounds[] = {scene_->make(shape_desc(PLUMB_PLANE)), scene_->make(flat_grid(16, 0.25).desc()),
                                scene_->make(field_desc(level, 17, 17, 0.25))};
  const PlumbShape shapes[] = {scene_->sphere(0.4), scene_->box({0.4, 0.4, 0.4}), scene_->capsule(0.2, 0.2),
                               cylinder(0.4, 0.4)};
  for (std::size_t g = 0; g < 3; ++g)
    for (const PlumbShape shape : shapes)
      for (const double height : {1e-3, 0.2, 3.0, -1e-3, -0.1}) {
        SCOPED_TRACE("ground " + std::to_string(g) + " height " + std::to_string(height));
        const PlumbPose low = {{0.1, g == 2 ? -1.0 : 0.0, 0.07}, {0, 0, 0, 1}},
                        at = {{0.3, height + 0.4, 0.2}, {0, 0, 0, 1}};
        const Answer answer = collide_both_ways({grounds[g], shape, low, at});
        EXPECT_NEAR(answer.distance, height, 1e-6);
        EXPECT_EQ(answer.points.empty(), height > 0);
        for (const PlumbPairPoint& point : answer.points) {
          EXPECT_NEAR(point.normal.y, 1, 1e-6);
          EXPECT_NEAR(point.position.y, -0.5 * point.depth, 1e-6);
        }
      }
}

/// Beyond all that the engine can square, too: a triangle is named where none is nearer than the next.
TEST_F(SurfacePairs, AreToldHoweverFarApart) {
  const std::vector<double> level(std::size_t{5} * 5, 1.0);
  for (const PlumbShape ground : {scene_->make(flat_grid(4, 0.25).desc()), scene_->make(field_desc(level, 5, 5, 0.25)),
                                  scene_->box({0.5, 0.5, 0.5})})
    for (const double far : {1e3, 1e30, 1e200, 1e300}) {
      const Answer answer = collide({ground, scene_->sphere(0.4), identity_pose(), {{far, 0, 0}, {0, 0, 0, 1}}});
      EXPECT_TRUE(answer.points.empty()) << far;
      EXPECT_NEAR(answer.distance / far, 1, 2e-3);
    }
}

TEST_F(SurfacePairs, OfCompoundsAreThoseOfTheirChildren) {
  const PlumbShape box = scene_->box({0.5, 0.2, 0.3}), round = cylinder(0.3, 0.3),
                   hills =
                       scene_->make(grid(10, 0.5, [](double x, double z) { return 0.3 * std::sin(2 * x + z); }).desc());
  const PlumbPose first = {{-0.5, 0.1, 0}, {0, 0, 0, 1}}, second = pose_about(0.5);
  std::vector<PlumbCompoundChild> children = {{box, first, 0, 0, {}}, {round, second, 0, 0, {}}};
  const PlumbShape compound = make_compound(*scene_, children);
  int touching = 0;
  for (int i = 0; i < 200; ++i) {
    const PlumbPose pose = pose_about(1), other = pose_about(1.5);
    for (const PlumbShape shape : {box, round, hills, compound}) {
      const Answer whole = collide({compound, shape, pose, other});
      double least = std::numeric_limits<double>::infinity();
      std::size_t points = 0;
      for (const PlumbCompoundChild& child : children) {
        const Quat64 q = normalized(to_quat64(pose.orientation)),
                     turn = normalized(q * normalized(to_quat64(child.pose.orientation)));
        const PlumbPose placed = {to_plumb_vec3(to_vec64(pose.position) + rotate(q, to_vec64(child.pose.position))),
                                  {turn.x, turn.y, turn.z, turn.w}};
        const Answer part = collide({child.shape, shape, placed, other});
        least = std::min(least, part.distance);
        points += part.points.size();
      }
      EXPECT_NEAR(whole.distance, least, 1e-6);
      EXPECT_EQ(whole.points.size(), points);
      std::set<std::uint64_t> features;
      for (const PlumbPairPoint& point : whole.points) features.insert(point.feature);
      EXPECT_EQ(features.size(), points) << "a feature twice";
      touching += points == 0 ? 0 : 1;
    }
  }
  EXPECT_GT(touching, 100);
}

}  // namespace
}  // namespace plumb::impulse::test
