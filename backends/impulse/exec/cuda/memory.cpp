// Memory of the CUDA library: the device's own, and page-locked on the host.
#include "exec/memory.hpp"

#include "exec/cuda/check.hpp"

namespace plumb::impulse::memory {

void* allocate(std::size_t bytes) {
  void* data = nullptr;
  const std::scoped_lock no_recording(recording_mutex());
  check_cuda(cudaMalloc(&data, bytes), "cannot allocate device memory");
  return data;
}
void release(void* data) noexcept {
  const std::scoped_lock no_recording(recording_mutex());  // freeing waits for the device
  (void)cudaFree(data);
}
void* allocate_host(std::size_t bytes) {
  void* data = nullptr;
  const std::scoped_lock no_recording(recording_mutex());
  check_cuda(cudaMallocHost(&data, bytes), "cannot allocate page-locked memory");
  return data;
}
void release_host(void* data) noexcept {
  const std::scoped_lock no_recording(recording_mutex());
  (void)cudaFreeHost(data);
}

// The executor's stream does not wait for these of itself, hence the synchronisation on both sides.
void fill(void* data, int byte, std::size_t bytes) {
  const std::scoped_lock no_recording(recording_mutex());
  check_cuda(cudaMemset(data, byte, bytes), "cannot fill device memory");
  check_cuda(cudaDeviceSynchronize(), "cannot fill device memory");
}
void copy_between(void* to, const void* from, std::size_t bytes) {
  const std::scoped_lock no_recording(recording_mutex());
  check_cuda(cudaDeviceSynchronize(), "a kernel failed");
  check_cuda(cudaMemcpy(to, from, bytes, cudaMemcpyDeviceToDevice), "cannot copy device memory");
  check_cuda(cudaDeviceSynchronize(), "cannot copy device memory");
}
void upload(void* to, const void* from_host, std::size_t bytes) {
  const std::scoped_lock no_recording(recording_mutex());
  check_cuda(cudaDeviceSynchronize(), "a kernel failed");
  check_cuda(cudaMemcpy(to, from_host, bytes, cudaMemcpyHostToDevice), "cannot copy to the device");
  // From memory that is not page-locked the call returns when the bytes are on their way, and not when they are there.
  check_cuda(cudaDeviceSynchronize(), "cannot copy to the device");
}
void download(void* to_host, const void* from, std::size_t bytes) {
  const std::scoped_lock no_recording(recording_mutex());
  check_cuda(cudaDeviceSynchronize(), "a kernel failed");
  check_cuda(cudaMemcpy(to_host, from, bytes, cudaMemcpyDeviceToHost), "cannot copy from the device");
}

}  // namespace plumb::impulse::memory
