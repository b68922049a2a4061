// Events of a step: who touches, who is sensed, who sleeps, what broke.
#include "manifolds.hpp"

namespace plumb::box3d {
namespace {

/// Box3D has manifolds across a small gap, too: they touch where a point overlaps or has pushed.
bool touches(const b3Manifold& manifold) {
  for (int i = 0; i < manifold.pointCount; ++i)
    if (manifold.points[i].separation <= 0 || manifold.points[i].totalNormalImpulse > 0) return true;
  return false;
}

}  // namespace

void World::gather_events() {
  events_.clear();
  events_.swap(pending_events_);
  if (needs(PLUMB_NEED_EVENTS)) track_touches();
  if (needs(PLUMB_NEED_SENSORS)) track_sensors();
  touches_.finish_step(events_);
  if (needs(PLUMB_NEED_EVENTS) && needs(PLUMB_NEED_SLEEPING)) track_sleep();
  if (breakable_ != 0) break_joints();
  backend::sort_events(events_);
}

void World::track_touches() {
  each_manifold([&](const b3ContactData&, const Body& a, const Body& b, const b3Manifold& manifold) {
    if (touches(manifold)) touches_.touch(a.handle, b.handle);
  });
}

void World::track_sensors() {
  for (const auto& body : bodies_) {
    if (!body || !body->is_sensor()) continue;
    for (const b3ShapeId shape : body->shapes) {
      visitors_.resize(static_cast<std::size_t>(b3Shape_GetSensorCapacity(shape)));
      const int count = b3Shape_GetSensorData(shape, visitors_.data(), static_cast<int>(visitors_.size()));
      for (const b3ShapeId visitor : std::span(visitors_).first(static_cast<std::size_t>(count)))
        if (b3Shape_IsValid(visitor)) touches_.touch_sensor(body->handle, owner(visitor).handle);
    }
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

/// Box3D tells which joints are overloaded, and leaves them.
void World::break_joints() {
  const b3JointEvents told = b3World_GetJointEvents(world_);
  std::vector<std::uintptr_t> slots;
  for (int i = 0; i < told.count; ++i) slots.push_back(reinterpret_cast<std::uintptr_t>(told.jointEvents[i].userData));
  for (const std::uintptr_t slot : slots) {
    if (!joints_[slot]) continue;
    Joint& broken = *joints_[slot];
    events_.push_back({PLUMB_EVENT_JOINT_BROKEN, 0, broken.desc.body_a, broken.desc.body_b, broken.handle});
    remove_joint(broken);
  }
}

}  // namespace plumb::box3d
