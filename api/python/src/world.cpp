#include "world.hpp"

namespace plumb::python {

World::World(const PlumbBackendTable& table, const PlumbWorldDesc& desc) : table_(table) {
  const PlumbResult result = unlocked([&] { return table.create_world(&desc, &world_); });
  if (result < 0) throw Error(result, table.error_text(nullptr));
}

void World::destroy() {
  if (world_ == nullptr) return;
  if (stepping_) table_.wait(world_, nullptr);
  table_.destroy_world(world_);
  world_ = nullptr;
}

void World::close() {
  const Passage passage(gate_, Tag::world, "close");
  unlocked([&] {
    destroy();
    return true;
  });
}

void World::require_open(const char* name) const {
  if (closed()) throw py::value_error(std::string(name) + ": the world is closed; backend.world() makes another");
}

void World::require_ready(const char* name) const {
  require_open(name);
  if (stepping_) throw Error(PLUMB_E_WRONG_PHASE, std::string(name) + ": a step is under way; call wait() first");
}

void World::require_stepping(const char* name) const {
  require_open(name);
  if (!stepping_)
    throw Error(PLUMB_E_WRONG_PHASE, std::string(name) + ": no step is under way; call begin_step() first");
}

PlumbResult World::checked(PlumbResult result) const {
  if (result < 0) throw Error(result, table_.error_text(world_));
  return result;
}

const void* World::find_extension(const char* name) const {
  const void* table = table_.extension(name);
  if (table == nullptr) throw Error(PLUMB_E_UNSUPPORTED, std::string(table_.info()->name) + " has no " + name);
  return table;
}

PlumbResult World::begin(double dt) {
  const PlumbStepDesc desc = {sizeof desc, 0, dt};
  const PlumbResult result = table_.step(world_, &desc);
  stepping_ = result >= 0;
  return result;
}

PlumbResult World::finish(Report& report) {
  report.struct_size = sizeof report;
  stepping_ = false;
  return table_.wait(world_, &report);
}

Report World::step(double dt) {
  Report report{};
  call_unlocked(Tag::world, "step", [&](const PlumbBackendTable&, PlumbWorld*) {
    const PlumbResult begun = begin(dt);
    return begun < 0 ? begun : finish(report);
  });
  return report;
}

void World::begin_step(double dt) {
  call_unlocked(Tag::world, "begin_step", [&](const PlumbBackendTable&, PlumbWorld*) { return begin(dt); });
}

Report World::wait() {
  const Passage passage(gate_, Tag::world, "wait");
  require_stepping("wait");
  Report report{};
  checked(unlocked([&] { return finish(report); }));
  return report;
}

}  // namespace plumb::python
