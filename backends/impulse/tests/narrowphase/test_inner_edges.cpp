// Floors of blocks (narrowphase/inner_edges.hpp): what is flush is one plane, and what is not is an edge.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {
namespace {

constexpr PlumbNeeds kEdgeNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_FILTERS;
constexpr double kDegrees = std::numbers::pi / 180;

PlumbQuat about_y(double angle) { return {0, std::sin(angle / 2), 0, std::cos(angle / 2)}; }

/// Blocks whose tops are at y = 0, over the square of 12 m about the origin.
using Paving = std::function<void(Scene&)>;
void squares(Scene& scene) {
  const PlumbShape block = scene.box({0.5, 0.5, 0.5});
  for (int i = 0; i < 12; ++i)
    for (int j = 0; j < 12; ++j) scene.add_static(block, {i - 5.5, -0.5, j - 5.5});
}
/// Rows are shifted against each other, and no two neighbours are as thick.
void bricks(Scene& scene) {
  const PlumbShape blocks[] = {scene.box({0.6, 0.05, 0.25}), scene.box({0.6, 1, 0.25})};
  for (int j = 0; j < 24; ++j)
    for (int i = -1; i < 11; ++i) {
      const double half = (i + j) % 2 == 0 ? 0.05 : 1;
      scene.add_static(blocks[(i + j) % 2 == 0 ? 0 : 1], {1.2 * i - 5.4 + 0.37 * (j % 3), -half, 0.5 * j - 5.75});
    }
}
/// Large ones beside many small ones.
void mixed(Scene& scene) {
  const PlumbShape large = scene.box({1, 0.2, 1}), small = scene.box({0.25, 0.3, 0.25});
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) {
      if ((i + j) % 2 == 0) scene.add_static(large, {2 * i - 5.0, -0.2, 2 * j - 5.0});
      for (int k = 0; k < 16 && (i + j) % 2 != 0; ++k)
        scene.add_static(small, {2 * i - 5.75 + 0.5 * (k % 4), -0.3, 2 * j - 5.75 + 0.5 * (k / 4)});
    }
}

PlumbShape wheel(Scene& scene) {
  PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
  desc.radius = 0.3;
  desc.half_height = 0.1;
  return scene.make(desc);
}

class Pavings : public ::testing::TestWithParam<Paving> {};

TEST_P(Pavings, WhatRollsRollsAsOverASlab) {
  struct Rider {
    double radius;
    double hop;  // share of the speed; of a wheel more, for an edge cuts the line on which it rolls
    PlumbShape (*make)(Scene&);
  };
  const Rider riders[] = {{0.5, 0.003, [](Scene& s) { return s.sphere(0.5); }},
                          {0.1, 0.003, [](Scene& s) { return s.sphere(0.1); }},
                          {0.3, 0.003, [](Scene& s) { return s.capsule(0.3, 0.4); }},
                          {0.3, 0.01, wheel}};
  for (const Rider& rider : riders)
    for (const double speed : {0.5, 3.0}) {
      Scene scene(engine(), kEdgeNeeds, {0, -9.81, 0}, 1);
      GetParam()(scene);
      scene.body.filter.category = 2;  // riders pass through each other
      scene.body.filter.mask = 1;
      const PlumbShape shape = rider.make(scene);
      std::vector<PlumbBody> bodies;
      std::vector<PlumbVec3> from, along;
      for (int i = 0; i < 16; ++i) {
        const double angle = (22.5 * i + 10) * kDegrees;
        along.push_back({std::cos(angle), 0, std::sin(angle)});
        from.push_back({0.31 * (i % 4) - 0.45, rider.radius, 0.29 * (i / 4) - 0.4});
        // The axis, which is the body's y, lies across the heading.
        const PlumbQuat turn = about_y(-angle), lie = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
        const PlumbQuat laid = {turn.w * lie.x + turn.y * lie.z, turn.y * lie.w + turn.w * lie.y,
                                turn.w * lie.z - turn.y * lie.x, turn.w * lie.w - turn.y * lie.y};
        bodies.push_back(scene.add(shape, from.back(), laid));
        scene.write(PLUMB_FIELD_VELOCITY, bodies.back(),
                    {speed * along.back().x, 0, speed * along.back().z, speed / rider.radius * along.back().z, 0,
                     -speed / rider.radius * along.back().x});
      }
      const int steps = static_cast<int>(60 * std::min(4.0 / speed, 4.0));
      for (int step = 0; step < steps; ++step) {
        scene.run(1);
        for (std::size_t i = 0; i < bodies.size() && step > 10; ++i)
          EXPECT_LT(std::abs(scene.velocity(bodies[i])[1]), rider.hop * speed)
              << "rider " << &rider - riders << " at " << speed << ", " << i << ", step " << step;
      }
      const auto poses = scene.poses();
      for (std::size_t i = 0; i < bodies.size(); ++i) {
        const PlumbVec3& to = poses[poses.size() - bodies.size() + i].position;
        const double x = to.x - from[i].x, z = to.z - from[i].z, way = speed * steps / 60;
        EXPECT_NEAR(x * along[i].x + z * along[i].z, way, 0.005 * way);
        EXPECT_NEAR(z * along[i].x - x * along[i].z, 0, 0.005 * way);
      }
    }
}
std::string name_of(const ::testing::TestParamInfo<Paving>& paving) {
  const char* names[] = {"Squares", "Bricks", "Mixed"};
  return names[paving.index];
}
INSTANTIATE_TEST_SUITE_P(Of, Pavings, ::testing::Values(squares, bricks, mixed), name_of);

/// From the highest point of a slope of 20 degrees, turned about y, far from the origin: as over one slab.
TEST(InnerEdges, ASlopeOfBlocksIsASlope) {
  const PlumbQuat tilt = {0, 0, -std::sin(10 * kDegrees), std::cos(10 * kDegrees)}, yaw = about_y(0.7);
  const PlumbQuat turn = {yaw.y * tilt.z, yaw.y * tilt.w, yaw.w * tilt.z, yaw.w * tilt.w};
  const auto turned = [&](const PlumbVec3& v) {
    const PlumbVec3 q{turn.x, turn.y, turn.z};
    const PlumbVec3 t{2 * (q.y * v.z - q.z * v.y), 2 * (q.z * v.x - q.x * v.z), 2 * (q.x * v.y - q.y * v.x)};
    return PlumbVec3{1e5 + v.x + turn.w * t.x + q.y * t.z - q.z * t.y, v.y + turn.w * t.y + q.z * t.x - q.x * t.z,
                     -2e5 + v.z + turn.w * t.z + q.x * t.y - q.y * t.x};
  };
  std::vector<PlumbPose> ends;
  for (const bool whole : {true, false}) {
    Scene scene(engine(), kEdgeNeeds, {0, -9.81, 0}, 1);
    if (whole)
      scene.add_static(scene.box({10, 0.5, 1}), turned({0, -0.5, 0}), turn);
    else
      for (int i = 0; i < 20; ++i) scene.add_static(scene.box({0.5, 0.5, 1}), turned({i - 9.5, -0.5, 0}), turn);
    const PlumbBody ball = scene.add(scene.sphere(0.25), turned({-9, 0.25, 0}));
    scene.run(120);
    (void)ball;
    ends.push_back(scene.poses().back());
  }
  EXPECT_NEAR(ends[0].position.x, ends[1].position.x, 0.01);
  EXPECT_NEAR(ends[0].position.y, ends[1].position.y, 0.01);
  EXPECT_NEAR(ends[0].position.z, ends[1].position.z, 0.01);
}

TEST(InnerEdges, TheLastBlockEndsAsASlabDoes) {
  std::vector<PlumbVec3> ends;
  for (const bool whole : {true, false}) {
    Scene scene(engine(), kEdgeNeeds, {0, -9.81, 0}, 1);
    if (whole)
      scene.add_static(scene.box({2, 0.5, 1}), {0, -0.5, 0});
    else
      for (int i = 0; i < 4; ++i) scene.add_static(scene.box({0.5, 0.5, 1}), {i - 1.5, -0.5, 0});
    const PlumbBody ball = scene.add(scene.sphere(0.5), {1.2, 0.5, 0.1});
    scene.write(PLUMB_FIELD_VELOCITY, ball, {0.5, 0, 0, 0, 0, -1});
    scene.run(150);
    ends.push_back(scene.poses().back().position);
  }
  EXPECT_LT(ends[0].y, 0) << "it rolls off";
  EXPECT_NEAR(ends[0].x, ends[1].x, 0.01);
  EXPECT_NEAR(ends[0].y, ends[1].y, 0.02);
}

TEST(InnerEdges, AStepStopsABallAndTheUnevennessOfABuilderDoesNot) {
  for (const double height : {0.1, 0.0005}) {
    Scene scene(engine(), kEdgeNeeds, {0, -9.81, 0}, 1);
    scene.add_static(scene.box({2, 0.5, 1}), {-2, -0.5, 0});
    scene.add_static(scene.box({2, 0.5, 1}), {2, -0.5 + height, 0});
    const PlumbBody ball = scene.add(scene.sphere(0.5), {-1, 0.5, 0});
    scene.write(PLUMB_FIELD_VELOCITY, ball, {0.8, 0, 0, 0, 0, -1.6});
    scene.run(180);
    const double x = scene.poses().back().position.x;
    if (height == 0.1)
      EXPECT_LT(x, 0);
    else
      EXPECT_NEAR(x, -1 + 0.8 * 3, 0.05);
  }
}

/// A ball that is wider than the hole lies on its four edges.
TEST(InnerEdges, WhereABlockGoesThereAreEdges) {
  Scene scene(engine(), kEdgeNeeds, {0, -9.81, 0}, 1);
  const PlumbShape block = scene.box({0.5, 0.5, 0.5});
  PlumbBody middle = 0;
  for (int i = -1; i < 2; ++i)
    for (int j = -1; j < 2; ++j) {
      const PlumbBody body = scene.add_static(block, {1.0 * i, -0.5, 1.0 * j});
      if (i == 0 && j == 0) middle = body;
    }
  scene.add(scene.sphere(0.7), {0.03, 0.7, -0.02});
  scene.run(60);
  EXPECT_NEAR(scene.poses().back().position.y, 0.7, 1e-3);
  scene.remove(middle);
  scene.run(600);
  const PlumbVec3 at = scene.poses().back().position;
  EXPECT_NEAR(at.y, std::sqrt(0.7 * 0.7 - 0.5 * 0.5), 2e-3);
  EXPECT_NEAR(at.x, 0, 2e-3);
  EXPECT_NEAR(at.z, 0, 2e-3);
}

TEST(InnerEdges, WhatARiderDoesNotTouchCoversNothing) {
  std::vector<PlumbVec3> ends;
  for (const int beside : {0, 1, 2, 3}) {  // nobody, who is not touched, who is, a sensor
    Scene scene(engine(), kEdgeNeeds | PLUMB_NEED_SENSORS, {0, -9.81, 0}, 1);
    const PlumbShape block = scene.box({0.5, 0.5, 0.5});
    scene.add_static(block, {0, -0.5, 0});
    if (beside == 1) scene.body.filter.category = 4;
    if (beside == 3) scene.body.flags = PLUMB_BODY_SENSOR;
    if (beside != 0) scene.add_static(block, {1, -0.5, 0});
    scene.body.filter.category = 1;
    scene.body.filter.mask = 1;
    scene.body.flags = 0;
    const PlumbBody ball = scene.add(scene.sphere(0.3), {0, 0.3, 0});
    scene.write(PLUMB_FIELD_VELOCITY, ball, {0.5, 0, 0, 0, 0, -0.5 / 0.3});
    scene.run(90);
    ends.push_back(scene.poses().back().position);
  }
  EXPECT_EQ(ends[0].x, ends[1].x);
  EXPECT_EQ(ends[0].y, ends[1].y);
  EXPECT_EQ(ends[0].x, ends[3].x);
  EXPECT_EQ(ends[0].y, ends[3].y);
  EXPECT_LT(ends[0].y, 0.25) << "it rolls off";
  EXPECT_NEAR(ends[2].y, 0.3, 1e-3);
}

/// What slides on a face sees faces, a hull as well.
TEST(InnerEdges, AHullSlidesOverBlocksAsOverASlab) {
  std::vector<PlumbVec3> points;
  for (int i = 0; i < 24; ++i) {  // a cube without its corners
    const int axis = i / 8, a = i & 1, b = i >> 1 & 1, c = i >> 2 & 1;
    double v[3];
    v[axis] = a != 0 ? 0.4 : -0.4;
    v[(axis + 1) % 3] = b != 0 ? 0.3 : -0.3;
    v[(axis + 2) % 3] = c != 0 ? 0.3 : -0.3;
    points.push_back({v[0], v[1], v[2]});
  }
  Scene scene(engine(), kEdgeNeeds, {0, -9.81, 0}, 1);
  squares(scene);
  const PlumbBody rider = scene.add(scene.hull(points), {-3.1, 0.4, 0.2}, about_y(0.3));
  scene.write(PLUMB_FIELD_VELOCITY, rider, {6, 0, 0.4, 0, 0, 0});
  const PlumbVec3 from = scene.poses().back().position;
  scene.run(150);
  const PlumbVec3 to = scene.poses().back().position;
  EXPECT_NEAR(std::hypot(to.x - from.x, to.z - from.z), (36 + 0.16) / (2 * 0.5 * 9.81), 0.05);
}

}  // namespace
}  // namespace plumb::impulse::test
