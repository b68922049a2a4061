// plumb.state/1: rows without a copy, for NumPy on the host and by DLPack for everybody.
#include "lent_rows.hpp"
#include "world.hpp"

namespace plumb::python {
namespace {

constexpr std::int32_t kHost = 1, kCuda = 2;

LentRows borrow(World& world, PlumbField field, std::int32_t device_type, bool allow_copy) {
  const auto& state = world.extension<PlumbStateTable>(PLUMB_EXT_STATE);
  const PlumbStateRequest request = {sizeof request, field, device_type, allow_copy ? 1u : 0u};
  PlumbDLManagedTensor* tensor = nullptr;
  PlumbFence fence{};
  world.call(Tag::world, "state.borrow",
             [&](const PlumbBackendTable&, PlumbWorld* self) { return state.borrow(self, &request, &tensor, &fence); });
  return {tensor, fence};
}

std::pair<py::array_t<std::uint64_t>, std::uint64_t> row_map(World& world) {
  const auto& state = world.extension<PlumbStateTable>(PLUMB_EXT_STATE);
  std::vector<PlumbBody> ids;
  std::uint64_t generation = 0;
  world.call(Tag::world, "state.rows", [&](const PlumbBackendTable&, PlumbWorld* self) {
    return fill_all(ids, [&](PlumbBody* out, std::uint32_t capacity, std::uint32_t* count) {
      return state.rows(self, out, capacity, count, &generation);
    });
  });
  return {handles(ids), generation};
}

py::capsule dlpack(const LentRows& rows, const std::optional<std::intptr_t>& stream,
                   const std::optional<std::pair<int, int>>& version) {
  const PlumbDLDevice& device = rows.tensor->dl_tensor.device;
  const bool ordered = device.device_type != kHost && stream.value_or(1) != -1;
  if (ordered && rows.fence.event != nullptr) order_behind(rows.fence.event, device.device_id, stream.value_or(1));
  return rows.capsule(version && version->first >= 1);
}

}  // namespace

void bind_state(py::module_& module) {
  module.attr("host_device") = kHost;
  module.attr("cuda_device") = kCuda;
  module.def("borrow", &borrow);
  module.def("row_map", &row_map);
  py::class_<LentRows>(module, "LentRows")
      .def("view", &LentRows::view)
      .def("dlpack", &dlpack)
      .def_property_readonly("device",
                             [](const LentRows& rows) {
                               const PlumbDLDevice& device = rows.tensor->dl_tensor.device;
                               return std::pair(device.device_type, device.device_id);
                             })
      .def_property_readonly("shape",
                             [](const LentRows& rows) {
                               const PlumbDLTensor& lent = rows.tensor->dl_tensor;
                               return py::tuple(py::cast(std::vector(lent.shape, lent.shape + lent.ndim)));
                             })
      .def_property_readonly("bits", [](const LentRows& rows) { return rows.tensor->dl_tensor.dtype.bits; })
      .def_property_readonly("flags", [](const LentRows& rows) { return rows.tensor->flags; })
      .def_property_readonly("address",
                             [](const LentRows& rows) {
                               const PlumbDLTensor& lent = rows.tensor->dl_tensor;
                               return reinterpret_cast<std::uintptr_t>(lent.data) + lent.byte_offset;
                             })
      .def_property_readonly("fence", [](const LentRows& rows) {
        return std::pair(reinterpret_cast<std::uintptr_t>(rows.fence.stream),
                         reinterpret_cast<std::uintptr_t>(rows.fence.event));
      });
}

}  // namespace plumb::python
