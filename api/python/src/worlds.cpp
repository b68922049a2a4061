#include "worlds.hpp"

#include <thread>

#include "numbers.hpp"

namespace plumb::python {

namespace {

/// What act() throws, with the world's number in front.
template <class Act>
auto of_world(std::size_t i, Act&& act) {
  const auto named = [i](const std::exception& error) { return "world " + std::to_string(i) + ": " + error.what(); };
  try {
    return act();
  } catch (const Error& error) {
    throw Error(error.code(), named(error));
  } catch (const py::value_error& error) {
    throw py::value_error(named(error));
  }
}

std::uint32_t threads_for(std::size_t worlds, std::uint32_t wanted) {
  const std::uint32_t most = wanted != 0 ? wanted : std::max(1U, std::thread::hardware_concurrency());
  return static_cast<std::uint32_t>(std::min<std::size_t>(most, worlds));
}

std::vector<World*> pointers_to(const py::tuple& worlds) {
  std::vector<World*> pointers;
  for (const py::handle world : worlds) pointers.push_back(world.cast<World*>());
  if (pointers.empty()) throw py::value_error("worlds: there are none; give at least one");
  return pointers;
}

std::vector<PlumbBody> bodies_of(World& world) {
  std::vector<PlumbBody> ids;
  world.call(Tag::world, "bodies", [&](const PlumbBackendTable& table, PlumbWorld* self) {
    return fill_all(ids, [&](PlumbBody* out, std::uint32_t capacity, std::uint32_t* count) {
      return table.list_bodies(self, out, capacity, count);
    });
  });
  return ids;
}

}  // namespace

// --- coming together -------------------------------------------------------------------------------------------------

Worlds::Worlds(py::tuple worlds, std::uint32_t threads)
    : kept_(std::move(worlds)), worlds_(pointers_to(kept_)), together_(threads_for(worlds_.size(), threads)) {
  for (std::size_t i = 0; i < worlds_.size(); ++i) {
    const std::string name = "worlds[" + std::to_string(i) + "]";
    if (&worlds_[i]->table_ != &worlds_[0]->table_)
      throw py::value_error(name + " is of " + worlds_[i]->table_.info()->name + " and worlds[0] of " +
                            worlds_[0]->table_.info()->name + ": step worlds of one backend together");
    ids_.push_back(of_world(i, [&] { return bodies_of(*worlds_[i]); }));
    if (ids_[i].size() != ids_[0].size())
      throw py::value_error(name + " has " + std::to_string(ids_[i].size()) + " bodies and worlds[0] has " +
                            std::to_string(ids_[0].size()) + ": make all alike before they come together");
  }
  group();
}

const PlumbWorldsTable* Worlds::extension() const {
  return static_cast<const PlumbWorldsTable*>(worlds_[0]->table_.extension(PLUMB_EXT_WORLDS));
}

void Worlds::group() {
  const Passages passages = enter("group");
  std::vector<PlumbWorld*> others;
  for (World* world : std::span(worlds_).subspan(1)) others.push_back(world->world_);
  if (const PlumbWorldsTable* table = extension(); table != nullptr)
    worlds_[0]->checked(
        unlocked([&] { return table->group(worlds_[0]->world_, others.data(), count_of(others.size())); }));
  for (World* world : worlds_) world->together_ = this;
}

py::array_t<std::uint64_t> Worlds::bodies() const {
  py::array_t<std::uint64_t> all({ids_.size(), ids_[0].size()});
  for (std::size_t i = 0; i < ids_.size(); ++i)
    std::copy(ids_[i].begin(), ids_[i].end(), all.mutable_data() + i * ids_[0].size());
  return all;
}

// --- calls on all ----------------------------------------------------------------------------------------------------

Worlds::Passages Worlds::enter(const char* name) {
  Passages passages;
  for (std::size_t i = 0; i < worlds_.size(); ++i)
    of_world(i, [&] {
      passages.emplace_back(worlds_[i]->gate_, Tag::world, name);
      worlds_[i]->require_ready(name);
    });
  return passages;
}

template <class Act>
void Worlds::each(Act&& act) {
  together_.each(worlds_.size(), [&](std::size_t i) { of_world(i, [&] { worlds_[i]->checked(act(i)); }); });
}

template <class Act>
void Worlds::call(const char* name, Act&& act) {
  const Passages passages = enter(name);
  unlocked([&] {
    each(act);
    return true;
  });
}

void Worlds::step(double dt) {
  const Passages passages = enter("step");
  std::vector<Report> reports(worlds_.size());  // others may look at the last ones meanwhile
  std::vector<PlumbResult> begun(worlds_.size(), PLUMB_E_INTERNAL);
  // Who has begun is waited for, whatever became of others.
  const std::exception_ptr failure = unlocked([&] {
    std::exception_ptr first;
    const auto phase = [&](const auto& act) {
      try {
        each(act);
      } catch (...) {
        if (!first) first = std::current_exception();
      }
    };
    phase([&](std::size_t i) { return begun[i] = worlds_[i]->begin(dt); });
    phase([&](std::size_t i) { return begun[i] < 0 ? PLUMB_OK : worlds_[i]->finish(reports[i]); });
    return first;
  });
  reports_ = std::move(reports);
  if (failure) std::rethrow_exception(failure);
}

std::span<const bool> Worlds::checked(const Mask& mask) const {
  if (mask.ndim() != 1 || static_cast<std::size_t>(mask.size()) != worlds_.size())
    throw py::value_error("mask must have an entry for each world");
  return {mask.data(), worlds_.size()};
}

// --- there and back --------------------------------------------------------------------------------------------------

void Worlds::mark() {
  const auto& snapshot = worlds_[0]->extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT);
  std::vector<std::string> marks(worlds_.size());
  call("mark", [&](std::size_t i) {
    return fill_bytes(marks[i], [&](void* out, std::size_t capacity, std::size_t* size) {
      return snapshot.save(worlds_[i]->world_, out, capacity, size);
    });
  });
  marks_ = std::move(marks);
}

void Worlds::reset(const Mask& mask) {
  const auto& snapshot = worlds_[0]->extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT);
  const std::span<const bool> chosen = checked(mask);
  if (marks_.empty()) throw Error(PLUMB_E_WRONG_PHASE, "reset: there is nothing to go back to; call mark() before");
  call("reset", [&](std::size_t i) {
    return chosen[i] ? snapshot.restore(worlds_[i]->world_, marks_[i].data(), marks_[i].size()) : PLUMB_OK;
  });
}

// --- rows ------------------------------------------------------------------------------------------------------------

/// Numbers of all worlds, and whose they are.
struct Worlds::Block {
  RowsOfNumbers of_one;
  py::ssize_t stride;  // bytes from world to world
  std::optional<std::span<const std::uint32_t>> places;

  /// Calls use(ids), with the handles of the bodies in a world that has these ones.
  template <class Use>
  PlumbResult with_ids(const std::vector<PlumbBody>& all, Use&& use) const {
    if (!places) return use(all.data());
    std::vector<PlumbBody> ids;
    for (const std::uint32_t place : *places) ids.push_back(all[place]);
    return use(ids.data());
  }
};

Worlds::Block Worlds::block_of(const py::array& rows, std::size_t count, std::uint32_t columns) const {
  if (rows.ndim() != 3 || static_cast<std::size_t>(rows.shape(0)) != worlds_.size() ||
      static_cast<std::size_t>(rows.shape(1)) != count)
    throw py::value_error("rows must be of worlds x " + std::to_string(count) + " x columns, not of shape " +
                          std::string(py::str(rows.attr("shape"))));
  return {numbers_in(py::array(rows[py::int_(0)]), columns, std::nullopt), rows.strides(0), {}};
}

Worlds::Block Worlds::block_of(PlumbField field, const std::optional<Places>& places, const py::array& rows) const {
  const std::size_t bodies = places ? static_cast<std::size_t>(places->size()) : ids_[0].size();
  Block block = block_of(rows, bodies, columns_of(field));
  if (!places) return block;
  block.places.emplace(places->data(), bodies);
  for (const std::uint32_t place : *block.places)
    if (place >= ids_[0].size()) throw py::value_error("there is no body " + std::to_string(place));
  return block;
}

void Worlds::read(PlumbField field, const std::optional<Places>& places, py::array rows) {
  const Block block = block_of(field, places, rows);
  auto* data = static_cast<std::byte*>(rows.mutable_data());  // throws ValueError where it may not be written
  if (block.of_one.count == 0) return;
  call("read", [&](std::size_t i) {
    return block.with_ids(ids_[i], [&](const PlumbBody* ids) {
      return worlds_[i]->table_.read(worlds_[i]->world_, field, block.of_one.type, ids, block.of_one.count,
                                     data + static_cast<py::ssize_t>(i) * block.stride, block.of_one.stride);
    });
  });
}

void Worlds::write(PlumbField field, const std::optional<Places>& places, const py::array& rows, const Mask& mask) {
  const Block block = block_of(field, places, rows);
  const std::span<const bool> chosen = checked(mask);
  const auto* data = static_cast<const std::byte*>(rows.data());
  if (block.of_one.count == 0) return;
  call("write", [&](std::size_t i) {
    if (!chosen[i]) return PlumbResult{PLUMB_OK};
    return block.with_ids(ids_[i], [&](const PlumbBody* ids) {
      return worlds_[i]->table_.write(worlds_[i]->world_, field, block.of_one.type, ids, block.of_one.count,
                                      data + static_cast<py::ssize_t>(i) * block.stride, block.of_one.stride);
    });
  });
}

void Worlds::read_joints(PlumbJointField field, const Handles& joints, py::array rows) {
  const auto& table = worlds_[0]->extension<PlumbJointsTable>(PLUMB_EXT_JOINTS);
  const Block block = block_of(rows, static_cast<std::size_t>(joints.size()), joint_columns_of(field));
  auto* data = static_cast<std::byte*>(rows.mutable_data());
  const PlumbJoint* ids = joints.data();
  if (block.of_one.count == 0) return;
  call("joints.read", [&](std::size_t i) {
    return table.read(worlds_[i]->world_, field, block.of_one.type, ids, block.of_one.count,
                      data + static_cast<py::ssize_t>(i) * block.stride, block.of_one.stride);
  });
}

void Worlds::write_joints(PlumbJointField field, const Handles& joints, const py::array& rows, const Mask& mask) {
  const auto& table = worlds_[0]->extension<PlumbJointsTable>(PLUMB_EXT_JOINTS);
  const Block block = block_of(rows, static_cast<std::size_t>(joints.size()), joint_columns_of(field));
  const std::span<const bool> chosen = checked(mask);
  const auto* data = static_cast<const std::byte*>(rows.data());
  const PlumbJoint* ids = joints.data();
  if (block.of_one.count == 0) return;
  call("joints.write", [&](std::size_t i) {
    if (!chosen[i]) return PlumbResult{PLUMB_OK};
    return table.write(worlds_[i]->world_, field, block.of_one.type, ids, block.of_one.count,
                       data + static_cast<py::ssize_t>(i) * block.stride, block.of_one.stride);
  });
}

LentRows Worlds::borrow(PlumbField field, std::int32_t device_type, bool allow_copy) {
  const PlumbWorldsTable* table = extension();
  if (table == nullptr)
    throw Error(PLUMB_E_UNSUPPORTED, std::string(worlds_[0]->table_.info()->name) + " has no " + PLUMB_EXT_WORLDS +
                                         ": read() the rows of all worlds instead");
  const Passages passages = enter("borrow");
  // The backend would lend the rows of the group in which the first world is now.
  for (std::size_t i = 0; i < worlds_.size(); ++i)
    if (worlds_[i]->together_ != this)
      throw Error(PLUMB_E_INVALID_ARGUMENT,
                  "borrow: world " + std::to_string(i) +
                      " has come together with other worlds since; make Worlds of these anew");
  const PlumbStateRequest request = {sizeof request, field, device_type, allow_copy ? 1u : 0u};
  PlumbDLManagedTensor* tensor = nullptr;
  PlumbFence fence{};
  worlds_[0]->checked(unlocked([&] { return table->borrow_all(worlds_[0]->world_, &request, &tensor, &fence); }));
  return {tensor, fence};
}

void bind_worlds(py::module_& module) {
  py::class_<Worlds>(module, "Worlds")
      .def(py::init<py::tuple, std::uint32_t>())
      .def("bodies", &Worlds::bodies)
      .def("step", &Worlds::step)
      .def("reports", &Worlds::reports)
      .def("mark", &Worlds::mark)
      .def("reset", &Worlds::reset)
      .def("read", &Worlds::read)
      .def("write", &Worlds::write)
      .def("read_joints", &Worlds::read_joints)
      .def("write_joints", &Worlds::write_joints)
      .def("borrow", &Worlds::borrow);
}

}  // namespace plumb::python
