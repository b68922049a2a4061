// Events of a step: who touches, who is sensed, who sleeps, what broke.
#include <Jolt/Jolt.h>

#include <Jolt/Physics/Collision/CollideShape.h>

#include <algorithm>

#include "contacts/saved_contacts.hpp"
#include "world.hpp"

namespace plumb::jolt {
namespace {

/// Whom a sensor sees: those that its filter lets it see, but where both stand.
struct Sight final : JPH::BodyFilter {
  Sight(const Body& sensor, const PairRules& rules) : sensor_(sensor), rules_(rules) {}

  [[nodiscard]] bool ShouldCollideLocked(const JPH::Body& seen) const override {
    const Body& other = owner(seen);
    if (&other == &sensor_ || other.shape == nullptr) return false;
    if (sensor_.is(PLUMB_STATIC) && other.is(PLUMB_STATIC)) return false;
    return rules_.may_touch(slot_of(sensor_.handle), slot_of(other.handle));
  }

 private:
  const Body& sensor_;
  const PairRules& rules_;
};

struct Visitors final : JPH::CollideShapeCollector {
  void AddHit(const JPH::CollideShapeResult& hit) override { bodies.push_back(hit.mBodyID2); }
  std::vector<JPH::BodyID> bodies;
};

bool has_pushed(const SavedManifold& manifold) {
  return std::any_of(manifold.points, manifold.points + manifold.count,
                     [](const SavedManifold::Point& point) { return point.impulse > 0; });
}

}  // namespace

void World::gather_events() {
  events_.clear();
  events_.swap(pending_events_);
  if (needs(PLUMB_NEED_EVENTS)) track_touches();
  if (needs(PLUMB_NEED_SENSORS)) track_sensors();
  touches_.finish_step(events_);
  if (needs(PLUMB_NEED_EVENTS) && needs(PLUMB_NEED_SLEEPING)) track_sleep();
  break_joints();
  backend::sort_events(events_);
}

/// Jolt has manifolds across a small gap, too: they touch where a point overlaps or has pushed.
void World::track_touches() {
  std::vector<SavedManifold> saved;
  bool read = false;
  for (const Manifold& manifold : listener_.manifolds()) {
    bool touch = manifold.touches();
    if (!touch) {
      if (!read) saved = saved_contacts(system_);
      read = true;
      const SavedManifold* with = find(saved, manifold.parts);
      touch = with != nullptr && has_pushed(*with);
    }
    if (touch) touches_.touch(manifold.a->handle, manifold.b->handle);
  }
  if (needs(PLUMB_NEED_SLEEPING)) track_resting();
}

/// Of those that sleep Jolt tells nothing: they touch whom they did.
void World::track_resting() {
  const auto rests = [](const Body& body) { return body.is(PLUMB_STATIC) || !body.jolt->IsActive(); };
  for (const backend::TouchTracker::Pair& pair : touches_.touching())
    if (pair.sensor == 0 && rests(body(pair.a)) && rests(body(pair.b)) &&
        rules_.may_touch(slot_of(pair.a), slot_of(pair.b)))
      touches_.touch(pair.a, pair.b);
}

void World::track_sensors() {
  JPH::CollideShapeSettings how;
  how.mBackFaceMode = JPH::EBackFaceMode::CollideWithBackFaces;
  how.mActiveEdgeMode = JPH::EActiveEdgeMode::CollideWithAll;
  for (const auto& sensor : bodies_) {
    if (!sensor || !sensor->is_sensor() || sensor->shape == nullptr) continue;
    Visitors visitors;
    system_.GetNarrowPhaseQueryNoLock().CollideShape(
        sensor->jolt->GetShape(), JPH::Vec3::sOne(), sensor->jolt->GetCenterOfMassTransform(), how,
        sensor->jolt->GetCenterOfMassPosition(), visitors, {}, {}, Sight(*sensor, rules_));
    for (const JPH::BodyID& seen : visitors.bodies)
      touches_.touch_sensor(sensor->handle, bodies_[seen.GetIndex()]->handle);
  }
}

void World::track_sleep() {
  for (const auto& body : bodies_) {
    if (!body || !body->is(PLUMB_DYNAMIC)) continue;
    const bool asleep = body->asleep();
    if (asleep != body->was_asleep)
      events_.push_back({asleep ? PLUMB_EVENT_SLEEP : PLUMB_EVENT_WAKE, 0, body->handle, 0, 0});
    body->was_asleep = asleep;
  }
}

}  // namespace plumb::jolt
