// Meshes and height fields that become others while bodies have them.
#include <algorithm>

#include "plugin/ranges.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

PlumbResult World::modify_shapes(std::span<const PlumbShape> shapes, std::span<const PlumbShapeDesc> descs) {
  for (std::size_t i = 0; i < descs.size(); ++i) require_range(descs[i], i);
  if (init_.needs(PLUMB_NEED_CONTACTS)) contacts();  // while the surfaces are what the step left them
  for (std::size_t i = 0; i < descs.size(); ++i) change_surface(slot_of(shapes[i]), descs[i]);
  return PLUMB_OK;
}

void World::change_surface(std::uint32_t row, const PlumbShapeDesc& desc) {
  ColliderTable& colliders = simulation_.colliders;
  const Shape before = colliders.shapes[row];
  LastChange change = colliders.surfaces.last_change(before);
  const ChangedSurface changed = before.type == ShapeType::kMesh
                                     ? colliders.surfaces.change_mesh(simulation_.executor(), before.hull, desc)
                                     : colliders.surfaces.change_field(before.hull, desc);
  if (changed.where.is_empty() && !changed.frame_is_other) return;
  const Shape now = surface_shape(before.type, changed.now);
  colliders.shapes.edit(row) = now;
  const std::uint32_t next_step = simulation_.steps() + 1;
  if (change.before_step != next_step) change = {next_step, empty_box()};
  change.where = merged(change.where, changed.seen_from_middle());
  colliders.surfaces.set_last_change(now, change);
  compounds_[row].front().pose.position = changed.now.centre;
  const Vec grown = now.size - before.size;
  const bool other_box = changed.frame_is_other || length_squared(grown) > 0;
  Simulation::Slots stirred;
  for (std::uint32_t slot = 0; slot < bodies_.size(); ++slot) {
    const BodyRecord& body = bodies_[slot];
    if (body.id == 0 || body.shape != row) continue;
    if (other_box) place_again(slot, changed.frame_is_other);
    if (simulation_.sleeps(slot)) stirred.push_back(slot);
    find_sleepers_in(changed.where, slot, stirred);
  }
  tell(PLUMB_EVENT_WAKE, simulation_.wake(stirred), told_.early_events);
  if (other_box) simulation_.bodies_changed();
  pacing_.lets_go = true;
}

/// A body whose shape has another box, or another frame: where it is, for whoever keeps that.
void World::place_again(std::uint32_t slot, bool frame_is_other) {
  if (frame_is_other) fill_proxies(slot);
  const std::uint32_t one[] = {slot};
  simulation_.bodies.state.fetch(one, kPosePart);
  simulation_.bodies.state.touch(slot, kPosePart);
  if (bodies_[slot].motion == PLUMB_STATIC) simulation_.statics_changed();
}

/// Who sleeps where the shape of a body is another, whether it touches it or not.
void World::find_sleepers_in(const Extent& where, std::uint32_t of_body, Simulation::Slots& found) {
  if (simulation_.sleeper_count() == 0) return;
  Simulation::Slots sleepers;
  for (std::uint32_t slot = 0; slot < bodies_.size(); ++slot)
    if (simulation_.sleeps(slot) && bodies_[slot].proxy != kNone) sleepers.push_back(slot);
  BodyState& state = simulation_.bodies.state;
  state.fetch(sleepers, kPosePart);
  const std::uint32_t one[] = {of_body};
  state.fetch(one, kPosePart);
  const PlumbPose at = pose(of_body);
  const QuatD to_frame = conjugate(to_double(at.orientation));
  for (const std::uint32_t slot : sleepers) {
    const Position centre = rotate(to_frame, state.position[slot] - to_position(at.position));
    if (where.meets({centre.x, centre.y, centre.z}, reach_of(slot))) found.push_back(slot);
  }
}

/// Of the farthest point of its shapes from its centre of mass, m.
double World::reach_of(std::uint32_t slot) const {
  const ColliderTable& colliders = simulation_.colliders;
  const auto reach = [&](std::uint32_t row) {
    const Proxy& proxy = colliders.proxies[row];
    return static_cast<double>(length(proxy.frame.position) + colliders.shapes[proxy.shape].reach);
  };
  double most = reach(bodies_[slot].proxy);
  for (const std::uint32_t row : bodies_[slot].more_proxies) most = std::max(most, reach(row));
  return most;
}

}  // namespace plumb::impulse
