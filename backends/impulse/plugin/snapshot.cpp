// plumb.snapshot/1: what moves, with the impulses that the next step starts from.
#include "exec/floating_point.hpp"
#include "physics_revision.hpp"
#include "plugin/world.hpp"

namespace plumb::impulse {

/// Bits mean the same to every library of this physics and this number type, wherever its kernels run.
std::string_view World::format() const {
  return sizeof(Real) == 8 ? "impulse 1, double, physics " PLUMB_IMPULSE_PHYSICS_REVISION_TEXT
                           : "impulse 1, float, physics " PLUMB_IMPULSE_PHYSICS_REVISION_TEXT;
}

PlumbResult World::save(std::span<const std::byte>& data) {
  const FloatingPointScope scope;
  Archive archive;
  exchange(archive);
  snapshot_ = archive.bytes();
  data = snapshot_;
  return PLUMB_OK;
}

PlumbResult World::restore(std::span<const std::byte> data) {
  const FloatingPointScope scope;
  clear_forces();
  Archive archive(data);
  exchange(archive);
  records_.clear();  // contacts are told of by the steps to come
  records_known_ = true;
  return PLUMB_OK;
}

void World::exchange(Archive& archive) {
  simulation_.exchange(archive);
  archive.value(gravity_);
  archive.value(last_h_);
  archive.value(stopped_);
  archive.list(steered_);
  archive.list(pushed_);
  for (const std::uint32_t slot : pushed_) archive.value(simulation_.force.edit(slot));
  archive.list(early_events_);
  archive.list(touches_.touching());
  for (BodyRecord& body : bodies_) {
    archive.value(body.to_target);
    archive.value(body.arrived);
    archive.value(body.target);
  }
}

}  // namespace plumb::impulse
