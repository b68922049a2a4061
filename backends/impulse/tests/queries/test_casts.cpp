// Batches of casts and overlaps against distances by brute force.
#include <algorithm>
#include <cmath>

#include "tests/rigs/query_fixture.hpp"

namespace plumb::impulse::test {
namespace {

class Casts : public Queries {
 protected:
  Features features(const Target& at, const V& from) {
    return features_of(at.shape, pool_.host(), at.turn, at.place - from);
  }
};

TEST_F(Casts, EndWhereTheyTouchAndPassWhatTheyMiss) {
  int hits = 0, misses = 0, starts = 0;
  for (int round = 0; round < 6; ++round) {
    items_.clear();
    const double far = round % 2 == 0 ? 0 : 1e5;
    make(25, 3, {far, far, -far});
    std::vector<Target> targets;
    for (const Item& item : items_) targets.push_back(target(item));
    std::vector<PlumbCast> casts;
    std::vector<Shape> shapes;
    for (int i = 0; i < 40; ++i) {
      const PlumbRay ray = random_ray(i % 4 == 0 ? 1 : 3);
      const Shape shape = random_shape(dice_, pool_, 0.5);
      PlumbPose pose = pose_about(4);
      pose.position = ray.origin;
      shapes.push_back(shape);
      casts.push_back({shape_in_world(shape), pose, ray.translation, {1, i % 2 == 0 ? ~0u : 0b011u, 0, 0}});
    }
    const Hits closest = ask().cast_shapes(PLUMB_HIT_CLOSEST, casts);
    ASSERT_EQ(closest.hits.size(), casts.size());
    const std::vector<PlumbHit> nearest(closest.hits.begin(), closest.hits.end());
    const Hits all = ask().cast_shapes(PLUMB_HIT_ALL, casts);
    const auto parts = by_query(all.hits, casts.size());
    for (std::size_t c = 0; c < casts.size(); ++c) {
      const std::string where = "round " + std::to_string(round) + " cast " + std::to_string(c);
      const V from = to_vec64(casts[c].pose.position), way = to_vec64(casts[c].translation);
      const Features moving = features_of(shapes[c], pool_.host(), to_quat64(casts[c].pose.orientation), {0, 0, 0});
      for (std::size_t i = 0; i < items_.size(); ++i) {
        const Features resting = features(targets[i], from);
        const auto at = [&](double fraction) {
          Features moved = moving;
          moved.move(fraction * way);
          return distance(resting, moved);
        };
        const auto hit =
            std::find_if(parts[c].begin(), parts[c].end(), [&](const PlumbHit& h) { return h.body == items_[i].body; });
        if (!may_touch(casts[c].filter, items_[i].filter)) {
          EXPECT_EQ(hit, parts[c].end()) << where << ": a hit that the filter forbids";
          continue;
        }
        const double near = 1e-6;  // the faces of hulls are floats, of which neighbours may be a little concave
        if (hit == parts[c].end()) {
          double low = 0, high = 1;
          for (int k = 0; k < 50; ++k) {
            const double l = low + (high - low) / 3, h = high - (high - low) / 3;
            (at(l) < at(h) ? high : low) = at(l) < at(h) ? h : l;
          }
          EXPECT_GT(at(low), -near) << where << ": passes through";
          ++misses;
        } else if (hit->fraction == 0) {
          EXPECT_LE(at(0), near) << where;
          EXPECT_NEAR(impulse::length(to_vec64(hit->normal)), 1, 1e-5) << where;
          ++starts;
        } else {
          EXPECT_NEAR(at(hit->fraction), 0, near) << where;
          Features there = moving;
          there.move(hit->fraction * way);
          const V n = to_vec64(hit->normal);
          EXPECT_NEAR(-impulse::reference::high(there, -n) - impulse::reference::high(resting, n), 0, near) << where;
          EXPECT_NEAR(dot(n, to_vec64(hit->position) - from), impulse::reference::high(resting, n), 1e-4) << where;
          ++hits;
        }
      }
      EXPECT_EQ(nearest[c].body, parts[c].empty() ? 0 : parts[c][0].body) << where;
      if (!parts[c].empty()) {
        EXPECT_EQ(nearest[c].fraction, parts[c][0].fraction) << where;
      }
      for (std::size_t i = 1; i < parts[c].size(); ++i)
        EXPECT_TRUE(parts[c][i - 1].fraction <= parts[c][i].fraction) << where;
    }
  }
  EXPECT_GT(hits, 150);
  EXPECT_GT(misses, 1000);
  EXPECT_GT(starts, 20);
}

TEST_F(Casts, ThatStartInAnOverlapTellTheWayOut) {
  make(0, 1);
  add({0, make_box(10, 1, 10), {{0, -1, 0}, {0, 0, 0, 1}}, kSeesAll}, true);
  const PlumbCast cast = {scene_->sphere(0.5), {{0, 0.3, 0}, {0, 0, 0, 1}}, {5, 0, 0}, kSeesAll};
  const PlumbHit hit = ask().cast_shapes(PLUMB_HIT_CLOSEST, {&cast, 1}).hits[0];
  EXPECT_EQ(hit.body, items_[0].body);
  EXPECT_EQ(hit.fraction, 0);
  EXPECT_NEAR(hit.normal.y, 1, 1e-6);
  EXPECT_NEAR(hit.position.y, -0.1, 1e-6) << "midway in the overlap";
}

TEST_F(Casts, OfSpheresAreClosedForms) {
  make(0, 1);
  add({0, {ShapeType::kSphere, 0, {Real(0.5), 0, 0}, Real(0.5)}, {{3, 0, 0}, {0, 0, 0, 1}}, kSeesAll}, true);
  const PlumbShape ball = scene_->sphere(0.25);
  for (const double aside : {0.0, 0.3, 0.7, 0.7499999, 0.75, 0.7500001}) {
    const PlumbCast cast = {ball, {{0, aside, 0}, {0, 0, 0, 1}}, {6, 0, 0}, kSeesAll};
    const PlumbHit hit = ask().cast_shapes(PLUMB_HIT_CLOSEST, {&cast, 1}).hits[0];
    if (aside > 0.75) {
      EXPECT_EQ(hit.body, 0U);
      continue;
    }
    EXPECT_NEAR(hit.fraction, (3 - std::sqrt(0.75 * 0.75 - aside * aside)) / 6, 1e-7) << aside;
    EXPECT_NEAR(hit.normal.y, aside / 0.75, 1e-6) << aside;
  }
}

TEST_F(Queries, OverlapsAreThoseOfBruteForce) {
  int overlapping = 0, apart = 0;
  for (int round = 0; round < 6; ++round) {
    items_.clear();
    make(40, round % 2 == 0 ? 2 : 4, {0, round % 3 == 0 ? 0.0 : -1e5, 0});
    std::vector<PlumbOverlap> overlaps;
    std::vector<Shape> shapes;
    for (int i = 0; i < 60; ++i) {
      shapes.push_back(random_shape(dice_, pool_, 1));
      overlaps.push_back({shape_in_world(shapes.back()), pose_about(2), {2, 0b110, 0, 0}});
    }
    const auto parts = by_query(ask().overlap_shapes(overlaps).hits, overlaps.size());
    for (const Item& item : items_) {
      const Target at = target(item);
      for (std::size_t q = 0; q < overlaps.size(); ++q) {
        const V from = to_vec64(overlaps[q].pose.position);
        const double apart_by =
            distance(features_of(at.shape, pool_.host(), at.turn, at.place - from),
                     features_of(shapes[q], pool_.host(), to_quat64(overlaps[q].pose.orientation), {0, 0, 0}));
        const bool seen = may_touch(overlaps[q].filter, item.filter);
        const bool found =
            std::any_of(parts[q].begin(), parts[q].end(), [&](const PlumbHit& h) { return h.body == item.body; });
        EXPECT_TRUE(found == (seen && apart_by <= 0) || std::abs(apart_by) < 1e-6) << apart_by;
        if (seen) ++(apart_by > 0 ? apart : overlapping);
      }
    }
    for (const auto& part : parts)
      for (std::size_t i = 1; i < part.size(); ++i) EXPECT_LT(slot_of(part[i - 1].body), slot_of(part[i].body));
  }
  EXPECT_GT(overlapping, 300);
  EXPECT_GT(apart, 1000);
}

}  // namespace
}  // namespace plumb::impulse::test
