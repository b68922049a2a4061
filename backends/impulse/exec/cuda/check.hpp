// Failures of the CUDA runtime as plumb::Error.
#pragma once

#include <cuda_runtime_api.h>

#include <mutex>
#include <string>

#include "plumb/physics_world.hpp"

namespace plumb::impulse {

inline void check_cuda(cudaError_t status, const char* what) {
  if (status == cudaSuccess) return;
  const std::string text = std::string(what) + ": " + cudaGetErrorString(status);
  throw Error(status == cudaErrorMemoryAllocation ? PLUMB_E_OUT_OF_MEMORY : PLUMB_E_DEVICE_LOST, text);
}

/// Held by a thread while it records a graph, and by those that wait for the device: to wait for a device on which
/// another thread records is an error of both (CUDA C++ Programming Guide, "Prohibited and Unhandled Operations").
inline std::mutex& recording_mutex() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace plumb::impulse
