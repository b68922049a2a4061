// Batches of rays against all shapes one by one.
#include <algorithm>
#include <cmath>

#include "tests/rigs/query_fixture.hpp"

namespace plumb::impulse::test {
namespace {

struct Expected {
  double fraction;
  PlumbBody body;
  double near;  ///< how near the fraction must be: the engine's orientations are rounded, for hulls more than once
  bool sure;    ///< not by rounding alone
};

/// hits of one query, sorted, against what is expected, in any order.
void expect_hits(std::span<const PlumbHit> hits, std::vector<Expected> expected, const std::string& where) {
  for (std::size_t i = 1; i < hits.size(); ++i)
    EXPECT_TRUE(hits[i - 1].fraction < hits[i].fraction ||
                (hits[i - 1].fraction == hits[i].fraction && slot_of(hits[i - 1].body) < slot_of(hits[i].body)))
        << where << ": the order";
  for (const PlumbHit& hit : hits) {
    const auto known =
        std::find_if(expected.begin(), expected.end(), [&](const auto& e) { return e.body == hit.body; });
    ASSERT_NE(known, expected.end()) << where << ": a hit that is none, or the second of a body";
    EXPECT_NEAR(hit.fraction, known->fraction, known->near) << where;
    expected.erase(known);
  }
  for (const Expected& left : expected) EXPECT_FALSE(left.sure) << where << ": missed at " << left.fraction;
}

/// Rays of a scene, closest and all, against the equations of each shape.
class Rays : public Queries {
 protected:
  void compare(const std::vector<PlumbRay>& rays) {
    const Hits closest = ask().cast_rays(PLUMB_HIT_CLOSEST, rays);
    ASSERT_EQ(closest.hits.size(), rays.size());
    const std::vector<PlumbHit> nearest(closest.hits.begin(), closest.hits.end());
    const Hits all = ask().cast_rays(PLUMB_HIT_ALL, rays);
    std::vector<Target> targets;
    for (const Item& item : items_) targets.push_back(target(item));
    const auto parts = by_query(all.hits, rays.size());
    for (std::size_t r = 0; r < rays.size(); ++r) {
      const PlumbRay& ray = rays[r];
      const V translation = to_vec64(ray.translation), along = unit(translation);
      const double length = impulse::length(translation);
      std::vector<Expected> expected;
      for (std::size_t i = 0; i < items_.size(); ++i) {
        if (!may_touch(ray.filter, items_[i].filter)) continue;
        const Target& at = targets[i];
        const V from = rotate_back(at.turn, to_vec64(ray.origin) - at.place), d = rotate_back(at.turn, along);
        LinePart part{};
        if (!cross_convex<true>(at.shape, pool_.host(), from, d, part) || part.leave < 0 || part.enter > length)
          continue;
        const double reach = static_cast<double>(at.shape.reach), slack = 1e-9 * length;
        const double rounding = 16 * static_cast<double>(kEpsilon) * reach + 1e-15 * (length + reach);
        expected.push_back(
            {std::max(part.enter, 0.0) / length, items_[i].body, rounding / std::abs(dot(part.normal, d)) / length,
             part.leave - part.enter > 1e-3 * reach && part.leave > slack && part.enter < length - slack});
      }
      const std::string where = "ray " + std::to_string(r);
      expect_hits(parts[r], expected, where);
      if (parts[r].empty()) {
        EXPECT_EQ(nearest[r].body, 0U) << where;
        EXPECT_TRUE(std::isnan(nearest[r].fraction) && std::isnan(nearest[r].position.x)) << where;
      } else {
        EXPECT_EQ(nearest[r].body, parts[r][0].body) << where;
        EXPECT_EQ(nearest[r].fraction, parts[r][0].fraction) << where;
      }
      EXPECT_EQ(nearest[r].query, r);
      hits_ += parts[r].size();
      if (parts[r].empty()) ++misses_;
    }
  }
  std::size_t hits_ = 0, misses_ = 0;
};

TEST_F(Rays, OfManyScenesAreThoseOfBruteForce) {
  for (int round = 0; round < 12; ++round) {
    items_.clear();
    const double spread = round % 3 == 0 ? 2 : round % 3 == 1 ? 6 : 20;
    make(round == 0 ? 1 : 60, spread, {0, 0, 0}, round % 4 == 3 ? 1e-2 : 1);
    std::vector<PlumbRay> rays;
    for (int i = 0; i < 250; ++i) {
      rays.push_back(random_ray(spread));
      rays.back().filter = {1u << dice_.below(3), dice_.below(2) == 0 ? ~0u : 0b011u,
                            static_cast<std::int32_t>(dice_.below(3)) - 1, 0};
    }
    compare(rays);
    scene_->run(1);
    compare(rays);
  }
  EXPECT_GT(hits_, 3000U);
  EXPECT_GT(misses_, 1000U);
}

TEST_F(Rays, AlongAxesAndFromWithinAndOnSurfaces) {
  make(40, 4);
  for (const double x : {-3.0, 0.0, 3.0}) {
    Item cube{0, make_box(0.5, 0.5, 0.5), {{x, 9, 0}, {0, 0, 0, 1}}, kSeesAll};
    add(cube, true);
  }
  std::vector<PlumbRay> rays;
  for (int axis = 0; axis < 3; ++axis)
    for (int i = 0; i < 60; ++i) {
      PlumbRay ray{pose_about(4).position, {0, 0, 0}, kSeesAll};
      (&ray.translation.x)[axis] = i % 2 == 0 ? 9 : -9;
      rays.push_back(ray);
    }
  for (const Item& item : items_) rays.push_back({item.pose.position, {0.01, 0.02, 5}, kSeesAll});
  compare(rays);
  const PlumbRay inside = {{0, 9, 0}, {0, 2, 0}, kSeesAll}, along_face = {{-9, 9.5, 0}, {18, 0, 0}, kSeesAll};
  const PlumbHit within = ask().cast_rays(PLUMB_HIT_CLOSEST, {&inside, 1}).hits[0];
  EXPECT_EQ(within.fraction, 0);
  EXPECT_EQ(within.normal.y, -1) << "against the ray";
  EXPECT_EQ(ask().cast_rays(PLUMB_HIT_ALL, {&along_face, 1}).hits.size(), 3U) << "touching counts";
}

TEST_F(Rays, AreTrueFarFromTheOriginAndFarFromTheirTargets) {
  make(50, 5, {1e5, -3e4, 1e5});
  std::vector<PlumbRay> rays;
  for (int i = 0; i < 150; ++i) {
    const PlumbRay near = random_ray(5);
    rays.push_back(near);
    PlumbRay far = near;  // from 1e5 m away, through the same place, to as far behind it
    const V d = 1e5 * unit(to_vec64(near.translation));
    far.origin = {near.origin.x - d.x, near.origin.y - d.y, near.origin.z - d.z};
    far.translation = {2 * d.x, 2 * d.y, 2 * d.z};
    rays.push_back(far);
  }
  compare(rays);
  EXPECT_GT(hits_, 100U);
}

TEST_F(Rays, SeeWhatHasMovedAndNotWhatIsGone) {
  make(30, 4);
  std::vector<PlumbRay> rays;
  for (int i = 0; i < 100; ++i) rays.push_back(random_ray(4));
  compare(rays);
  for (const std::size_t i : {0U, 5U, 6U, 29U}) {
    items_[i].pose = pose_about(4);
    const PlumbPose& p = items_[i].pose;
    scene_->write(
        PLUMB_FIELD_POSE, items_[i].body,
        {p.position.x, p.position.y, p.position.z, p.orientation.x, p.orientation.y, p.orientation.z, p.orientation.w});
  }
  compare(rays);
  for (const std::size_t i : {3U, 2U}) {
    scene_->remove(items_[i].body);
    items_.erase(items_.begin() + static_cast<std::ptrdiff_t>(i));
  }
  compare(rays);
  items_[0].filter = {4, 4, 0, 0};
  scene_->write(PLUMB_FIELD_FILTER, items_[0].body, {4, 4, 0});
  compare(rays);
  Item late{0, make_box(1, 1, 1), pose_about(4), kSeesAll};
  add(late, false);
  compare(rays);
}

TEST_F(Rays, ThatAreManyThroughOneColumnAreAllListed) {
  scene_ = std::make_unique<Scene>(engine(), kNeeds, PlumbVec3{0, 0, 0}, 2);
  const Shape plate = make_box(1, 0.25, 1);
  for (int i = 0; i < 700; ++i)
    add({0, plate, {{0, static_cast<double>((i * 271) % 700), 0}, {0, 0, 0, 1}}, kSeesAll}, i % 2 == 0);
  std::vector<PlumbRay> rays(130, PlumbRay{{0, -10, 0}, {0, 1000, 0}, kSeesAll});
  compare(rays);
  EXPECT_EQ(hits_, 700U * rays.size());
}

}  // namespace
}  // namespace plumb::impulse::test
