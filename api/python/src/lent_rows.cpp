#include "lent_rows.hpp"

namespace plumb::python {
namespace {

/// DLPack's older layout, which has no version and no flags.
struct UnversionedTensor {
  PlumbDLTensor dl_tensor;
  void* manager_ctx;
  void (*deleter)(UnversionedTensor* self);
};

/// One more owner of a lent tensor, in the layout that a consumer takes.
template <class Tensor>
struct Handed {
  Tensor tensor{};
  Lent owner;

  static py::capsule capsule(Lent owner, const char* name) {
    auto handed = std::make_unique<Handed>();
    handed->owner = std::move(owner);
    Tensor& tensor = handed->tensor;
    tensor.dl_tensor = handed->owner->dl_tensor;
    tensor.manager_ctx = handed.get();
    tensor.deleter = [](Tensor* self) { delete static_cast<Handed*>(self->manager_ctx); };
    if constexpr (requires { tensor.flags; }) {
      tensor.version = handed->owner->version;
      tensor.flags = handed->owner->flags;
    }
    // A consumer renames the capsule when it takes the tensor over; what still has its name was not taken.
    PyObject* made = PyCapsule_New(&tensor, name, [](PyObject* self) {
      const char* own = PyCapsule_GetName(self);
      if (own == nullptr || std::string_view(own).starts_with("used_")) return;
      auto* left = static_cast<Tensor*>(PyCapsule_GetPointer(self, own));
      left->deleter(left);
    });
    if (made == nullptr) throw py::error_already_set();
    handed.release();
    return py::reinterpret_steal<py::capsule>(made);
  }
};

}  // namespace

LentRows::LentRows(PlumbDLManagedTensor* lent, const PlumbFence& readable)
    : tensor(lent, [](PlumbDLManagedTensor* done) { done->deleter(done); }), fence(readable) {
  const PlumbDLDataType& type = tensor->dl_tensor.dtype;
  if (type.code != 2 || (type.bits != 32 && type.bits != 64) || type.lanes != 1)
    throw Error(PLUMB_E_INTERNAL, "borrow: the backend lends rows that are neither float32 nor float64");
}

py::capsule LentRows::capsule(bool versioned) const {
  return versioned ? Handed<PlumbDLManagedTensor>::capsule(tensor, "dltensor_versioned")
                   : Handed<UnversionedTensor>::capsule(tensor, "dltensor");
}

py::array LentRows::view(const py::object& self) {
  const auto& rows = self.cast<const LentRows&>();
  const PlumbDLTensor& lent = rows.tensor->dl_tensor;
  const py::dtype type = lent.dtype.bits == 64 ? py::dtype::of<double>() : py::dtype::of<float>();
  std::vector<py::ssize_t> shape(lent.shape, lent.shape + lent.ndim), strides;
  for (int axis = 0; axis < lent.ndim; ++axis)
    strides.push_back(static_cast<py::ssize_t>(lent.strides[axis]) * type.itemsize());
  const auto* data = static_cast<const std::byte*>(lent.data) + lent.byte_offset;
  py::array view(type, shape, strides, data, self);
  if ((rows.tensor->flags & 1) != 0) view.attr("flags").attr("writeable") = false;
  return view;
}

}  // namespace plumb::python
