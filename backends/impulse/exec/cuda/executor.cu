#include "exec/cuda/executor.cuh"

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

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

/// On the host, where only rows that are read keep more than one busy.
std::uint32_t Executor::max_threads() { return std::max(1U, std::thread::hardware_concurrency()); }

Executor::Executor(const PlumbHost* host, std::uint32_t threads)
    : host_(host != nullptr && host->run != nullptr && host->worker_count > 0 ? host : nullptr),
      host_threads_(std::clamp(threads, 1U, host_ != nullptr ? host_->worker_count : max_threads())) {
  int device = 0, multiprocessors = 0;
  check_cuda(cudaGetDevice(&device), "there is no CUDA device");
  check_cuda(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, device), "cannot ask the device");
  multiprocessors_ = static_cast<std::uint32_t>(multiprocessors);
  check_cuda(cudaStreamCreateWithFlags(&own_stream_, cudaStreamNonBlocking), "cannot make a stream");
  stream_ = own_stream_;
  void* barrier = memory::allocate(sizeof(TeamBarrier));
  memory::fill(barrier, 0, sizeof(TeamBarrier));
  barrier_ = static_cast<TeamBarrier*>(barrier);
}

Executor::~Executor() {
  (void)cudaStreamSynchronize(stream_);
  memory::release(barrier_);
  (void)cudaStreamDestroy(own_stream_);
}

void Executor::join(std::shared_ptr<Batch> batch) {
  wait();
  batch_ = std::move(batch);
  stream_ = batch_ != nullptr ? batch_->stream() : own_stream_;
}

void Executor::leave() noexcept {
  try {
    if (is_in_batch()) join(nullptr);
  } catch (const Error&) {  // the device is lost
    batch_ = nullptr;
    stream_ = own_stream_;
  }
}

void Executor::enqueue_past_batch() {
  batch_->launch();
  for (const Transfer& upload : uploads_) copy(upload, cudaMemcpyHostToDevice);
  uploads_.clear();
  batch_->enqueued();
}

void Executor::wait() {
  if (!is_in_batch()) return check_cuda(cudaStreamSynchronize(stream_), "a kernel failed");
  if (!uploads_.empty()) enqueue_past_batch();
  batch_->wait();
}

/// A thread a task, which lasts longer than it takes to start one.
void Executor::run_on_host(std::uint32_t n, void* context, PlumbTask task) const {
  if (host_ != nullptr) return host_->run(host_->user, task, context, n);
  std::vector<std::jthread> others;
  for (std::uint32_t i = 1; i < n; ++i) others.emplace_back(task, context, i);
  task(context, 0);
}

}  // namespace plumb::impulse
