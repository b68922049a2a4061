// The core table's calls: shapes, bodies, rows, steps, and what comes out of steps.
#include "numbers.hpp"
#include "shapes.hpp"
#include "world.hpp"

namespace plumb::python {
namespace {

py::array_t<std::uint64_t> create_shapes(World& world, const std::vector<const Shape*>& shapes) {
  std::vector<PlumbShapeDesc> descs;
  for (const Shape* shape : shapes) descs.push_back(shape->pointing());
  std::vector<PlumbShape> ids(descs.size());
  world.call(Tag::world, "create_shapes", [&](const PlumbBackendTable& table, PlumbWorld* self) {
    return table.create_shapes(self, descs.data(), sizeof(PlumbShapeDesc), count_of(descs.size()), ids.data());
  });
  return handles(ids);
}

py::array_t<std::uint64_t> create_bodies(World& world, const py::array& rows) {
  const auto descs = rows_of<PlumbBodyDesc>(rows, "bodies");
  std::vector<PlumbBody> ids(descs.size());
  world.call(Tag::world, "create_bodies", [&](const PlumbBackendTable& table, PlumbWorld* self) {
    return table.create_bodies(self, descs.data(), sizeof(PlumbBodyDesc), count_of(descs.size()), ids.data());
  });
  return handles(ids);
}

void destroy_shapes(World& world, const Handles& ids) {
  world.call(Tag::world, "destroy_shapes", [&](const PlumbBackendTable& table, PlumbWorld* self) {
    return table.destroy_shapes(self, ids.data(), count_of(ids));
  });
}

void destroy_bodies(World& world, const Handles& ids) {
  world.call(Tag::world, "destroy_bodies", [&](const PlumbBackendTable& table, PlumbWorld* self) {
    return table.destroy_bodies(self, ids.data(), count_of(ids));
  });
}

py::array_t<std::uint64_t> list_bodies(World& world) {
  std::vector<PlumbBody> ids;
  world.call(Tag::world, "bodies", [&](const PlumbBackendTable& table, PlumbWorld* self) {
    return fill_all(ids, [&](PlumbBody* out, std::uint32_t capacity, std::uint32_t* count) {
      return table.list_bodies(self, out, capacity, count);
    });
  });
  return handles(ids);
}

std::uint64_t user_data(World& world, PlumbBody id) {
  std::uint64_t value = 0;
  world.call(Tag::world, "user_data",
             [&](const PlumbBackendTable& table, PlumbWorld* self) { return table.user_data(self, id, &value); });
  return value;
}

void set_gravity(World& world, std::array<double, 3> gravity) {
  const PlumbVec3 value = {gravity[0], gravity[1], gravity[2]};
  world.call(Tag::world, "set_gravity",
             [&](const PlumbBackendTable& table, PlumbWorld* self) { return table.set_gravity(self, &value); });
}

py::array contacts(World& world) {
  std::vector<PlumbContact> rows;
  world.call(Tag::world, "contacts", [&](const PlumbBackendTable& table, PlumbWorld* self) {
    return fill_all(rows, [&](PlumbContact* out, std::uint32_t capacity, std::uint32_t* count) {
      return table.contacts(self, out, sizeof *out, capacity, count);
    });
  });
  return array_of(rows);
}

py::array events(World& world) {
  std::vector<PlumbEvent> rows;
  world.call(Tag::world, "events", [&](const PlumbBackendTable& table, PlumbWorld* self) {
    return fill_all(rows, [&](PlumbEvent* out, std::uint32_t capacity, std::uint32_t* count) {
      return table.events(self, out, sizeof *out, capacity, count);
    });
  });
  return array_of(rows);
}

void read(World& world, PlumbField field, const std::optional<Handles>& ids, py::array rows) {
  const RowsOfNumbers numbers = numbers_in(rows, columns_of(field), ids);
  void* data = rows.mutable_data();  // throws ValueError where NumPy says that it may not be written
  world.call(Tag::world, "read", [&](const PlumbBackendTable& table, PlumbWorld* self) {
    return table.read(self, field, numbers.type, numbers.ids, numbers.count, data, numbers.stride);
  });
}

void write(World& world, PlumbField field, const std::optional<Handles>& ids, const py::array& rows) {
  const RowsOfNumbers numbers = numbers_in(rows, columns_of(field), ids);
  world.call(Tag::world, "write", [&](const PlumbBackendTable& table, PlumbWorld* self) {
    return table.write(self, field, numbers.type, numbers.ids, numbers.count, rows.data(), numbers.stride);
  });
}

void bind_report(WorldClass& world) {
  py::class_<Report>(world, "Report")
      .def_readonly("threads", &Report::threads)
      .def_readonly("step", &Report::step)
      .def_readonly("bodies", &Report::bodies)
      .def_readonly("awake", &Report::awake)
      .def_readonly("pairs", &Report::pairs)
      .def_readonly("contacts", &Report::contacts)
      .def_readonly("joints", &Report::joints)
      .def_readonly("dropped", &Report::dropped)
      .def_readonly("nonfinite", &Report::nonfinite)
      .def_readonly("remarks", &Report::remarks)
      .def_readonly("residual", &Report::residual)
      .def("phase_seconds", [](const Report& report) {
        return std::vector<double>(report.phase_seconds, report.phase_seconds + PLUMB_PHASE_COUNT);
      });
}

}  // namespace

void bind_core(WorldClass& world) {
  bind_report(world);
  world.def("close", &World::close)
      .def_property_readonly("closed", &World::closed)
      .def("create_shapes", &create_shapes)
      .def("destroy_shapes", &destroy_shapes)
      .def("create_bodies", &create_bodies)
      .def("destroy_bodies", &destroy_bodies)
      .def("bodies", &list_bodies)
      .def("user_data", &user_data)
      .def("set_gravity", &set_gravity)
      .def("read", &read)
      .def("write", &write)
      .def("step", &World::step)
      .def("begin_step", &World::begin_step)
      .def("wait", &World::wait)
      .def("contacts", &contacts)
      .def("events", &events);
}

}  // namespace plumb::python
