#include "exec/cuda/executor.cuh"

#include <string>

namespace plumb::impulse {

std::string Executor::unmet_requirement() {
  int devices = 0;
  const cudaError_t status = cudaGetDeviceCount(&devices);
  if (status != cudaSuccess)
    return std::string("impulse-cuda finds no CUDA device (") + cudaGetErrorString(status) +
           "); install NVIDIA's driver 580 or newer, or use impulse, the same engine on the CPU";
  int cooperative = 0;
  (void)cudaDeviceGetAttribute(&cooperative, cudaDevAttrCooperativeLaunch, 0);
  if (cooperative == 0) return "impulse-cuda needs a device with cooperative launches; use impulse instead";
  return {};
}

const char* Executor::device_name() {
  static const std::string name = [] {
    cudaDeviceProp properties{};
    return cudaGetDeviceProperties(&properties, 0) == cudaSuccess ? std::string(properties.name) : std::string("gpu");
  }();
  return name.c_str();
}

Executor::Executor(const PlumbHost* /*host*/, std::uint32_t /*threads*/) {
  int device = 0, multiprocessors = 0;
  check_cuda(cudaGetDevice(&device), "there is no CUDA device");
  check_cuda(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, device), "cannot ask the device");
  multiprocessors_ = static_cast<std::uint32_t>(multiprocessors);
  check_cuda(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "cannot make a stream");
  void* barrier = memory::allocate(sizeof(TeamBarrier));
  memory::fill(barrier, 0, sizeof(TeamBarrier));
  barrier_ = static_cast<TeamBarrier*>(barrier);
}

Executor::~Executor() {
  (void)cudaStreamSynchronize(stream_);
  memory::release(barrier_);
  (void)cudaStreamDestroy(stream_);
}

}  // namespace plumb::impulse
