// Waiting for an engine's event on somebody's stream, by the driver that is loaded already: nothing links to CUDA.
#include <dlfcn.h>

#include "lent_rows.hpp"

namespace plumb::python {
namespace {

struct Driver {
  int (*device_get)(int* device, int ordinal) = nullptr;
  int (*retain_context)(void** context, int device) = nullptr;
  int (*release_context)(int device) = nullptr;
  int (*push_context)(void* context) = nullptr;
  int (*pop_context)(void** context) = nullptr;
  int (*wait_event)(void* stream, void* event, unsigned flags) = nullptr;

  /// Whether all of it is there.
  bool load() {
    void* library = dlopen("libcuda.so.1", RTLD_NOW);
    const auto find = [library](auto& function, const char* name) {
      function =
          library == nullptr ? nullptr : reinterpret_cast<std::decay_t<decltype(function)>>(dlsym(library, name));
      return function != nullptr;
    };
    return find(device_get, "cuDeviceGet") && find(retain_context, "cuDevicePrimaryCtxRetain") &&
           find(release_context, "cuDevicePrimaryCtxRelease_v2") && find(push_context, "cuCtxPushCurrent_v2") &&
           find(pop_context, "cuCtxPopCurrent_v2") && find(wait_event, "cuStreamWaitEvent");
  }

  /// 0, or CUDA's error. The event is of the device's primary context, which need not be this thread's.
  int wait(void* stream, void* event, int ordinal) const {
    int device = 0;
    void* context = nullptr;
    int error = device_get(&device, ordinal);
    if (error == 0) error = retain_context(&context, device);
    if (error != 0) return error;
    error = push_context(context);
    if (error == 0) {
      error = wait_event(stream, event, 0);
      pop_context(&context);
    }
    release_context(device);
    return error;
  }
};

}  // namespace

void order_behind(void* event, std::int32_t device_id, std::intptr_t stream) {
  Driver driver;
  if (!driver.load())
    throw py::buffer_error("the rows are on a GPU, and libcuda.so.1 cannot be loaded to wait for them");
  if (const int error = driver.wait(reinterpret_cast<void*>(stream), event, device_id); error != 0)
    throw py::buffer_error("waiting for the rows on stream " + std::to_string(stream) + " failed: CUDA error " +
                           std::to_string(error));
}

}  // namespace plumb::python
