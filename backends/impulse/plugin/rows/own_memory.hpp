// Which memory a host wants rows in.
#pragma once

#include <string>

#include "exec/executor.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::impulse {

/// Whether the request is for the memory in which the engine works; the other one is the host's twin of it. Throws
/// Error where it is for neither, or the twin was not allowed.
inline bool asks_for_own_memory(const PlumbStateRequest& request) {
  constexpr std::int32_t kHost = 1;
  if (request.device_type == Executor::device_type()) return true;
  const std::string place = Executor::device_type() == kHost ? "the host" : "the device";
  const std::string type = std::to_string(Executor::device_type());
  const std::string here = PLUMB_IMPULSE_NAME " keeps its state on " + place + "; ask for device_type " + type;
  if (request.device_type != kHost)
    throw Error(PLUMB_E_UNSUPPORTED, here + " instead of " + std::to_string(request.device_type));
  if (request.allow_copy == 0) throw Error(PLUMB_E_UNSUPPORTED, here + ", or set allow_copy");
  return false;
}

}  // namespace plumb::impulse
