// plumb.closest/1 against distances by brute force over all features and triangles, and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "tests/rigs/surface_fixture.hpp"

namespace plumb::impulse::test {
namespace {

constexpr bool kInDouble = kEpsilon < 1e-10;

class Closest : public SurfaceQueries {
 protected:
  std::vector<PlumbClosest> find(PlumbHitMode mode, const std::vector<PlumbProbe>& probes) {
    const ClosestBodies found = scene_->world().closest()->closest_bodies(mode, probes);
    check(scene_->world(), found.result);
    return {found.rows.begin(), found.rows.end()};
  }
  /// The rows of each probe; that they are in order, and the nearest alone as the first of all, is seen here.
  std::vector<std::vector<PlumbClosest>> by_probe(const std::vector<PlumbProbe>& probes) {
    const std::vector<PlumbClosest> nearest = find(PLUMB_HIT_CLOSEST, probes), all = find(PLUMB_HIT_ALL, probes);
    std::vector<std::vector<PlumbClosest>> parts(probes.size());
    for (const PlumbClosest& row : all) {
      std::vector<PlumbClosest>& part = parts.at(row.probe);
      if (!part.empty()) {
        EXPECT_LT(std::pair(part.back().distance, slot_of(part.back().body)),
                  std::pair(row.distance, slot_of(row.body)));
      }
      part.push_back(row);
    }
    EXPECT_EQ(nearest.size(), probes.size());
    for (std::size_t i = 0; i < nearest.size(); ++i) {
      EXPECT_EQ(nearest[i].probe, i);
      if (parts[i].empty()) {
        EXPECT_EQ(nearest[i].body, 0U);
        EXPECT_TRUE(std::isnan(nearest[i].distance));
      } else {
        EXPECT_EQ(std::memcmp(&nearest[i], parts[i].data(), offsetof(PlumbClosest, on_probe)), 0) << "probe " << i;
      }
    }
    return parts;
  }
  static const PlumbClosest* row_of_body(const std::vector<PlumbClosest>& rows, PlumbBody body) {
    const auto at = std::find_if(rows.begin(), rows.end(), [&](const PlumbClosest& row) { return row.body == body; });
    return at == rows.end() ? nullptr : &*at;
  }
  /// A row's points and normal are what tells that nothing is nearer: the planes across the normal part both shapes.
  /// Places are from `from`.
  template <class High>
  static void expect_parted(const PlumbClosest& row, const V& from, const Features& probe, const High& high_of_body,
                            double near) {
    const V n = to_vec64(row.normal), on_probe = to_vec64(row.on_probe) - from, on_body = to_vec64(row.on_body) - from;
    EXPECT_NEAR(length(n), 1, 1e-12);
    EXPECT_LT(length(on_body - on_probe - row.distance * n), near);
    EXPECT_NEAR(high(probe, n), dot(n, on_probe), near);
    EXPECT_NEAR(-high_of_body(-n), dot(n, on_body), near);
  }
  PlumbShape cylinder(double radius, double half) {
    PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
    desc.radius = radius;
    desc.half_height = half;
    return scene_->make(desc);
  }
};

TEST_F(Closest, OfConvexShapesAreThoseOfBruteForce) {
  int apart = 0, overlapping = 0, far = 0, hidden = 0;
  for (int round = 0; round < 6; ++round) {
    items_.clear();
    make(30, 4, {0, round % 3 == 0 ? 0.0 : -1e5, 0});
    std::vector<PlumbProbe> probes;
    std::vector<Shape> shapes;
    for (int i = 0; i < 60; ++i) {
      shapes.push_back(random_shape(dice_, pool_, i % 2 == 0 ? 1 : 0.05));
      probes.push_back({shape_in_world(shapes.back()), pose_about(4), dice_.uniform(0.1, 6), {2, 0b110, 0, 0}});
    }
    const auto parts = by_probe(probes);
    for (const Item& item : items_) {
      const Target at = target(item);
      for (std::size_t i = 0; i < probes.size(); ++i) {
        SCOPED_TRACE("round " + std::to_string(round) + " probe " + std::to_string(i));
        const V from = to_vec64(probes[i].pose.position);
        const Features body = features_of(at.shape, pool_.host(), at.turn, at.place - from);
        const Features probe = features_of(shapes[i], pool_.host(), to_quat64(probes[i].pose.orientation), {0, 0, 0});
        const double distance = reference::distance(body, probe);
        const PlumbClosest* row = row_of_body(parts[i], item.body);
        if (!may_touch(probes[i].filter, item.filter)) {
          EXPECT_EQ(row, nullptr) << "seen although the filter forbids it";
          ++hidden;
          continue;
        }
        const double near = 1e-6;  // the faces of hulls are floats, of which neighbours may be a little concave
        EXPECT_TRUE((row != nullptr) == (distance <= probes[i].most_distance) ||
                    std::abs(distance - probes[i].most_distance) < near);
        ++(row == nullptr ? far : distance > 0 ? apart : overlapping);
        if (row == nullptr) continue;
        EXPECT_NEAR(row->distance, std::max(distance, 0.0), near);
        EXPECT_EQ(row->distance == 0, std::isnan(row->normal.x));
        if (row->distance > 1e-3)
          expect_parted(
              *row, from, probe, [&](const V& n) { return high(body, n); }, near);
      }
    }
  }
  EXPECT_GT(apart, 1500);
  EXPECT_GT(overlapping, 40);
  EXPECT_GT(far, 1500);
  EXPECT_GT(hidden, 1000);
}

TEST_F(Closest, OfSurfacesAreThoseOfBruteForce) {
  const double near = kInDouble ? 1e-8 : 5e-5;  // where the engine's triangles are, which are floats
  int apart = 0, overlapping = 0, far = 0;
  for (int round = 0; round < 5; ++round) {
    clear();
    make_grounds();
    std::vector<PlumbProbe> probes;
    std::vector<Shape> shapes;
    for (int i = 0; i < 60; ++i) {
      shapes.push_back(random_shape(dice_, pool_, i % 3 == 0 ? 1 : 0.3));
      probes.push_back({shape_in_world(shapes.back()), pose_about(5), dice_.uniform(0.1, 4), kSeesAll});
    }
    const auto parts = by_probe(probes);
    for (std::size_t i = 0; i < probes.size(); ++i)
      for (const Ground& ground : grounds_) {
        SCOPED_TRACE("round " + std::to_string(round) + " probe " + std::to_string(i));
        const V from = to_vec64(probes[i].pose.position);
        const Features probe =
            features_of(shapes[i], pool_.host(), normalized(to_quat64(probes[i].pose.orientation)), from);
        double distance = std::numeric_limits<double>::infinity();
        for (const Corners& c : ground.triangles)
          if (length(middle_of(c) - from) - reach_of(c) - static_cast<double>(shapes[i].reach) < distance)
            distance = std::min(distance, reference::distance(features_of(c), probe));
        const PlumbClosest* row = row_of_body(parts[i], ground.body);
        EXPECT_TRUE((row != nullptr) == (distance <= probes[i].most_distance) ||
                    std::abs(distance - probes[i].most_distance) < near);
        ++(row == nullptr ? far : distance > 0 ? apart : overlapping);
        if (row == nullptr) continue;
        EXPECT_NEAR(row->distance, std::max(distance, 0.0), near);
        EXPECT_EQ(row->child != 0 && !ground.numbered, false);
        if (!ground.numbered) continue;
        const Features triangle = features_of(ground.triangles.at(row->child));
        EXPECT_NEAR(std::max(reference::distance(triangle, probe), 0.0), row->distance, near) << "another triangle";
        if (row->distance > 0.01)
          expect_parted(
              *row, {0, 0, 0}, probe, [&](const V& n) { return high(triangle, n); }, 10 * near);
      }
  }
  EXPECT_GT(apart, 150);
  EXPECT_GT(overlapping, 15);
  EXPECT_GT(far, 100);
}

/// Cylinders, as bodies and as probes: a small ball about a point tells the distance to the point.
TEST_F(Closest, OfCylindersAreClosedForms) {
  const double near = kInDouble ? 1e-9 : 2e-6;
  const PlumbShape round = cylinder(0.8, 0.5), ball = scene_->sphere(0.125);
  for (int i = 0; i < 200; ++i) {
    const PlumbPose pose = pose_about(1), place = pose_about(3);
    const PlumbBody body = scene_->add(round, pose.position, pose.orientation);
    double row[7];
    check(scene_->world(), scene_->world().read(PLUMB_FIELD_POSE, {&body, 1}, rows_over(std::span(&row, 1))));
    const PlacedCylinder solid = {
        0.8, 0.5, normalized(Quat64{row[3], row[4], row[5], row[6]}), {row[0], row[1], row[2]}};
    const double distance = std::max(solid.distance_to(to_vec64(place.position)) - 0.125, 0.0);
    const PlumbClosest found = find(PLUMB_HIT_CLOSEST, {{ball, place, 100, kSeesAll}})[0];
    EXPECT_NEAR(found.distance, distance, near);
    check(scene_->world(), scene_->world().destroy_bodies({&body, 1}));
    // The other way round: the ball in the world, the cylinder as the probe.
    const PlumbBody small = scene_->add(ball, place.position);
    const PlumbClosest back = find(PLUMB_HIT_CLOSEST, {{round, pose, 100, kSeesAll}})[0];
    EXPECT_NEAR(back.distance, distance, near);
    if (distance > 1e-3) {
      EXPECT_LT(length(to_vec64(back.normal) + to_vec64(found.normal)), 1e-4);
    }
    check(scene_->world(), scene_->world().destroy_bodies({&small, 1}));
  }
}

TEST_F(Closest, CountsDownToTheLastOfTenThousand) {
  std::vector<V> at;
  std::vector<PlumbBody> bodies;
  const PlumbShape ball = scene_->sphere(0.25);
  for (int i = 0; i < 10000; ++i) {
    const V place = {dice_.uniform(-60, 60), dice_.uniform(-60, 60), dice_.uniform(-60, 60)};
    at.push_back(place);
    bodies.push_back(i % 2 == 0 ? scene_->add(ball, to_plumb_vec3(place))
                                : scene_->add_static(ball, to_plumb_vec3(place)));
  }
  const PlumbShape probe = scene_->sphere(0.5);
  std::vector<PlumbProbe> probes;
  for (int i = 0; i < 5000; ++i) probes.push_back({probe, pose_about(70), i % 3 == 0 ? 1e30 : 3.0, kSeesAll});
  const std::vector<PlumbClosest> nearest = find(PLUMB_HIT_CLOSEST, probes);
  ASSERT_EQ(nearest.size(), probes.size());
  int none = 0;
  for (std::size_t i = 0; i < probes.size(); i += 7) {
    double least = std::numeric_limits<double>::infinity();
    for (const V& place : at) least = std::min(least, length(place - to_vec64(probes[i].pose.position)) - 0.75);
    if (least > probes[i].most_distance) {
      EXPECT_EQ(nearest[i].body, 0U);
      ++none;
      continue;
    }
    EXPECT_NEAR(nearest[i].distance, std::max(least, 0.0), 1e-9);
  }
  EXPECT_GT(none, 20);
  const std::vector<PlumbClosest> all = find(PLUMB_HIT_ALL, {{probe, {{0, 0, 0}, {0, 0, 0, 1}}, 1e30, kSeesAll}});
  EXPECT_EQ(all.size(), 10000U) << "a distance of any size is one";
}

TEST_F(Closest, AreTheSameBitsForAnyNumberOfThreads) {
  std::vector<PlumbClosest> first;
  for (const std::uint32_t threads : {1U, 2U, 5U}) {
    dice_ = Dice(31);
    scene_ = std::make_unique<Scene>(engine(), kNeeds, PlumbVec3{0, 0, 0}, threads);
    grounds_.clear();
    make_grounds();
    for (int i = 0; i < 200; ++i) add({0, random_shape(dice_, pool_, 0.5), pose_about(6), kSeesAll}, i % 2 == 0);
    const PlumbShape probe = cylinder(0.25, 0.5);
    std::vector<PlumbProbe> probes;
    for (int i = 0; i < 500; ++i) probes.push_back({probe, pose_about(8), 2, kSeesAll});
    std::vector<PlumbClosest> rows = find(PLUMB_HIT_CLOSEST, probes);
    const std::vector<PlumbClosest> all = find(PLUMB_HIT_ALL, probes);
    rows.insert(rows.end(), all.begin(), all.end());
    if (first.empty()) first = rows;
    ASSERT_EQ(rows.size(), first.size());
    EXPECT_EQ(std::memcmp(rows.data(), first.data(), rows.size() * sizeof(PlumbClosest)), 0) << threads << " threads";
  }
}

TEST_F(Closest, OfAnEmptyWorldAndOfNoProbesAreNone) {
  EXPECT_EQ(find(PLUMB_HIT_ALL, {}).size(), 0U);
  EXPECT_EQ(find(PLUMB_HIT_CLOSEST, {}).size(), 0U);
  const PlumbProbe probe = {scene_->sphere(1), {{0, 0, 0}, {0, 0, 0, 1}}, 1e300, kSeesAll};
  EXPECT_EQ(find(PLUMB_HIT_ALL, {probe, probe}).size(), 0U);
  EXPECT_EQ(find(PLUMB_HIT_CLOSEST, {probe, probe})[1].body, 0U);
}

/// Numbers whose squares a float, or a double, cannot hold.
TEST_F(Closest, AreFoundBeyondAllBounds) {
  const PlumbBody ball = scene_->add_static(scene_->sphere(1), {0, 0, 0});
  const PlumbShape probe = scene_->box({1, 2, 3});
  for (const double far : {1e18, 1e25, 1e36, 1e100, 1e200, 1e300}) {
    const PlumbClosest row = find(PLUMB_HIT_CLOSEST, {{probe, {{0, -far, 0}, {0, 0, 0, 1}}, 2 * far, kSeesAll}})[0];
    EXPECT_EQ(row.body, ball) << far;
    EXPECT_NEAR(row.distance / far, 1, 1e-9) << far;
    EXPECT_NEAR(row.normal.y, 1, 1e-9) << far;
    EXPECT_EQ(find(PLUMB_HIT_ALL, {{probe, {{0, -far, 0}, {0, 0, 0, 1}}, far / 2, kSeesAll}}).size(), 0U) << far;
  }
}

/// Bodies equally near: the lower slot is told, wherever the tree has them.
TEST_F(Closest, OfEqualOnesIsTheLowerSlot) {
  const PlumbShape ball = scene_->sphere(0.5);
  std::vector<PlumbBody> ring;
  for (const double x : {2.0, -2.0})
    for (int k = 0; k < 2; ++k) ring.push_back(scene_->add_static(ball, {k == 0 ? x : 0, 0, k == 0 ? 0 : x}));
  for (int order = 0; order < 4; ++order) {
    const std::vector<PlumbProbe> probe = {{ball, {{0, 0, 0}, {0, 0, 0, 1}}, 5, kSeesAll}};
    const auto part = by_probe(probe)[0];
    ASSERT_EQ(part.size(), ring.size());
    for (const PlumbClosest& row : part) EXPECT_EQ(row.distance, 1);
    const PlumbBody first = part[0].body;
    check(scene_->world(), scene_->world().destroy_bodies({&first, 1}));
    ring.erase(std::find(ring.begin(), ring.end(), first));
  }
}

}  // namespace
}  // namespace plumb::impulse::test
