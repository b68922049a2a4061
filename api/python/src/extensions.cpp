// Calls of the extensions that change or save a world: joints, changes, settings, snapshots, excluded pairs.
#include "numbers.hpp"
#include "shapes.hpp"
#include "world.hpp"

namespace plumb::python {
namespace {

// --- joints ----------------------------------------------------------------------------------------------------------

py::array_t<std::uint64_t> create_joints(World& world, const py::array& rows) {
  const auto& joints = world.extension<PlumbJointsTable>(PLUMB_EXT_JOINTS);
  const auto descs = rows_of<PlumbJointDesc>(rows, "joints");
  std::vector<PlumbJoint> ids(descs.size());
  world.call(Tag::world, "joints.create", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return joints.create(self, descs.data(), sizeof(PlumbJointDesc), count_of(descs.size()), ids.data());
  });
  return handles(ids);
}

void destroy_joints(World& world, const Handles& ids) {
  const auto& joints = world.extension<PlumbJointsTable>(PLUMB_EXT_JOINTS);
  world.call(Tag::world, "joints.destroy", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return joints.destroy(self, ids.data(), count_of(ids));
  });
}

void read_joints(World& world, PlumbJointField field, const std::optional<Handles>& ids, py::array rows) {
  const auto& joints = world.extension<PlumbJointsTable>(PLUMB_EXT_JOINTS);
  const RowsOfNumbers numbers = numbers_in(rows, joint_columns_of(field), ids);
  void* data = rows.mutable_data();
  world.call(Tag::world, "joints.read", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return joints.read(self, field, numbers.type, numbers.ids, numbers.count, data, numbers.stride);
  });
}

void write_joints(World& world, PlumbJointField field, const std::optional<Handles>& ids, const py::array& rows) {
  const auto& joints = world.extension<PlumbJointsTable>(PLUMB_EXT_JOINTS);
  const RowsOfNumbers numbers = numbers_in(rows, joint_columns_of(field), ids);
  world.call(Tag::world, "joints.write", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return joints.write(self, field, numbers.type, numbers.ids, numbers.count, rows.data(), numbers.stride);
  });
}

// --- changes ---------------------------------------------------------------------------------------------------------

void modify_bodies(World& world, const py::array& rows) {
  const auto& modify = world.extension<PlumbModifyTable>(PLUMB_EXT_MODIFY);
  const auto changes = rows_of<PlumbBodyChange>(rows, "changes");
  world.call(Tag::world, "modify.bodies", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return modify.bodies(self, changes.data(), sizeof(PlumbBodyChange), count_of(changes.size()));
  });
}

void modify_joints(World& world, const py::array& rows) {
  const auto& modify = world.extension<PlumbModifyTable>(PLUMB_EXT_MODIFY);
  const auto changes = rows_of<PlumbJointChange>(rows, "changes");
  world.call(Tag::world, "modify.joints", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return modify.joints(self, changes.data(), sizeof(PlumbJointChange), count_of(changes.size()));
  });
}

void modify_shapes(World& world, const Handles& ids, const std::vector<const Shape*>& others) {
  const auto& modify = world.extension<PlumbModifyTable>(PLUMB_EXT_MODIFY);
  if (ids.size() != static_cast<py::ssize_t>(others.size()))
    throw Error(PLUMB_E_INVALID_ARGUMENT, std::to_string(ids.size()) + " shapes become " +
                                              std::to_string(others.size()) + " others; give as many");
  if (!has(modify, &PlumbModifyTable::shapes))
    throw Error(PLUMB_E_UNSUPPORTED, "the backend is older than changes of shapes; get a newer one");
  std::vector<PlumbShapeDesc> descs;
  for (const Shape* shape : others) descs.push_back(shape->pointing());
  world.call(Tag::world, "modify.shapes", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return modify.shapes(self, ids.data(), descs.data(), sizeof(PlumbShapeDesc), count_of(descs.size()));
  });
}

// --- contacts of a step that is under way ----------------------------------------------------------------------------

py::array read_manifolds(World& world) {
  const auto& manifolds = world.extension<PlumbManifoldsTable>(PLUMB_EXT_MANIFOLDS);
  std::vector<PlumbManifold> rows;
  world.call_in_step(Tag::world, "manifolds.read", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(rows, [&](PlumbManifold* out, std::uint32_t capacity, std::uint32_t* count) {
      return manifolds.read(self, out, sizeof *out, capacity, count);
    });
  });
  return array_of(rows);
}

void modify_manifolds(World& world, const py::array& rows) {
  const auto& manifolds = world.extension<PlumbManifoldsTable>(PLUMB_EXT_MANIFOLDS);
  const auto changes = rows_of<PlumbManifoldChange>(rows, "changes");
  world.call_in_step(Tag::world, "manifolds.modify", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return manifolds.modify(self, changes.data(), sizeof(PlumbManifoldChange), count_of(changes.size()));
  });
}

// --- settings --------------------------------------------------------------------------------------------------------

std::pair<double, std::string> get_setting(World& world, const std::string& name) {
  const auto& settings = world.extension<PlumbSettingsTable>(PLUMB_EXT_SETTINGS);
  PlumbSettingValue value{};
  world.call(Tag::world, "settings",
             [&](const PlumbBackendTable&, PlumbWorld* self) { return settings.get(self, name.c_str(), &value); });
  return {value.number, value.choice == nullptr ? "" : value.choice};
}

void set_setting(World& world, const std::string& name, PlumbSettingType type, double number, const std::string& word) {
  const auto& settings = world.extension<PlumbSettingsTable>(PLUMB_EXT_SETTINGS);
  const PlumbSettingValue value = {type, 0, number, type == PLUMB_SETTING_CHOICE ? word.c_str() : nullptr};
  world.call(Tag::world, "settings",
             [&](const PlumbBackendTable&, PlumbWorld* self) { return settings.set(self, name.c_str(), &value); });
}

// --- snapshots -------------------------------------------------------------------------------------------------------

py::bytes save(World& world, bool whole) {
  const auto& snapshot = world.extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT);
  std::string bytes;
  world.call_unlocked(Tag::world, "snapshot.save", [&](const PlumbBackendTable&, PlumbWorld* self) {
    if (whole && !has(snapshot, &PlumbSnapshotTable::save_world)) return PlumbResult{PLUMB_E_UNSUPPORTED};
    const auto function = whole ? snapshot.save_world : snapshot.save;
    return fill_bytes(
        bytes, [&](void* out, std::size_t capacity, std::size_t* size) { return function(self, out, capacity, size); });
  });
  return bytes;
}

void restore(World& world, const py::bytes& saved) {
  const auto& snapshot = world.extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT);
  const std::string_view bytes = saved;
  world.call_unlocked(Tag::world, "snapshot.restore", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return snapshot.restore(self, bytes.data(), bytes.size());
  });
}

std::uint64_t hash(World& world) {
  const auto& snapshot = world.extension<PlumbSnapshotTable>(PLUMB_EXT_SNAPSHOT);
  std::uint64_t value = 0;
  world.call(Tag::world, "snapshot.hash",
             [&](const PlumbBackendTable&, PlumbWorld* self) { return snapshot.hash(self, &value); });
  return value;
}

// --- excluded pairs --------------------------------------------------------------------------------------------------

void set_exceptions(World& world, const py::array& rows, bool touch) {
  const auto& exceptions = world.extension<PlumbExceptionsTable>(PLUMB_EXT_EXCEPTIONS);
  const auto pairs = rows_of<PlumbBodyPair>(rows, "pairs");
  world.call(Tag::world, "exceptions.set", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return exceptions.set(self, pairs.data(), sizeof(PlumbBodyPair), count_of(pairs.size()), touch ? 1 : 0);
  });
}

py::array list_exceptions(World& world) {
  const auto& exceptions = world.extension<PlumbExceptionsTable>(PLUMB_EXT_EXCEPTIONS);
  std::vector<PlumbBodyPair> pairs;
  world.call(Tag::world, "exceptions.list", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(pairs, [&](PlumbBodyPair* out, std::uint32_t capacity, std::uint32_t* count) {
      return exceptions.list(self, out, capacity, count);
    });
  });
  return array_of(pairs);
}

py::array_t<std::uint64_t> create_cooked(World& world, const std::vector<py::buffer>& shapes) {
  const auto& cooking = world.extension<PlumbCookingTable>(PLUMB_EXT_COOKING);
  std::vector<py::buffer_info> held;  // so that nobody makes them longer or shorter meanwhile
  std::vector<PlumbCookedShape> cooked;
  for (const py::buffer& shape : shapes) {
    held.push_back(shape.request());
    const py::buffer_info& info = held.back();
    if (PyBuffer_IsContiguous(info.view(), 'C') == 0)
      throw py::value_error("bytes of a cooked shape must lie one after another; copy them");
    cooked.push_back({sizeof(PlumbCookedShape), 0, info.ptr, static_cast<std::uint64_t>(info.size * info.itemsize)});
  }
  std::vector<PlumbShape> ids(cooked.size());
  world.call(Tag::world, "create_cooked", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return cooking.create(self, cooked.data(), sizeof(PlumbCookedShape), count_of(cooked.size()), ids.data());
  });
  return handles(ids);
}

}  // namespace

void bind_extensions(WorldClass& world) {
  world.def("create_joints", &create_joints)
      .def("destroy_joints", &destroy_joints)
      .def("read_joints", &read_joints)
      .def("write_joints", &write_joints)
      .def("create_cooked", &create_cooked)
      .def("modify_bodies", &modify_bodies)
      .def("modify_joints", &modify_joints)
      .def("modify_shapes", &modify_shapes)
      .def("read_manifolds", &read_manifolds)
      .def("modify_manifolds", &modify_manifolds)
      .def("get_setting", &get_setting)
      .def("set_setting", &set_setting)
      .def("save", &save, py::arg("whole"))
      .def("restore", &restore)
      .def("hash", &hash)
      .def("set_exceptions", &set_exceptions)
      .def("list_exceptions", &list_exceptions);
}

}  // namespace plumb::python
