// The executor of the CUDA library: kernels are enqueued on one stream; a recorded sequence is one graph launch, or a
// part of a batch with those of other worlds.
#pragma once

#include <cuda_runtime.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "exec/cuda/batch.hpp"
#include "exec/cuda/check.hpp"
#include "exec/cuda/launch_list.cuh"
#include "exec/cuda/team_threads.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#if defined(__CUDACC__)
#include "exec/cuda/team.cuh"
#endif
#include "plumb/assert.hpp"
#include "plumb/plumb.h"

namespace plumb::impulse {

struct TeamBarrier;
#if !defined(__CUDACC__)
/// For files without kernels, which may include what works with a team; none is ever made there.
class Team {
 public:
  Team() = delete;
  template <class F>
  void each(std::uint32_t /*n*/, const F& /*f*/) {}
  template <class Load, class Fetch, class F>
  void each_ahead(std::uint32_t /*n*/, const Load& /*load*/, const Fetch& /*fetch*/, const F& /*f*/) {}
  template <class F>
  void each_group(std::uint32_t /*small*/, std::uint32_t /*n*/, const F& /*f*/) {}
  template <class F>
  void single(const F& /*f*/) {}
  void barrier() {}
};
#endif

/// A captured graph, or in a batch a list of launches. Must be forgotten when a buffer that it uses was grown.
class Recording {
 public:
  Recording() = default;
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;
  ~Recording() { forget(); }
  void forget() {
    if (graph_ != nullptr) (void)cudaGraphExecDestroy(graph_);
    graph_ = nullptr;
    list_.clear();
  }

 private:
  friend class Executor;
  cudaGraphExec_t graph_ = nullptr;
  LaunchList list_;
};

/// An event that another stream can wait for. May outlive the executor.
class Signal {
 public:
  Signal() { check_cuda(cudaEventCreateWithFlags(&event_, cudaEventDisableTiming), "cannot make an event"); }
  Signal(const Signal&) = delete;
  Signal& operator=(const Signal&) = delete;
  ~Signal() { (void)cudaEventDestroy(event_); }
  [[nodiscard]] cudaEvent_t handle() const { return event_; }

 private:
  cudaEvent_t event_ = nullptr;
};

#if defined(__CUDACC__)
template <class F>
__global__ void run_kernel(const __grid_constant__ F f, std::uint32_t n) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < n) f(i);
}
template <class F>
__global__ void run_counted_kernel(const __grid_constant__ F f, Count n) {
  const std::uint32_t i = blockIdx.x * blockDim.x + threadIdx.x;
  if (i < n.capacity && i < *n.value) f(i);
}
template <class F>
__global__ void __launch_bounds__(kTeamThreads)
    team_kernel(const __grid_constant__ F f, TeamBarrier* barrier, Count load, std::uint32_t least) {
  const std::uint32_t counted = *load.value < load.capacity ? *load.value : load.capacity;
  const std::uint32_t work = counted < least ? least : counted;
  const std::uint32_t wanted = (work + kTeamThreads - 1) / kTeamThreads;
  const std::uint32_t blocks = wanted < 1 ? 1 : wanted < gridDim.x ? wanted : gridDim.x;
  if (blockIdx.x >= blocks) return;
  Team team(blocks, barrier);
  f(team);
}
#endif

class Executor {
 public:
  static constexpr bool kWarps = true;  // whether neighbouring threads must do the same to be fast
  static constexpr std::uint32_t kGroupThreads = kTeamThreads;  // of the team of a small group

  Executor(const PlumbHost* host, std::uint32_t threads);
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;
  ~Executor();

  /// Whether a step is recorded, with the numbers that it had.
  static constexpr bool records() { return true; }
  static std::string unmet_requirement();
  static const char* device_name();
  static std::uint32_t max_threads();

  [[nodiscard]] std::uint32_t threads() const { return 1; }
  /// For what is enqueued by others.
  [[nodiscard]] cudaStream_t stream() {
    begin_enqueuing();
    return stream_;
  }

  /// From now on recorded sequences are the batch's, which others share; null: by themselves again. Nothing is under
  /// way.
  void join(std::shared_ptr<Batch> batch);
  /// The same with null, where something may be under way and may fail.
  void leave() noexcept;
  [[nodiscard]] bool is_in_batch() const { return batch_ != nullptr; }
  /// Whether what is enqueued now becomes a part of a batch, and is launched with a block for each world.
  [[nodiscard]] bool lists() const { return list_ != nullptr; }

#if defined(__CUDACC__)
  /// f() by all threads of a world's block; only where it lists.
  template <class F>
  void list_block(const F& f) {
    list_->add(&listed::launch_block<F>, listed::Whole<F>{f});
  }
  template <class F>
  void run(std::uint32_t n, const F& f) {
    if (n == 0) return;
    if (lists()) return list_->add(&listed::launch_run<F>, listed::Loop<F>{f, nullptr, n});
    begin_enqueuing();
    run_kernel<<<(n + kBlock - 1) / kBlock, kBlock, 0, stream_>>>(f, n);
    check_cuda(cudaGetLastError(), "cannot launch a kernel");
  }
  template <class F>
  void run(Count n, const F& f) {
    if (n.capacity == 0) return;
    if (lists()) return list_->add(&listed::launch_run<F>, listed::Loop<F>{f, n.value, n.capacity});
    begin_enqueuing();
    run_counted_kernel<<<(n.capacity + kBlock - 1) / kBlock, kBlock, 0, stream_>>>(f, n);
    check_cuda(cudaGetLastError(), "cannot launch a kernel");
  }
  /// load and least: length of the longest loop, so that short ones get few blocks.
  template <class F>
  void team(Count load, std::uint32_t least, const F& f) {
    if (lists()) return list_->add(&listed::launch_team<F>, listed::Whole<F>{f});
    begin_enqueuing();
    int blocks = 0;
    check_cuda(cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, team_kernel<F>, kTeamThreads, 0),
               "cannot size a team");
    const std::uint32_t most = static_cast<std::uint32_t>(blocks) * multiprocessors_;
    const std::uint32_t longest = load.capacity < least ? least : load.capacity;
    const std::uint32_t wanted = (longest + kTeamThreads - 1) / kTeamThreads;
    F copy = f;
    void* arguments[] = {&copy, &barrier_, &load, &least};
    check_cuda(cudaLaunchCooperativeKernel(team_kernel<F>,
                                           wanted < 1      ? 1
                                           : wanted < most ? wanted
                                                           : most,
                                           kTeamThreads, arguments, 0, stream_),
               "cannot launch a team");
  }
  template <class F>
  void record(Recording& recording, const F& f) {
    if (is_in_batch()) return add_to_batch(recording.list_, f);
    if (recording.graph_ == nullptr) {
      const std::scoped_lock alone(recording_mutex());
      check_cuda(cudaStreamBeginCapture(stream_, cudaStreamCaptureModeThreadLocal), "cannot begin a recording");
      cudaGraph_t graph = nullptr;
      try {
        f();
      } catch (...) {
        (void)cudaStreamEndCapture(stream_, &graph);
        if (graph != nullptr) (void)cudaGraphDestroy(graph);
        throw;
      }
      check_cuda(cudaStreamEndCapture(stream_, &graph), "cannot end a recording");
      const cudaError_t made = cudaGraphInstantiate(&recording.graph_, graph, 0);
      (void)cudaGraphDestroy(graph);
      check_cuda(made, "cannot make a graph");
    }
    check_cuda(cudaGraphLaunch(recording.graph_, stream_), "cannot launch a graph");
  }
#endif
  [[nodiscard]] std::uint32_t host_threads() const { return host_threads_; }
  template <class F>
  void on_host(std::uint32_t n, const F& f) {
    const F* task = &f;
    run_on_host(n, &task, [](void* context, std::uint32_t i) { (**static_cast<const F**>(context))(i); });
  }
  /// Enqueued, in order with the kernels; done after wait().
  template <class T>
  void to_device(Mirror<T>& mirror, std::size_t count, std::size_t first = 0) {
    PLUMB_ASSERT(first + count <= mirror.size());
    const Transfer transfer = {mirror.device() + first, mirror.host() + first, count * sizeof(T)};
    uploaded_bytes_ += transfer.bytes;
    if (transfer.bytes == 0) return;
    if (is_in_batch())
      uploads_.push_back(transfer);  // goes with what is recorded next
    else
      copy(transfer, cudaMemcpyHostToDevice);
  }
  template <class T>
  void to_host(Mirror<T>& mirror, std::size_t count) {
    PLUMB_ASSERT(count <= mirror.size());
    const Transfer transfer = {mirror.host(), mirror.device(), count * sizeof(T)};
    if (transfer.bytes == 0) return;
    if (lists()) return list_->add(&launch_transfer, ListedTransfer{transfer});
    begin_enqueuing();
    copy(transfer, cudaMemcpyDeviceToHost);
  }
  [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }
  void wait();
  void send(Signal& signal) {
    begin_enqueuing();
    check_cuda(cudaEventRecord(signal.handle(), stream_), "cannot record an event");
  }
  [[nodiscard]] void* stream_handle() const { return stream_; }
  [[nodiscard]] static std::int32_t device_type() { return 2; }  // of DLPack
  [[nodiscard]] static std::int32_t device_id() {
    int device = 0;
    check_cuda(cudaGetDevice(&device), "there is no CUDA device");
    return device;
  }

 private:
  static constexpr std::uint32_t kBlock = 128;

  void run_on_host(std::uint32_t n, void* context, PlumbTask task) const;
  void copy(const Transfer& transfer, cudaMemcpyKind kind) {
    check_cuda(cudaMemcpyAsync(transfer.to, transfer.from, transfer.bytes, kind, stream_), "cannot copy");
  }
  /// In a batch: before something is enqueued past it what was said before is.
  void begin_enqueuing() {
    if (is_in_batch() && !lists()) enqueue_past_batch();
  }
  void enqueue_past_batch();
  template <class F>
  void add_to_batch(LaunchList& list, const F& f) {
    if (list.empty()) {
      list_ = &list;
      try {
        f();
      } catch (...) {
        list_ = nullptr;
        list.clear();
        throw;
      }
      list_ = nullptr;
      list.finish();
    }
    batch_->add(list, uploads_);
    uploads_.clear();
  }

  cudaStream_t own_stream_ = nullptr, stream_ = nullptr;  // the second is the first, or the batch's
  std::shared_ptr<Batch> batch_;                          // null where it is by itself
  LaunchList* list_ = nullptr;                            // that is being recorded
  std::vector<Transfer> uploads_;                         // that the batch does not know of
  std::uint32_t multiprocessors_ = 1;
  TeamBarrier* barrier_ = nullptr;  // on the device
  std::uint64_t uploaded_bytes_ = 0;
  const PlumbHost* host_;  // null where it lends no job system
  std::uint32_t host_threads_;
};

}  // namespace plumb::impulse
