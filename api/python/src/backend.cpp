// Backends: where they are, what they are, what they can, and worlds of them.
#include "core.hpp"
#include "shapes.hpp"
#include "unlocked.hpp"
#include "world.hpp"

namespace plumb::python {
namespace {

py::dict info_of(const Backend& backend) {
  const PlumbBackendInfo& info = backend.info();
  py::dict facts;
  facts["name"] = info.name;
  facts["version"] = info.version;
  facts["build"] = info.build;
  facts["description"] = info.description;
  facts["device"] = info.device;
  facts["exclusion_group"] = info.exclusion_group;
  facts["precision"] = info.precision == PLUMB_F64 ? "f64" : "f32";
  facts["determinism"] = info.determinism;
  facts["max_threads"] = info.max_threads;
  return facts;
}

py::object value_of(const PlumbSettingValue& value) {
  switch (value.type) {
    case PLUMB_SETTING_BOOL: return py::bool_(value.number != 0);
    case PLUMB_SETTING_INT: return py::int_(static_cast<std::int64_t>(value.number));
    case PLUMB_SETTING_CHOICE: return py::str(value.choice);
    default: return py::float_(value.number);
  }
}

py::list settings_of(const Backend& backend) {
  py::list all;
  for (const PlumbSettingInfo* info : backend.settings()) {
    py::dict facts;
    facts["name"] = info->name;
    facts["unit"] = info->unit;
    facts["doc"] = info->doc;
    facts["type"] = info->type;
    facts["role"] = info->role;
    facts["creation_only"] = (info->flags & PLUMB_SETTING_CREATION_ONLY) != 0;
    facts["choices"] = std::vector<std::string>(info->choices, info->choices + info->choice_count);
    facts["minimum"] = info->minimum;
    facts["maximum"] = info->maximum;
    facts["default"] = value_of(info->default_value);
    all.append(facts);
  }
  return all;
}

/// Name, type, number and word of each setting; the words live as long as the list.
using SettingTuple = std::tuple<std::string, PlumbSettingType, double, std::string>;

std::unique_ptr<World> make_world(const Backend& backend, PlumbNeeds needs, std::array<double, 3> gravity,
                                  std::uint32_t threads, const std::vector<SettingTuple>& given,
                                  std::array<std::uint32_t, 3> capacities) {
  std::vector<PlumbSetting> settings;
  for (const auto& [name, type, number, word] : given)
    settings.push_back({name.c_str(), {type, 0, number, type == PLUMB_SETTING_CHOICE ? word.c_str() : nullptr}});
  PlumbWorldDesc desc{};
  desc.struct_size = sizeof desc;
  desc.threads = threads;
  desc.needs = needs;
  desc.gravity = {gravity[0], gravity[1], gravity[2]};
  desc.body_capacity = capacities[0];
  desc.contact_capacity = capacities[1];
  desc.joint_capacity = capacities[2];
  desc.settings = settings.data();
  desc.setting_count = static_cast<std::uint32_t>(settings.size());
  return std::make_unique<World>(backend.table(), desc);
}

py::bytes cook(const Backend& backend, const Shape& shape) {
  const PlumbShapeDesc desc = shape.pointing();
  const std::vector<std::byte> bytes = unlocked([&] { return backend.cook(desc); });
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

}  // namespace

void bind_backend(py::module_& module) {
  module.attr("interface_version") =
      py::make_tuple(PLUMB_VERSION_MAJOR(PLUMB_VERSION), PLUMB_VERSION_MINOR(PLUMB_VERSION));
  module.attr("installed_prefix") = PLUMB_PYTHON_PREFIX;
  module.def("backend_path", &backend_path);
  module.def("open_backend", [](const std::string& file) { return open_backend(file); });
  py::class_<Backend>(module, "Backend")
      .def_property_readonly("file", &Backend::file)
      .def("info", &info_of)
      .def("settings", &settings_of)
      .def("capability",
           [](const Backend& backend, PlumbCapability kind, std::uint32_t a, std::uint32_t b) {
             return std::pair(backend.capability(kind, a, b), backend.capability_note(kind, a, b));
           })
      .def("has_extension", [](const Backend& backend,
                               const std::string& name) { return backend.table().extension(name.c_str()) != nullptr; })
      .def("cook", &cook)
      .def("world", &make_world);
}

}  // namespace plumb::python
