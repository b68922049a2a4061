// What the host does to bodies wakes them.
#include "plugin/world.hpp"

namespace plumb::impulse {

void World::tell(PlumbEventType type, const Simulation::Slots& bodies, std::vector<PlumbEvent>& events) {
  if (!init_.needs(PLUMB_NEED_EVENTS)) return;
  for (const std::uint32_t slot : bodies) events.push_back({type, 0, bodies_[slot].id, 0, 0});
}

/// Whoever is written to wakes. What stands on a body that is put elsewhere, or was joined to it, is to notice.
void World::wake_for_write(PlumbField field, std::span<const PlumbBody> ids) {
  if (simulation_.sleeper_count() == 0) return;
  Simulation::Slots slots;
  for (const PlumbBody id : ids) slots.push_back(slot_of(id));
  tell(PLUMB_EVENT_WAKE, simulation_.wake(slots), told_.early_events);
  std::erase_if(slots, [&](std::uint32_t slot) { return bodies_[slot].motion == PLUMB_DYNAMIC; });
  // A kinematic body that moves wakes by its contacts whom it touches.
  const bool by_contact = field == PLUMB_FIELD_KINEMATIC_TARGET || field == PLUMB_FIELD_VELOCITY;
  if (!slots.empty()) tell(PLUMB_EVENT_WAKE, simulation_.wake_neighbours(slots, !by_contact), told_.early_events);
}

void World::wake_for_joint(const PlumbJointDesc& desc) {
  Simulation::Slots slots = {slot_of(desc.body_b)};
  if (desc.body_a != 0) slots.push_back(slot_of(desc.body_a));
  tell(PLUMB_EVENT_WAKE, simulation_.wake(slots), told_.early_events);
}

PlumbResult World::set_exceptions(std::span<const PlumbBodyPair> pairs, bool touch) {
  Exclusions::Keys keys;
  for (const PlumbBodyPair& pair : pairs) keys.push_back(body_pair_key(slot_of(pair.body_a), slot_of(pair.body_b)));
  if (touch)
    simulation_.exclusions.remove_exceptions(std::move(keys));
  else
    simulation_.exclusions.add_exceptions(std::move(keys));
  return PLUMB_OK;
}

void World::write_awake(std::span<const PlumbBody> ids, ConstRows rows) {
  Simulation::Slots sleepers, risers;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    double awake = 0;
    rows.get(i, &awake, 1);
    (awake == 0 ? sleepers : risers).push_back(slot_of(ids[i]));
  }
  tell(PLUMB_EVENT_WAKE, simulation_.wake(risers), told_.early_events);
  if (init_.needs(PLUMB_NEED_SLEEPING)) tell(PLUMB_EVENT_SLEEP, simulation_.put_to_sleep(sleepers), told_.early_events);
}

}  // namespace plumb::impulse
