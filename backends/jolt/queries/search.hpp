// One query of a batch on its way through Jolt's trees.
#pragma once

#include <Jolt/Jolt.h>

#include <Jolt/Physics/Body/BodyFilter.h>
#include <Jolt/Physics/Collision/CollideShape.h>

#include <algorithm>

#include "queries/exact.hpp"
#include "world.hpp"

namespace plumb::jolt {

/// Bodies that a query sees.
struct Seen final : JPH::BodyFilter {
  explicit Seen(const PlumbFilter& filter) : filter_(filter) {}

  [[nodiscard]] bool ShouldCollideLocked(const JPH::Body& body) const override {
    const Body& seen = owner(body);
    return !seen.is_sensor() && seen.shape != nullptr && may_touch(filter_, seen.desc.filter);
  }

 private:
  const PlumbFilter& filter_;
};

/// Whose body Jolt has found, and which part of it.
struct Part {
  Part(const JPH::PhysicsSystem& system, const JPH::BodyID& id, JPH::SubShapeID part)
      : jolt(*system.GetBodyLockInterfaceNoLock().TryGetBody(id)),
        body(owner(jolt)),
        child(body.shape->child_of(part)) {}

  [[nodiscard]] Leaf leaf(JPH::SubShapeID part, JPH::RVec3Arg base) const {
    const JPH::Vec3 at(jolt.GetCenterOfMassPosition() - base);
    return {*jolt.GetShape(), JPH::Mat44::sRotationTranslation(jolt.GetRotation(), at), part};
  }

  const JPH::Body& jolt;
  const Body& body;
  std::uint32_t child;
};

/// Surfaces have two sides, and no edge of theirs is left out.
template <class How>
[[nodiscard]] How exactly() {
  How how;
  how.mActiveEdgeMode = JPH::EActiveEdgeMode::CollideWithAll;
  how.mCollisionTolerance = 1e-5f;
  how.mPenetrationTolerance = 1e-5f;
  return how;
}
/// Overlap, and what is up to so far away.
[[nodiscard]] inline JPH::CollideShapeSettings within(double distance) {
  auto how = exactly<JPH::CollideShapeSettings>();
  how.mBackFaceMode = JPH::EBackFaceMode::CollideWithBackFaces;
  how.mMaxSeparationDistance = static_cast<float>(distance);
  return how;
}

/// Jolt looks no further than the nearest hit so far, and a hair beyond it, as of equal ones the lower slot is told.
[[nodiscard]] inline float early_out(const backend::HitCollector& found, double hair = 1e-6) {
  return static_cast<float>(std::min(found.nearest(), 1.0) + hair);
}

/// Calls run(query, collector) for each of a batch. The hits live until the next batch of the same thread.
template <class Query, class Run>
Hits gather(PlumbHitMode mode, std::span<const Query> queries, Run&& run) {
  thread_local std::vector<PlumbHit> hits;
  hits.clear();
  for (std::uint32_t i = 0; i < queries.size(); ++i) {
    backend::HitCollector collector(hits, i, mode);
    run(queries[i], collector);
    collector.finish();
  }
  return {PLUMB_OK, hits};
}

/// Calls a function for whatever Jolt finds.
template <class Collector, class OnHit>
struct Each final : Collector {
  explicit Each(OnHit on_hit) : on_hit_(std::move(on_hit)) {}
  void AddHit(const typename Collector::ResultType& hit) override { on_hit_(*this, hit); }

 private:
  OnHit on_hit_;
};
template <class Collector, class OnHit>
[[nodiscard]] Each<Collector, OnHit> each(OnHit on_hit) {
  return Each<Collector, OnHit>(std::move(on_hit));
}

}  // namespace plumb::jolt
