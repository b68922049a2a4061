#include "exec/cuda/executor.cuh"

namespace plumb::impulse {

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
