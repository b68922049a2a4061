// Shapes of all kinds in a world and on a list, for tests that ask the world and know the answer from the list.
#pragma once

#include <gtest/gtest.h>

#include "queries/probes.hpp"
#include "tests/rigs/convex_reference.hpp"
#include "tests/rigs/engine.hpp"

namespace plumb::impulse::test {

using namespace reference;

inline constexpr PlumbNeeds kNeeds = PLUMB_NEED_ROTATION | PLUMB_NEED_COLLISION | PLUMB_NEED_FRICTION |
                                     PLUMB_NEED_FILTERS | PLUMB_NEED_QUERIES | PLUMB_NEED_KINEMATIC;
inline constexpr PlumbFilter kSeesAll = {1, ~0u, 0, 0};

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
      default: break;  // has queries of its own
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

/// The hits of each query.
inline std::vector<std::span<const PlumbHit>> by_query(std::span<const PlumbHit> hits, std::size_t queries) {
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

}  // namespace plumb::impulse::test
