// Rays against planes, meshes, height fields and cylinders: all triangles one by one in double, and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/rigs/surface_fixture.hpp"

namespace plumb::impulse::test {
namespace {

class SurfaceRays : public SurfaceQueries {
 protected:
  /// The hits on the grounds: never beyond what a ray surely meets, never before what it may meet.
  void compare(const std::vector<PlumbRay>& rays, double size) {
    const double rounding = 64 * static_cast<double>(kEpsilon) * size;
    const Hits closest = ask().cast_rays(PLUMB_HIT_CLOSEST, rays);
    ASSERT_EQ(closest.hits.size(), rays.size());
    const std::vector<PlumbHit> nearest(closest.hits.begin(), closest.hits.end());
    const auto parts = by_query(ask().cast_rays(PLUMB_HIT_ALL, rays).hits, rays.size());
    for (std::size_t r = 0; r < rays.size(); ++r) {
      SCOPED_TRACE("ray " + std::to_string(r));
      const V p = to_vec64(rays[r].origin), translation = to_vec64(rays[r].translation), d = unit(translation);
      const double far = length(translation);
      std::size_t expected = 0;
      for (const Ground& ground : grounds_) {
        double surely = std::numeric_limits<double>::infinity(), perhaps = surely;
        for (const Corners& c : ground.triangles) {
          const V n = unit(cross(c[1] - c[0], c[2] - c[0]));
          const double steep = std::max(std::abs(dot(n, d)), 1e-9), slack = rounding / steep;
          const double grown = 4 * slack / reach_of(c);
          if (const double s = passes(c, p, d, -grown); s >= slack && s <= far - slack)
            surely = std::min(surely, s + slack);
          if (const double s = passes(c, p, d, grown); s >= -slack && s <= far + slack)
            perhaps = std::min(perhaps, s - slack);
        }
        const auto hit =
            std::find_if(parts[r].begin(), parts[r].end(), [&](const PlumbHit& h) { return h.body == ground.body; });
        if (hit == parts[r].end()) {
          EXPECT_EQ(surely, std::numeric_limits<double>::infinity()) << "missed";
          continue;
        }
        ++expected;
        ++hits_;
        EXPECT_LE(hit->fraction * far, surely);
        EXPECT_GE(hit->fraction * far, perhaps);
        EXPECT_EQ(
            std::count_if(parts[r].begin(), parts[r].end(), [&](const PlumbHit& h) { return h.body == ground.body; }),
            1);
        const V n = to_vec64(hit->normal), at = to_vec64(hit->position);
        EXPECT_NEAR(length(n), 1, 1e-6);
        EXPECT_LE(dot(n, d), 1e-9) << "the normal looks at the ray";
        EXPECT_NEAR(length(at - (p + hit->fraction * translation)), 0, 1e-12 * far + rounding);
        if (!ground.numbered) {
          EXPECT_EQ(hit->child, 0U);
          continue;
        }
        ASSERT_LT(hit->child, ground.triangles.size());
        const Corners& c = ground.triangles[hit->child];
        EXPECT_NEAR(std::abs(dot(n, unit(cross(c[1] - c[0], c[2] - c[0])))), 1, 1e-5) << "another triangle's normal";
        EXPECT_NEAR(passes(c, p, d, 1e-3), hit->fraction * far, 1e-3) << "another triangle";
      }
      EXPECT_EQ(parts[r].size(), expected) << "a hit of nobody";
      EXPECT_EQ(nearest[r].body, parts[r].empty() ? 0 : parts[r][0].body);
      if (parts[r].empty()) {
        ++misses_;
        continue;
      }
      EXPECT_EQ(std::memcmp(&nearest[r], &parts[r][0], sizeof(PlumbHit)), 0) << "closest is the first of all";
    }
  }

  std::size_t hits_ = 0, misses_ = 0;
};

TEST_F(SurfaceRays, AreThoseOfBruteForce) {
  for (int round = 0; round < 8; ++round) {
    clear();
    make_grounds();
    std::vector<PlumbRay> rays;
    for (int i = 0; i < 300; ++i) {
      rays.push_back(random_ray(3));
      if (i % 5 != 0) continue;
      PlumbRay& ray = rays.back();  // along an axis
      const int axis = static_cast<int>(dice_.below(3));
      for (int k = 0; k < 3; ++k)
        if (k != axis) (&ray.translation.x)[k] = 0;
    }
    compare(rays, 12);
    scene_->run(1);
    compare(rays, 12);
  }
  EXPECT_GT(hits_, 2000U);
  EXPECT_GT(misses_, 500U);
}

TEST_F(SurfaceRays, FromFarAwayAndFarOutAreAsTrue) {
  middle_ = {1e5, -2e4, 1e5};
  make_grounds();
  std::vector<PlumbRay> rays;
  for (int i = 0; i < 300; ++i) {
    PlumbRay ray = random_ray(3);
    rays.push_back(ray);
    const V d = 1e5 * unit(to_vec64(ray.translation));
    ray.origin = {ray.origin.x - d.x, ray.origin.y - d.y, ray.origin.z - d.z};
    ray.translation = {2 * d.x, 2 * d.y, 2 * d.z};
    rays.push_back(ray);
  }
  compare(rays, kEpsilon < 1e-10 ? 1e5 : 12);
  EXPECT_GT(hits_, 200U);
}

/// Through corners and along edges of what is level and what is not: nothing slips through.
TEST_F(SurfaceRays, NothingSlipsThroughBetweenTriangles) {
  const auto height = [](double x, double z) { return 0.3 * std::sin(3 * x + z); };
  for (const bool field : {false, true})
    for (const bool turned : {false, true}) {
      clear();
      const PlumbPose pose = turned ? pose_about(1) : identity_pose();
      const TriangleSet set = grid(16, 0.37, height);
      std::vector<double> heights;
      for (std::size_t i = 1; i < set.vertices.size(); i += 3) heights.push_back(set.vertices[i]);
      if (field)
        add_field(field_desc(heights, 17, 17, 0.37), pose);
      else
        add_mesh(set, pose, false);
      const Quat64 q = normalized(to_quat64(pose.orientation));
      const V at = to_vec64(pose.position);
      std::vector<PlumbRay> rays;
      const auto down = [&](const V& through, const V& lean) {
        const V from = at + rotate(q, through + V{0, 5, 0} + lean), way = rotate(q, V{0, -10, 0} - 2.0 * lean);
        rays.push_back({to_plumb_vec3(from), to_plumb_vec3(way), kSeesAll});
      };
      for (const Corners& c : triangles_of(set, identity_pose())) {
        if (std::max({std::abs(c[0].x), std::abs(c[1].x), std::abs(c[2].x)}) > 2.9) continue;  // the rim
        if (std::max({std::abs(c[0].z), std::abs(c[1].z), std::abs(c[2].z)}) > 2.9) continue;
        for (std::size_t k = 0; k < 3; ++k) {
          down(c[k], {0, 0, 0});
          down(c[k], {dice_.uniform(-1, 1), 0, dice_.uniform(-1, 1)});
          const double s = dice_.uniform(0, 1);
          down(s * c[k] + (1 - s) * c[(k + 1) % 3], {0, 0, 0});
          down(0.5 * (c[k] + c[(k + 1) % 3]), {dice_.uniform(-1, 1), 0, dice_.uniform(-1, 1)});
        }
      }
      const Hits hits = ask().cast_rays(PLUMB_HIT_CLOSEST, rays);
      std::size_t missed = 0;
      for (const PlumbHit& hit : hits.hits) missed += hit.body == 0 ? 1 : 0;
      EXPECT_EQ(missed, 0U) << "of " << rays.size();
      EXPECT_GT(rays.size(), 4000U);
    }
}

/// Along what is level, over a whole field and back, and down at its rims.
TEST_F(SurfaceRays, AlongAndAtTheRimOfAField) {
  const std::vector<double> heights(std::size_t{200} * 300, 0.0);
  PlumbShapeDesc desc = field_desc(heights, 200, 300, 0.5);
  std::vector<double> hill = heights;
  hill[std::size_t{100} * 300 + 290] = 1;
  desc.heights = hill.data();
  const PlumbBody body = scene_->add_static(scene_->make(desc), {0, 0, 0});
  const double w = 0.25 * 299, d = 0.25 * 199;
  const auto first = [&](const PlumbVec3& from, const PlumbVec3& way) {
    const PlumbRay ray = {from, way, kSeesAll};
    return ask().cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0];
  };
  const PlumbVec3 top = {290 * 0.5 - w, 1, 100 * 0.5 - d};
  EXPECT_EQ(first({-w - 5, 0.5, top.z}, {2 * w + 10, 0, 0}).body, body);
  EXPECT_EQ(first({w + 5, 0.5, top.z}, {-2 * w - 10, 0, 0}).body, body);
  EXPECT_EQ(first({top.x, 0.5, -d - 5}, {0, 0, 2 * d + 10}).body, body);
  EXPECT_EQ(first({-w - 5, 1.001, top.z}, {2 * w + 10, 0, 0}).body, 0U) << "over the hill";
  EXPECT_EQ(first({-w - 5, 0.5, top.z + 1}, {2 * w + 10, 0, 0}).body, 0U) << "past the hill";
  for (const double x : {-w, w})
    for (const double z : {-d, d}) {
      EXPECT_EQ(first({x, 3, z}, {0, -6, 0}).body, body) << "a corner of the field";
      EXPECT_EQ(first({1.001 * x, 3, z}, {0, -6, 0}).body, 0U);
    }
  const PlumbHit diagonal = first({-w, 2, -d}, {2 * w, -4, 2 * d});
  EXPECT_NEAR(diagonal.fraction, 0.5, 1e-6);
  EXPECT_NEAR(diagonal.normal.y, 1, 1e-6);
  EXPECT_NEAR(first({0, -2, 0}, {0, 4, 0}).normal.y, -1, 1e-6) << "from below";
}

TEST_F(SurfaceRays, OfPlanesAreClosedForms) {
  const PlumbPose pose = pose_about(2);
  const PlumbBody plane = scene_->add_static(scene_->make(shape_desc(PLUMB_PLANE)), pose.position, pose.orientation);
  const V n = rotate(normalized(to_quat64(pose.orientation)), V{0, 1, 0});
  int hits = 0, inside = 0, misses = 0;
  for (int i = 0; i < 500; ++i) {
    const PlumbRay ray = random_ray(i % 2 == 0 ? 3 : 300);
    const PlumbHit hit = ask().cast_rays(i % 3 == 0 ? PLUMB_HIT_ALL : PLUMB_HIT_CLOSEST, {&ray, 1}).hits.empty()
                             ? PlumbHit{}
                             : ask().cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0];
    const double h = dot(n, to_vec64(ray.origin) - to_vec64(pose.position)), speed = dot(n, to_vec64(ray.translation));
    if (h <= 0) {
      EXPECT_EQ(hit.body, plane);
      EXPECT_EQ(hit.fraction, 0);
      EXPECT_NEAR(dot(to_vec64(hit.normal), unit(to_vec64(ray.translation))), -1, 1e-9) << "against the ray";
      ++inside;
    } else if (h + speed > 0) {
      EXPECT_EQ(hit.body, 0U);
      ++misses;
    } else {
      EXPECT_EQ(hit.body, plane);
      EXPECT_NEAR(hit.fraction, -h / speed, 1e-5);
      EXPECT_NEAR(dot(to_vec64(hit.normal), n), 1, 1e-5);
      ++hits;
    }
  }
  EXPECT_GT(hits, 50);
  EXPECT_GT(inside, 50);
  EXPECT_GT(misses, 50);
}

TEST_F(SurfaceRays, OfCylindersAreClosedForms) {
  PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
  desc.radius = 0.5;
  desc.half_height = 0.75;
  const PlumbShape cylinder = scene_->make(desc);
  const PlumbBody body = scene_->add(cylinder, {1, 2, 3});
  const auto first = [&](const PlumbVec3& from, const PlumbVec3& way) {
    const PlumbRay ray = {{1 + from.x, 2 + from.y, 3 + from.z}, way, kSeesAll};
    return ask().cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0];
  };
  EXPECT_NEAR(first({0.3, 5, 0.3}, {0, -10, 0}).fraction, 0.425, 1e-12);
  EXPECT_EQ(first({0.3, 5, 0.3}, {0, -10, 0}).normal.y, 1);
  EXPECT_EQ(first({0.36, 5, 0.36}, {0, -10, 0}).body, 0U) << "within the box, beside the disc";
  const PlumbHit side = first({5, 0.7, 0.3}, {-10, 0, 0});
  EXPECT_EQ(side.body, body);
  EXPECT_NEAR(side.fraction, 0.46, 1e-12);
  EXPECT_NEAR(side.normal.x, 0.8, 1e-12);
  EXPECT_NEAR(side.normal.z, 0.6, 1e-12);
  EXPECT_EQ(first({0, 0, 0}, {1, 0, 0}).fraction, 0) << "from inside";
  EXPECT_EQ(first({5, 0.7501, 0}, {-10, 0, 0}).body, 0U);
}

/// Each child of a compound is one to hit, and told.
TEST_F(SurfaceRays, TellWhichChildOfACompound) {
  PlumbShapeDesc desc = shape_desc(PLUMB_CYLINDER);
  desc.radius = 0.5;
  desc.half_height = 0.25;
  const PlumbShape shape =
      make_compound(*scene_, {child(scene_->box({0.5, 0.5, 0.5}), {-2, 0, 0}), child(scene_->make(desc), {0, 0, 0}),
                              child(scene_->sphere(0.5), {2, 0, 0})});
  const PlumbBody body = scene_->add(shape, {10, 0, 0});
  for (const bool all : {false, true})
    for (std::uint32_t k = 0; k < 3; ++k) {
      const PlumbRay ray = {{8 + 2.0 * k, 5, 0}, {0, -10, 0}, kSeesAll};
      const PlumbHit hit = ask().cast_rays(all ? PLUMB_HIT_ALL : PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0];
      EXPECT_EQ(hit.body, body);
      EXPECT_EQ(hit.child, k);
      EXPECT_NEAR(hit.position.y, k == 1 ? 0.25 : 0.5, 1e-6);
      const PlumbOverlap overlap = {scene_->sphere(0.2), {{8 + 2.0 * k, 0, 0}, {0, 0, 0, 1}}, kSeesAll};
      EXPECT_EQ(ask().overlap_shapes({&overlap, 1}).hits[0].child, k);
    }
  const PlumbRay along = {{20, 0, 0}, {-20, 0, 0}, kSeesAll};
  const Hits hits = ask().cast_rays(PLUMB_HIT_ALL, {&along, 1});
  ASSERT_EQ(hits.hits.size(), 1U) << "one a body";
  EXPECT_EQ(hits.hits[0].child, 2U);
}

TEST_F(SurfaceRays, FollowAMeshThatMoves) {
  const TriangleSet set = cube(1, 4);
  const PlumbBody body = scene_->add_kinematic(scene_->make(set.desc()), {0, 0, 0});
  const auto seen_at = [&](double x) {
    const PlumbRay ray = {{x, 5, 0.1}, {0, -10, 0}, kSeesAll};
    return ask().cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0].body == body;
  };
  EXPECT_TRUE(seen_at(0.3));
  scene_->write(PLUMB_FIELD_POSE, body, {7, 0, 0, 0, 0, 0, 1});
  EXPECT_FALSE(seen_at(0.3));
  EXPECT_TRUE(seen_at(7.3));
  scene_->remove(body);
  EXPECT_FALSE(seen_at(7.3));
}

}  // namespace
}  // namespace plumb::impulse::test
