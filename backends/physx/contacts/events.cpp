// Events of a step: who touches, who is sensed, who sleeps, what broke.
#include <algorithm>

#include "queries/search.hpp"
#include "world.hpp"

namespace plumb::px {
namespace {

/// m: what overlaps less far apart than this touches, as rounding leaves it.
constexpr double kTouch = 1e-4;

/// PhysX has contacts across a gap, too.
bool touches(const PlumbContact& contact) { return contact.depth >= -kTouch || contact.normal_impulse > 0; }

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

/// Of those that sleep PhysX tells nothing: they touch whom they did.
void World::track_touches() {
  for (const PlumbContact& contact : listener_.contacts())
    if (touches(contact)) touches_.touch(contact.body_a, contact.body_b);
  if (!needs(PLUMB_NEED_SLEEPING)) return;
  const auto rests = [](const Body& body) { return !body.is(PLUMB_DYNAMIC) || body.asleep(); };
  for (const backend::TouchTracker::Pair& pair : touches_.touching())
    if (pair.sensor == 0 && rests(body(pair.a)) && rests(body(pair.b)) &&
        rules_.may_touch(slot_of(pair.a), slot_of(pair.b)))
      touches_.touch(pair.a, pair.b);
}

/// Whom a sensor sees: those that its filter lets it see, but where both stand.
void World::track_sensors() {
  for (const auto& sensor : bodies_) {
    if (!sensor || !sensor->is_sensor() || sensor->shape == nullptr) continue;
    const auto sees = [&](const Body& other) {
      return &other != sensor.get() && !(sensor->is(PLUMB_STATIC) && other.is(PLUMB_STATIC)) &&
             rules_.may_touch(slot_of(sensor->handle), slot_of(other.handle));
    };
    const PxTransform at = sensor->actor->getGlobalPose();
    for (const Piece& piece : sensor->shape->pieces)
      find_overlaps(*scene_, piece.geometry.any(), at * piece.at, sees,
                    [&](const Part& part) { touches_.touch_sensor(sensor->handle, part.body->handle); });
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

}  // namespace plumb::px
