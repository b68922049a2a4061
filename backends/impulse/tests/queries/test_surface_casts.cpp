// Casts and overlaps of all convex shapes against planes, meshes and height fields, and with cylinders: distances by
// brute force over all triangles, and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/rigs/surface_fixture.hpp"

namespace plumb::impulse::test {
namespace {

class SurfaceCasts : public SurfaceQueries {
 protected:
  static Features moved(Features shape, const V& by) {
    shape.move(by);
    return shape;
  }
  /// Of the ground, what the shape is nearest to and how far; beyond `enough` it is not looked at closely.
  static double distance_to(const Ground& ground, const Features& shape, const V& middle, double reach, double enough) {
    double least = std::numeric_limits<double>::infinity();
    for (const Corners& c : ground.triangles) {
      const double bound = length(middle_of(c) - middle) - reach_of(c) - reach;
      if (bound > std::min(enough, least)) continue;
      least = std::min(least, distance(features_of(c), shape));
    }
    return least;
  }
  PlumbShape cylinder(double radius, double half) {
    PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
    desc.radius = radius;
    desc.half_height = half;
    return scene_->make(desc);
  }
};

TEST_F(SurfaceCasts, OverlapsAreThoseOfBruteForce) {
  const double near = kEpsilon < 1e-10 ? 1e-9 : 2e-5;
  int overlapping = 0, apart = 0;
  for (int round = 0; round < 6; ++round) {
    clear();
    make_grounds();
    std::vector<PlumbOverlap> overlaps;
    std::vector<Shape> shapes;
    for (int i = 0; i < 60; ++i) {
      shapes.push_back(random_shape(dice_, pool_, i % 3 == 0 ? 1 : 0.3));
      overlaps.push_back({shape_in_world(shapes.back()), pose_about(3), kSeesAll});
    }
    const auto parts = by_query(ask().overlap_shapes(overlaps).hits, overlaps.size());
    for (std::size_t q = 0; q < overlaps.size(); ++q)
      for (const Ground& ground : grounds_) {
        const V at = to_vec64(overlaps[q].pose.position);
        const Features shape =
            features_of(shapes[q], pool_.host(), normalized(to_quat64(overlaps[q].pose.orientation)), at);
        const double apart_by = distance_to(ground, shape, at, static_cast<double>(shapes[q].reach), 1);
        const auto hit =
            std::find_if(parts[q].begin(), parts[q].end(), [&](const PlumbHit& h) { return h.body == ground.body; });
        EXPECT_TRUE((hit != parts[q].end()) == (apart_by <= 0) || std::abs(apart_by) < near) << apart_by;
        ++(apart_by > 0 ? apart : overlapping);
        if (hit != parts[q].end() && ground.numbered) {
          EXPECT_LT(distance(features_of(ground.triangles.at(hit->child)), shape), near) << "another triangle";
        }
      }
  }
  EXPECT_GT(overlapping, 80);
  EXPECT_GT(apart, 300);
}

TEST_F(SurfaceCasts, EndWhereTheyTouchAndPassWhatTheyMiss) {
  const double near = kEpsilon < 1e-10 ? 1e-8 : 5e-5;
  int hits = 0, misses = 0, starts = 0;
  for (int round = 0; round < 5; ++round) {
    clear();
    make_grounds();
    std::vector<PlumbCast> casts;
    std::vector<Shape> shapes;
    for (int i = 0; i < 60; ++i) {
      const PlumbRay ray = random_ray(i % 3 == 0 ? 1 : 3);
      shapes.push_back(random_shape(dice_, pool_, 0.4));
      PlumbPose pose = pose_about(4);
      pose.position = ray.origin;
      casts.push_back({shape_in_world(shapes.back()), pose, ray.translation, kSeesAll});
    }
    const Hits closest = ask().cast_shapes(PLUMB_HIT_CLOSEST, casts);
    const std::vector<PlumbHit> nearest(closest.hits.begin(), closest.hits.end());
    const auto parts = by_query(ask().cast_shapes(PLUMB_HIT_ALL, casts).hits, casts.size());
    for (std::size_t c = 0; c < casts.size(); ++c) {
      const V from = to_vec64(casts[c].pose.position), way = to_vec64(casts[c].translation);
      const Features moving =
          features_of(shapes[c], pool_.host(), normalized(to_quat64(casts[c].pose.orientation)), {0, 0, 0});
      const double reach = static_cast<double>(shapes[c].reach);
      EXPECT_EQ(nearest[c].body, parts[c].empty() ? 0 : parts[c][0].body);
      for (const Ground& ground : grounds_) {
        SCOPED_TRACE("round " + std::to_string(round) + " cast " + std::to_string(c));
        const auto at = [&](double fraction) {
          const V place = from + fraction * way;
          return distance_to(ground, moved(moving, place), place, reach, 0.1);
        };
        const auto hit =
            std::find_if(parts[c].begin(), parts[c].end(), [&](const PlumbHit& h) { return h.body == ground.body; });
        const double end = hit == parts[c].end() ? 1 : hit->fraction;
        for (int k = 0; k < 40; ++k) EXPECT_GT(at(end * k / 40.0), -near - (end == 0 ? 1e9 : 0)) << "passes through";
        if (hit == parts[c].end()) {
          EXPECT_GT(at(1), -near);
          ++misses;
          continue;
        }
        const V n = to_vec64(hit->normal), on = to_vec64(hit->position);
        EXPECT_NEAR(length(n), 1, 1e-5);
        if (hit->fraction == 0) {
          EXPECT_LE(at(0), near);
          ++starts;
          continue;
        }
        ++hits;
        EXPECT_NEAR(at(hit->fraction), 0, near);
        EXPECT_LT(dot(n, way), 0) << "it moves against what it hits";
        const Features there = moved(moving, from + hit->fraction * way);
        EXPECT_NEAR(-high(there, -n), dot(n, on), 2e-4) << "the normal parts them at the place";
        if (!ground.numbered) continue;
        const Corners& touched = ground.triangles.at(hit->child);
        EXPECT_NEAR(distance(features_of(touched), there), 0, near) << "another triangle";
        EXPECT_NEAR(high(features_of(touched), n), dot(n, on), 2e-4) << "and does not lie on it";
      }
    }
  }
  EXPECT_GT(hits, 150);
  EXPECT_GT(misses, 150);
  EXPECT_GT(starts, 20);
}

TEST_F(SurfaceCasts, OfCylindersTouchTrianglesAndConvexShapes) {
  const double radius = 0.35, half = 0.25, reach = std::hypot(radius, half), near = kEpsilon < 1e-10 ? 1e-7 : 5e-5;
  int hits = 0, starts = 0, overlapping = 0, apart = 0;
  for (int round = 0; round < 4; ++round) {
    clear();
    items_.clear();
    make_grounds();
    for (int i = 0; i < 6; ++i) add({0, random_hull(dice_, pool_, 0.7, 12), pose_about(3), kSeesAll}, false);
    for (const Item& item : items_) {  // known by their surface: fans of their faces
      const Features solid = features_of(item.shape, pool_.host(), normalized(to_quat64(item.pose.orientation)),
                                         to_vec64(item.pose.position));
      Ground ground = {item.body, false, {}};
      for (const Features::Face& face : solid.faces)
        for (std::size_t k = 2; k < face.loop.size(); ++k)
          ground.triangles.push_back({face.loop[0], face.loop[k - 1], face.loop[k]});
      grounds_.push_back(ground);
    }
    const auto distance_from = [&](const Ground& ground, const PlumbPose& pose, const V& by) {
      const PlacedCylinder placed = {radius, half, normalized(to_quat64(pose.orientation)),
                                     to_vec64(pose.position) + by};
      double least = std::numeric_limits<double>::infinity();
      for (const Corners& c : ground.triangles)
        if (length(middle_of(c) - placed.at) - reach_of(c) - reach < std::min(0.1, least))
          least = std::min(least, distance(c, placed));
      return least;
    };
    const PlumbShape shape = cylinder(radius, half);
    for (int i = 0; i < 60; ++i) {
      SCOPED_TRACE("round " + std::to_string(round) + " cast " + std::to_string(i));
      const PlumbRay ray = random_ray(2.5);
      PlumbPose pose = pose_about(4);
      pose.position = ray.origin;
      const V way = to_vec64(ray.translation);
      const PlumbCast cast = {shape, pose, ray.translation, kSeesAll};
      const PlumbOverlap overlap = {shape, pose_about(2.5), kSeesAll};
      const Hits found = ask().cast_shapes(PLUMB_HIT_ALL, {&cast, 1});
      const std::vector<PlumbHit> touched(found.hits.begin(), found.hits.end());
      const Hits over = ask().overlap_shapes({&overlap, 1});
      for (const Ground& ground : grounds_) {
        const auto is_it = [&](const PlumbHit& h) { return h.body == ground.body; };
        const auto at = [&](double fraction) { return distance_from(ground, pose, fraction * way); };
        const auto hit = std::find_if(touched.begin(), touched.end(), is_it);
        const double end = hit == touched.end() ? 1 : hit->fraction;
        const bool solid = !items_.empty() && slot_of(ground.body) >= slot_of(items_[0].body);  // it may be within
        if (hit != touched.end() && end == 0) {
          if (!solid) {
            EXPECT_LT(at(0), near);
          }
          ++starts;
        } else {
          for (int k = 0; k < 20; ++k) EXPECT_GT(at(end * k / 20.0), 0.0) << "passes through";
          if (hit != touched.end()) {
            const PlacedCylinder there = {radius, half, normalized(to_quat64(pose.orientation)),
                                          to_vec64(pose.position) + end * way};
            EXPECT_NEAR(at(end), 0, near);
            EXPECT_NEAR(-there.high(-to_vec64(hit->normal)), dot(to_vec64(hit->normal), to_vec64(hit->position)), near);
            ++hits;
          }
        }
        const bool is_over = std::any_of(over.hits.begin(), over.hits.end(), is_it);
        const double distance = distance_from(ground, overlap.pose, {0, 0, 0});
        if (is_over ? !solid && distance > near : distance == 0) {
          ADD_FAILURE() << "an overlap " << (is_over ? "that is none" : "that is missed") << ": " << distance;
        }
        ++(is_over ? overlapping : apart);
      }
    }
  }
  EXPECT_GT(hits, 200);
  EXPECT_GT(starts, 20);
  EXPECT_GT(overlapping, 60);
  EXPECT_GT(apart, 500);
}

TEST_F(SurfaceCasts, AtPlanesAreClosedForms) {
  scene_->add_static(scene_->make(shape_desc(PLUMB_PLANE)), {0, 1, 0});
  const double side = std::sqrt(0.5);
  const PlumbQuat tilted = {0, 0, std::sin(M_PI / 8), std::cos(M_PI / 8)};
  const struct {
    PlumbShape shape;
    PlumbQuat turn;
    double below;  ///< how far it reaches down
  } cases[] = {{scene_->sphere(0.5), {0, 0, 0, 1}, 0.5},
               {scene_->box({0.5, 0.5, 0.5}), tilted, side},
               {scene_->capsule(0.25, 0.5), tilted, 0.25 + 0.5 * side},
               {cylinder(0.5, 0.5), {0, 0, 0, 1}, 0.5},
               {cylinder(0.5, 0.5), tilted, side}};
  for (const auto& [shape, turn, below] : cases) {
    const PlumbCast down = {shape, {{3, 6, 2}, turn}, {1, -10, 0}, kSeesAll},
                    level = {shape, {{3, 6, 2}, turn}, {9, 0, 0}, kSeesAll},
                    within = {shape, {{3, 1 + 0.9 * below, 2}, turn}, {9, 5, 0}, kSeesAll};
    const PlumbHit hit = ask().cast_shapes(PLUMB_HIT_CLOSEST, {&down, 1}).hits[0];
    EXPECT_NEAR(hit.fraction, (5 - below) / 10, 1e-6);
    EXPECT_NEAR(hit.normal.y, 1, 1e-12);
    EXPECT_NEAR(hit.position.y, 1, 1e-12);
    EXPECT_EQ(ask().cast_shapes(PLUMB_HIT_ALL, {&level, 1}).hits.size(), 0U);
    const PlumbHit start = ask().cast_shapes(PLUMB_HIT_CLOSEST, {&within, 1}).hits[0];
    EXPECT_EQ(start.fraction, 0);
    EXPECT_NEAR(start.normal.y, 1, 1e-6);
    const PlumbOverlap over = {shape, within.pose, kSeesAll}, above = {shape, {{0, 1.01 + below, 0}, turn}, kSeesAll};
    EXPECT_EQ(ask().overlap_shapes({&over, 1}).hits.size(), 1U);
    EXPECT_EQ(ask().overlap_shapes({&above, 1}).hits.size(), 0U);
  }
}

/// Over inner edges of what is level the normal is up, and the way out of an overlap too.
TEST_F(SurfaceCasts, OntoLevelGroundFeelNoEdges) {
  for (const bool field : {false, true}) {
    clear();
    if (field)
      add_field(field_desc(std::vector<double>(std::size_t{33} * 33, 0.0), 33, 33, 0.25), identity_pose());
    else
      add_mesh(flat_grid(32, 0.25), identity_pose(), false);
    const PlumbShape shapes[] = {scene_->sphere(0.4), scene_->box({0.4, 0.4, 0.4}), scene_->capsule(0.4, 0.3),
                                 cylinder(0.4, 0.4)};
    for (const PlumbShape shape : shapes)
      for (int i = 0; i < 40; ++i) {
        const PlumbVec3 from = {dice_.uniform(-2, 2), 2, dice_.uniform(-2, 2)};
        const PlumbPose pose = {from, {0, 0, 0, 1}}, low = {{from.x, 0.3, from.z}, {0, 0, 0, 1}};
        const PlumbCast cast = {shape, pose, {dice_.uniform(-1, 1), -4, dice_.uniform(-1, 1)}, kSeesAll},
                        within = {shape, low, cast.translation, kSeesAll};
        const PlumbHit hit = ask().cast_shapes(PLUMB_HIT_CLOSEST, {&cast, 1}).hits[0];
        const double lowest = shape == shapes[2] ? 0.7 : 0.4;
        EXPECT_NEAR(hit.fraction, (2 - lowest) / 4, 1e-6);
        EXPECT_NEAR(hit.normal.y, 1, 1e-6);
        EXPECT_NEAR(hit.position.y, 0, 1e-6);
        const PlumbHit start = ask().cast_shapes(PLUMB_HIT_CLOSEST, {&within, 1}).hits[0];
        EXPECT_EQ(start.fraction, 0);
        EXPECT_NEAR(start.normal.y, 1, 1e-6);
        EXPECT_NEAR(start.position.y, -0.5 * (lowest - 0.3), 1e-5) << "midway in the overlap";
      }
  }
}

}  // namespace
}  // namespace plumb::impulse::test
