// Batches of rays, casts and overlaps against all shapes one by one.
#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "convex_reference.hpp"
#include "engine.hpp"
#include "queries/probes.hpp"
#include "query_rig.hpp"

namespace plumb::impulse::test {
namespace {

using namespace reference;

constexpr PlumbNeeds kNeeds =
    PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION | PLUMB_NEED_FILTERS | PLUMB_NEED_QUERIES;
constexpr PlumbFilter kSeesAll = {1, ~0u, 0, 0};

/// Shapes of all kinds, thrown about a place, in a world and on a list.
class Queries : public ::testing::Test {
 protected:
  struct Item {
    PlumbBody body;
    Shape shape;
    PlumbPose pose;
    PlumbFilter filter;
  };
  void SetUp() override {
    if (const std::string unmet = Executor::unmet_requirement(); !unmet.empty()) GTEST_SKIP() << unmet;
  }
  void make(std::uint32_t bodies, double spread, const PlumbVec3& middle = {0, 0, 0}, double scale = 1) {
    scene_ = std::make_unique<Scene>(engine(), kNeeds, PlumbVec3{0, 0, 0}, 1);
    middle_ = middle;
    for (std::uint32_t i = 0; i < bodies; ++i) {
      Item item{0, random_shape(dice_, pool_, scale), {}, kSeesAll};
      item.pose = pose_about(spread);
      item.filter = {1u << dice_.below(3), dice_.below(3) == 0 ? 0b101u : ~0u,
                     static_cast<std::int32_t>(dice_.below(3)) - 1, 0};
      add(item, dice_.below(3) == 0);
    }
  }
  PlumbPose pose_about(double spread) {
    const auto q = dice_.orientation();
    const V at = spread * V{dice_.uniform(-1, 1), dice_.uniform(-1, 1), dice_.uniform(-1, 1)};
    return {{middle_.x + at.x, middle_.y + at.y, middle_.z + at.z}, {q.x, q.y, q.z, q.w}};
  }
  /// The same shape in the world.
  PlumbShape shape_in_world(const Shape& shape) {
    const V size = to_double(shape.size);
    switch (shape.type) {
      case ShapeType::kSphere: return scene_->sphere(size.x);
      case ShapeType::kCapsule: return scene_->capsule(size.x, size.y);
      case ShapeType::kBox: return scene_->box({size.x, size.y, size.z});
      case ShapeType::kHull: {
        std::vector<PlumbVec3> points;
        const HullView view(pool_.host(), shape.hull);
        for (std::uint32_t v = 0; v < view.vertex_count(); ++v) {
          const V p = to_double(view.vertex(v));
          points.push_back({p.x, p.y, p.z});
        }
        return scene_->hull(points);
      }
    }
    return 0;
  }
  void add(Item item, bool fixed) {
    scene_->body.filter = item.filter;
    const PlumbShape shape = shape_in_world(item.shape);
    item.body = fixed ? scene_->add_static(shape, item.pose.position, item.pose.orientation)
                      : scene_->add(shape, item.pose.position, item.pose.orientation);
    items_.push_back(item);
  }
  IQueries& ask() { return *scene_->world().queries(); }

  /// The target as the engine's state has it: orientations are rounded there.
  Target target(const Item& item) {
    double row[7];
    check(scene_->world(), scene_->world().read(PLUMB_FIELD_POSE, {&item.body, 1}, rows_over(std::span(&row, 1))));
    return {{row[0], row[1], row[2]},
            normalized(Quat64{row[3], row[4], row[5], row[6]}),
            item.shape,
            slot_of(item.body),
            0};
  }
  PlumbRay random_ray(double spread) {
    const PlumbVec3 from = pose_about(2 * spread).position, to = pose_about(spread).position;
    const double stretch = dice_.uniform(0.3, 2);
    return {from, {stretch * (to.x - from.x), stretch * (to.y - from.y), stretch * (to.z - from.z)}, kSeesAll};
  }

  Dice dice_{23};
  HullPool pool_;
  PlumbVec3 middle_{0, 0, 0};
  std::unique_ptr<Scene> scene_;
  std::vector<Item> items_;
};

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

std::vector<std::span<const PlumbHit>> by_query(std::span<const PlumbHit> hits, std::size_t queries) {
  std::vector<std::span<const PlumbHit>> parts;
  std::size_t at = 0;
  for (std::size_t q = 0; q < queries; ++q) {
    const std::size_t first = at;
    while (at < hits.size() && hits[at].query == q) ++at;
    parts.push_back(hits.subspan(first, at - first));
  }
  EXPECT_EQ(at, hits.size()) << "hits are not sorted by query";
  return parts;
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
        if (!cross_shape(at.shape, pool_.host(), from, d, part) || part.leave < 0 || part.enter > length) continue;
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

/// Casts and overlaps against distances by brute force.
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

TEST_F(Queries, OfNothingAndInNothingFindNothing) {
  make(0, 1);
  EXPECT_EQ(ask().cast_rays(PLUMB_HIT_CLOSEST, {}).hits.size(), 0U);
  EXPECT_EQ(ask().cast_rays(PLUMB_HIT_ALL, {}).hits.size(), 0U);
  EXPECT_EQ(ask().overlap_shapes({}).hits.size(), 0U);
  const PlumbRay ray = {{0, 5, 0}, {0, -10, 0}, kSeesAll};
  EXPECT_EQ(ask().cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0].body, 0U);
  EXPECT_EQ(ask().cast_rays(PLUMB_HIT_ALL, {&ray, 1}).hits.size(), 0U);
}

TEST_F(Queries, NumbersAtTheEndOfTheirRangeFindNothingWrong) {
  make(20, 3);
  std::vector<PlumbRay> rays;
  for (const double size : {1e-320, 1e-300, 1e-30, 1e30, 1e300, 1.7e308})
    for (const double far : {0.0, 1e30, 1e308}) rays.push_back({{far, 50, 0}, {-size, size / 2, size}, kSeesAll});
  rays.push_back({{0, -1e9, 0}, {0, 1e300, 0}, kSeesAll});
  const Hits hits = ask().cast_rays(PLUMB_HIT_CLOSEST, rays);
  for (const PlumbHit& hit : hits.hits)
    EXPECT_TRUE(hit.body == 0 || (hit.fraction >= 0 && hit.fraction <= 1)) << hit.query;
}

TEST_F(Queries, OfSeveralThreadsAtOnceAreThoseOfOne) {
  make(80, 5);
  std::vector<PlumbRay> rays;
  for (int i = 0; i < 400; ++i) rays.push_back(random_ray(5));
  scene_->run(1);
  std::vector<PlumbHit> found[4];
  std::vector<std::thread> threads;
  for (auto& mine : found)
    threads.emplace_back([&] {
      for (int i = 0; i < 20; ++i) {
        const Hits hits = ask().cast_rays(i % 2 == 0 ? PLUMB_HIT_ALL : PLUMB_HIT_CLOSEST, rays);
        if (i == 18) mine.assign(hits.hits.begin(), hits.hits.end());
      }
    });
  for (std::thread& thread : threads) thread.join();
  const Hits alone = ask().cast_rays(PLUMB_HIT_ALL, rays);
  for (const auto& mine : found) {
    ASSERT_EQ(mine.size(), alone.hits.size());
    EXPECT_EQ(std::memcmp(mine.data(), alone.hits.data(), mine.size() * sizeof(PlumbHit)), 0);
  }
}

TEST_F(Queries, ChangeNothingOfTheStep) {
  const auto tumble = [&](bool asking) {
    Scene scene(engine(), kNeeds, {0, -9.81, 0}, 1);
    scene.ground();
    const PlumbShape cube = scene.box({0.4, 0.4, 0.4});
    for (int i = 0; i < 20; ++i) scene.add(cube, {0.3 * (i % 3), 1 + 0.9 * i, 0.2 * (i % 2)});
    const PlumbRay ray = {{0, 50, 0}, {0, -100, 0}, kSeesAll};
    for (int i = 0; i < 60; ++i) {
      if (asking) {
        EXPECT_NE(scene.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0].body, 0U);
      }
      scene.run(1);
    }
    return scene.hash();
  };
  EXPECT_EQ(tumble(true), tumble(false));
}

TEST_F(Queries, SeeSleepersAndWhereTheyAreWhenTheyHaveWoken) {
  Scene scene(engine(), kNeeds | PLUMB_NEED_SLEEPING, {0, -9.81, 0}, 1);
  scene.ground();
  const PlumbBody cube = scene.add(scene.box({0.5, 0.5, 0.5}), {0, 0.5, 0});
  const auto seen_at = [&](double x) {
    const PlumbRay ray = {{x, 5, 0}, {0, -10, 0}, kSeesAll};
    return scene.world().queries()->cast_rays(PLUMB_HIT_CLOSEST, {&ray, 1}).hits[0].body == cube;
  };
  EXPECT_TRUE(seen_at(0));
  scene.run(200);
  double awake = 1;
  check(scene.world(), scene.world().read(PLUMB_FIELD_AWAKE, {&cube, 1}, rows_over(std::span(&awake, 1))));
  ASSERT_EQ(awake, 0);
  EXPECT_TRUE(seen_at(0));
  scene.write(PLUMB_FIELD_VELOCITY, cube, {6, 0, 0, 0, 0, 0});
  EXPECT_TRUE(seen_at(0));
  scene.run(30);
  EXPECT_FALSE(seen_at(0));
  EXPECT_TRUE(seen_at(2.4));
}

/// Places that halve their way to a corner make a tree of one leaf a level, and the ray meets all of it.
TEST_F(Queries, DeepTreesAreSearchedToTheEnd) {
  QueryRig rig;
  const std::uint32_t ball = rig.add_shape({ShapeType::kSphere, 0, {2, 0, 0}, 2});
  for (int axis = 0; axis < 3; ++axis)
    for (double away = 1; away > 1e-6; away /= 2) {
      Position at = {0, 0, 0};
      at[axis] = away;
      rig.add(ball, at, {0, 0, 0, 1}, true);
    }
  rig.update({0, 0, 0});
  const std::vector<PlumbRay> rays = {{{-9, -9, -9}, {18, 18, 18}, kSeesAll}, {{9, 9, 9}, {-18, -18, -18}, kSeesAll}};
  const Hits all = {PLUMB_OK, rig.rays(PLUMB_HIT_ALL, rays)};
  ASSERT_EQ(all.hits.size(), 2 * rig.ids.size());
  const PlumbHit first = all.hits[0], last = all.hits[rig.ids.size()];
  const std::span<const PlumbHit> closest = rig.rays(PLUMB_HIT_CLOSEST, rays);
  EXPECT_EQ(closest[0].body, first.body);
  EXPECT_EQ(closest[1].body, last.body);
}

TEST_F(Queries, ABodyOfSeveralProxiesIsHitOnce) {
  QueryRig rig;
  const std::uint32_t ball = rig.add_shape({ShapeType::kSphere, 0, {1, 0, 0}, 1});
  for (int b = 0; b < 40; ++b) {
    const std::uint32_t body = rig.add_body({0, 10.0 * b, 0}, {0, 0, 0, 1});
    for (const Real y : {Real(1), Real(-1), Real(3)}) rig.add_proxy(body, ball, {{0, y, 0}, {0, 0, 0, 1}}, b % 2 == 0);
  }
  rig.update({0, 0, 0}, true);
  const std::vector<PlumbRay> rays = {
      {{0, -100, 0}, {0, 1000, 0}, kSeesAll}, {{50, 0, 0}, {0, 1, 0}, kSeesAll}, {{0.5, 95, 0}, {0, 200, 0}, kSeesAll}};
  const auto parts = by_query(rig.rays(PLUMB_HIT_ALL, rays), rays.size());
  ASSERT_EQ(parts[0].size(), 40U);
  for (std::size_t b = 0; b < 40; ++b) {
    EXPECT_EQ(slot_of(parts[0][b].body), b);
    EXPECT_NEAR(parts[0][b].fraction, (100 + 10.0 * static_cast<double>(b) - 2) / 1000, 1e-12);
  }
  EXPECT_TRUE(parts[1].empty());
  EXPECT_EQ(parts[2].size(), 20U);
}

}  // namespace
}  // namespace plumb::impulse::test
