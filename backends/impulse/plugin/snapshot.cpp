// plumb.snapshot/1: what moves, with the impulses that the next step starts from.
#include "plugin/physics_revision.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

/// Bits mean the same to every library of this physics and this number type, wherever its kernels run.
std::string_view World::format() const {
  return sizeof(Real) == 8 ? "impulse 6, double, physics " PLUMB_IMPULSE_PHYSICS_REVISION_TEXT
                           : "impulse 6, float, physics " PLUMB_IMPULSE_PHYSICS_REVISION_TEXT;
}

PlumbResult World::save(std::span<const std::byte>& data) {
  Archive archive;
  exchange(archive);
  lent_.snapshot = archive.bytes();
  data = lent_.snapshot;
  return PLUMB_OK;
}

PlumbResult World::restore(std::span<const std::byte> data) {
  Archive archive(data);
  exchange(archive);
  told_.records.clear();  // contacts are told of by the steps to come
  told_.records_known = true;
  return PLUMB_OK;
}

void World::exchange(Archive& archive) {
  struct Header {
    PlumbNeeds needs;
    Simulation::Extent rows;
  };
  const Header here = {init_.desc.needs, simulation_.extent(archive.reads())};
  Header saved = here;
  archive.value(saved);
  if (saved.needs != here.needs) throw Error(PLUMB_E_CORRUPT, "the snapshot is of a world that declared other needs");
  if (saved.rows.bodies > here.rows.bodies || saved.rows.proxies > here.rows.proxies ||
      saved.rows.joints > here.rows.joints || saved.rows.uses_midphase > here.rows.uses_midphase)
    throw Error(PLUMB_E_CORRUPT, "the snapshot is of a world that has had more bodies, joints or shapes than this one");
  const bool has_surface_velocity = init_.needs(PLUMB_NEED_SURFACE_VELOCITY);
  if (archive.reads()) clear_forces();
  simulation_.exchange(archive, saved.rows);
  archive.value(gravity_);
  archive.value(pacing_.last_h);
  archive.value(pacing_.divides_for);
  archive.value(pacing_.lets_go);
  archive.value(stopped_);
  steered_.exchange(archive);
  archive.list(pushed_);
  for (const std::uint32_t slot : pushed_) archive.value(simulation_.bodies.force.edit(slot));
  archive.list(told_.early_events);
  archive.list(told_.touches.touching());
  for (std::uint32_t slot = 0; slot < saved.rows.bodies; ++slot) {
    BodyRecord& body = bodies_[slot];
    archive.value(body.to_target);
    archive.value(body.arrived);
    archive.value(body.target);
    if (!has_surface_velocity) continue;
    archive.value(body.material.surface_velocity);
    if (archive.reads() && body.id != 0) put_body_rows(slot);
  }
}

}  // namespace plumb::impulse
