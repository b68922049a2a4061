// plumb.snapshot/1: what moves, with the impulses that the next step starts from, and what the engine's rows are:
// bodies and joints may have been made anew under their handles, and then have other proxies than they had.
#include <algorithm>

#include "plugin/physics_revision.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

/// Bits mean the same to every library of this physics and this number type, wherever its kernels run.
std::string_view World::format() const {
  return sizeof(Real) == 8 ? "impulse 13, double, physics " PLUMB_IMPULSE_PHYSICS_REVISION_TEXT
                           : "impulse 13, float, physics " PLUMB_IMPULSE_PHYSICS_REVISION_TEXT;
}

PlumbResult World::save(std::span<const std::byte>& data) {
  Archive archive;
  exchange(archive);
  lent_.snapshot = archive.take_bytes();
  data = lent_.snapshot;
  return PLUMB_OK;
}

PlumbResult World::restore(std::span<const std::byte> data) {
  Archive archive(data);
  exchange(archive);
  told_.records.clear();  // contacts are told of by the steps to come
  told_.records_known = true;
  told_.contacts_known = false;
  return PLUMB_OK;
}

void World::exchange(Archive& archive) {
  struct Header {
    PlumbNeeds needs;
    Simulation::Extent rows;
  };
  Header saved = {init_.desc.needs, simulation_.extent()};
  archive.value(saved);
  if (saved.needs != init_.desc.needs)
    throw Error(PLUMB_E_CORRUPT, "the snapshot is of a world that declared other needs");
  if (archive.reads()) make_room(saved.rows);
  bool continuous = continuous_;
  archive.value(continuous);
  if (archive.reads()) make_continuous(continuous);
  exchange_proxies(archive);
  for (JointRecord& joint : joints_.records) archive.value(joint.made_after);
  if (archive.reads()) clear_forces();
  simulation_.exchange(archive, saved.rows);
  archive.value(gravity_);
  archive.value(pacing_.last_h);
  archive.value(pacing_.divides_for);
  archive.value(pacing_.lets_go);
  archive.value(stopped_);
  sensors_.exchange(archive);
  exchange_targets(archive);
  archive.list(pushed_);
  for (const std::uint32_t slot : pushed_) archive.value(simulation_.bodies.force.edit(slot));
  archive.list(told_.early_events);
  archive.list(told_.touches.touching());
  const bool runs = init_.needs(PLUMB_NEED_SURFACE_VELOCITY), rolls = init_.needs(PLUMB_NEED_ROLLING_FRICTION);
  for (std::uint32_t slot = 0; (runs || rolls) && slot < saved.rows.bodies; ++slot) {
    if (runs) archive.value(bodies_[slot].material.surface_velocity);
    if (rolls) archive.value(bodies_[slot].rolling_friction);
    if (rolls) archive.value(bodies_[slot].spinning_friction);
    if (archive.reads() && bodies_[slot].id != 0) put_body_rows(slot);
  }
}

/// The rows that there were, no more and no fewer: whoever comes next gets those that came next then.
void World::make_room(const Simulation::Extent& rows) {
  PLUMB_ASSERT(std::none_of(bodies_.begin() + std::min<std::ptrdiff_t>(rows.bodies, std::ssize(bodies_)), bodies_.end(),
                            [](const BodyRecord& body) { return body.id != 0; }));
  simulation_.reserve_bodies(rows.bodies);
  if (bodies_.size() < rows.bodies) bodies_.resize(rows.bodies);
  rows_.ids.resize(rows.bodies);
  ++rows_.generation;
  simulation_.bodies.count = rows.bodies;
  simulation_.joints.resize(rows.joints);
  joints_.records.resize(rows.joints);
  simulation_.use_midphase(rows.uses_midphase != 0);
}

/// Which proxies the bodies have, and since when: contacts are remembered by them.
void World::exchange_proxies(Archive& archive) {
  ColliderTable& colliders = simulation_.colliders;
  proxy_slots_.exchange(archive);
  std::vector<std::uint32_t> others;  // bodies that have other proxies than they had
  for (std::uint32_t slot = 0; slot < simulation_.bodies.count; ++slot) {
    BodyRecord& body = bodies_[slot];
    std::uint32_t proxy = body.proxy, more = static_cast<std::uint32_t>(body.more_proxies.size());
    archive.value(proxy);
    archive.value(more);
    std::vector<std::uint32_t> more_proxies = body.more_proxies;
    more_proxies.resize(more);
    archive.items(more_proxies.data(), more);
    if (!archive.reads() || (proxy == body.proxy && more_proxies == body.more_proxies)) continue;
    if (body.shape == kNone || (parts_of(body.shape) == nullptr ? 1 : parts_of(body.shape)->size()) != more + 1)
      throw Error(PLUMB_E_CORRUPT, "the snapshot is of bodies of other shapes");
    colliders.proxies.edit(body.proxy).shape = kNone;
    for (const std::uint32_t row : body.more_proxies) colliders.proxies.edit(row).shape = kNone;
    body.proxy = proxy;
    body.more_proxies = std::move(more_proxies);
    others.push_back(slot);
  }
  if (archive.reads()) {
    simulation_.reserve_proxies(proxy_slots_.end());
    colliders.count = proxy_slots_.end();
    for (const std::uint32_t slot : others) fill_proxies(slot);
    if (!others.empty()) simulation_.bodies_changed();
  }
  for (std::uint32_t row = 0; row < colliders.count; ++row) {
    std::uint32_t first_step = colliders.proxies[row].first_step;
    archive.value(first_step);
    if (archive.reads() && first_step != colliders.proxies[row].first_step)
      colliders.proxies.edit(row).first_step = first_step;
    const std::uint32_t shape = colliders.proxies[row].shape;
    if (shape == kNone || !is_surface(colliders.shapes[shape].type)) continue;
    LastChange change = colliders.surfaces.last_change(colliders.shapes[shape]);
    archive.value(change.before_step);
    archive.value(change.where);
    if (archive.reads()) colliders.surfaces.set_last_change(colliders.shapes[shape], change);
  }
}

void World::exchange_targets(Archive& archive) {
  if (archive.reads())
    for (BodyRecord& body : bodies_) body.to_target = body.arrived = false;
  steered_.exchange(archive);
  for (const std::uint32_t slot : steered_) {
    BodyRecord& body = bodies_[slot];
    archive.value(body.to_target);
    archive.value(body.arrived);
    archive.value(body.target);
  }
}

}  // namespace plumb::impulse
