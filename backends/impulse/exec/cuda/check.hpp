// Failures of the CUDA runtime as plumb::Error.
#pragma once

#include <cuda_runtime_api.h>

#include <string>

#include "plumb/physics_world.hpp"

namespace plumb::impulse {

inline void check_cuda(cudaError_t status, const char* what) {
  if (status == cudaSuccess) return;
  const std::string text = std::string(what) + ": " + cudaGetErrorString(status);
  throw Error(status == cudaErrorMemoryAllocation ? PLUMB_E_OUT_OF_MEMORY : PLUMB_E_DEVICE_LOST, text);
}

}  // namespace plumb::impulse
