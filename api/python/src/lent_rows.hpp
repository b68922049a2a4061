// State rows that an engine lends: whoever looks at them, in Python or by DLPack, keeps them alive.
#pragma once

#include <memory>

#include "core.hpp"

namespace plumb::python {

/// Calls the tensor's deleter when the last look is over: in any thread, also after the world is gone.
using Lent = std::shared_ptr<PlumbDLManagedTensor>;

struct LentRows {
  /// Takes the tensor over. Throws Error where it has neither float32 nor float64.
  LentRows(PlumbDLManagedTensor* lent, const PlumbFence& readable);

  Lent tensor;
  PlumbFence fence;

  /// A view, which keeps self alive.
  static py::array view(const py::object& self);
  /// A capsule of which a consumer takes the tensor (dmlc/dlpack's Python protocol).
  [[nodiscard]] py::capsule capsule(bool versioned) const;
};

/// Lets what a stream does from now on happen after the event. stream: as DLPack counts them (1 legacy, 2 per thread,
/// else a cudaStream_t). Throws BufferError with CUDA's reason.
void order_behind(void* event, std::int32_t device_id, std::intptr_t stream);

}  // namespace plumb::python
