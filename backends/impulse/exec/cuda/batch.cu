#include "exec/cuda/batch.hpp"

#include <algorithm>

#include "exec/cuda/executor.cuh"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

template <class Word>
__device__ void copy_words(const Transfer& transfer) {
  auto* to = static_cast<Word*>(transfer.to);
  const auto* from = static_cast<const Word*>(transfer.from);
  for (std::size_t i = threadIdx.x; i < transfer.bytes / sizeof(Word); i += blockDim.x) to[i] = from[i];
}
__device__ void copy_by_block(const Transfer& transfer) {
  const auto places =
      reinterpret_cast<std::uintptr_t>(transfer.to) | reinterpret_cast<std::uintptr_t>(transfer.from) | transfer.bytes;
  if (places % sizeof(uint4) == 0)
    copy_words<uint4>(transfer);
  else if (places % sizeof(std::uint32_t) == 0)
    copy_words<std::uint32_t>(transfer);
  else
    copy_words<unsigned char>(transfer);
}

__global__ void __launch_bounds__(kTeamThreads) transfer_all(const Transfer* transfers) {
  copy_by_block(transfers[blockIdx.x]);
}
__global__ void __launch_bounds__(kTeamThreads) transfer_of_world(const std::byte* const* blocks, std::size_t offset) {
  copy_by_block(reinterpret_cast<const ListedTransfer*>(blocks[blockIdx.x] + offset)->transfer);
}

}  // namespace

void launch_transfer(const ManyWorlds& worlds, std::size_t offset) {
  transfer_of_world<<<worlds.count, worlds.threads, 0, worlds.stream>>>(worlds.blocks, offset);
}

Batch::Batch() {
  int device = 0, multiprocessors = 0;
  check_cuda(cudaGetDevice(&device), "there is no CUDA device");
  check_cuda(cudaDeviceGetAttribute(&multiprocessors, cudaDevAttrMultiProcessorCount, device), "cannot ask the device");
  multiprocessors_ = static_cast<std::uint32_t>(multiprocessors);
  check_cuda(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "cannot make a stream");
}

Batch::~Batch() {
  (void)cudaStreamSynchronize(stream_);
  (void)cudaStreamDestroy(stream_);
}

void Batch::add(const LaunchList& list, std::span<const Transfer> uploads) {
  const std::scoped_lock lock(mutex_);
  is_idle_ = false;
  auto group = std::find_if(groups_.begin(), groups_.end(),
                            [&](const Group& other) { return other.signature == list.signature(); });
  if (group == groups_.end()) group = groups_.insert(group, {list.signature(), list.launches(), {}});
  PLUMB_ASSERT(group->launches == list.launches());
  group->blocks.push_back(list.arguments());
  uploads_.insert(uploads_.end(), uploads.begin(), uploads.end());
}

void Batch::launch() {
  const std::scoped_lock lock(mutex_);
  launch_added();
}

void Batch::enqueued() {
  const std::scoped_lock lock(mutex_);
  is_idle_ = false;
  busy_ = true;
}

void Batch::wait() {
  if (is_idle_) return;
  const std::scoped_lock lock(mutex_);
  launch_added();
  if (busy_) check_cuda(cudaStreamSynchronize(stream_), "a kernel failed");
  busy_ = false;
  is_idle_ = true;
}

void Batch::launch_added() {
  std::size_t worlds = 0;
  for (const Group& group : groups_) worlds += group.blocks.size();
  if (worlds == 0) return;
  // The tables below may still be on their way from the last time.
  if (busy_) check_cuda(cudaStreamSynchronize(stream_), "a kernel failed");
  busy_ = true;
  transfers_.grow(uploads_.size());
  blocks_.grow(worlds);
  std::copy(uploads_.begin(), uploads_.end(), transfers_.host());
  std::size_t first = 0;
  for (const Group& group : groups_) {
    std::copy(group.blocks.begin(), group.blocks.end(), blocks_.host() + first);
    first += group.blocks.size();
  }
  const auto upload = [&](auto& mirror, std::size_t count) {
    check_cuda(cudaMemcpyAsync(mirror.device(), mirror.host(), mirror.bytes(count), cudaMemcpyHostToDevice, stream_),
               "cannot copy");
  };
  upload(blocks_, worlds);
  if (!uploads_.empty()) {
    upload(transfers_, uploads_.size());
    transfer_all<<<static_cast<unsigned>(uploads_.size()), kTeamThreads, 0, stream_>>>(transfers_.device());
    check_cuda(cudaGetLastError(), "cannot launch a kernel");
    uploads_.clear();
  }
  first = 0;
  for (Group& group : groups_) {
    launch_group(group, first);
    first += group.blocks.size();
    group.blocks.clear();
  }
}

void Batch::launch_group(const Group& group, std::size_t first) {
  if (group.blocks.empty()) return;
  const auto count = static_cast<std::uint32_t>(group.blocks.size());
  const std::uint32_t threads = count <= 2 * multiprocessors_ ? kTeamThreads : kThreadsOfOneOfMany;
  const ManyWorlds worlds = {blocks_.device() + first, count, threads, stream_};
  for (const ListedLaunch& launch : group.launches) launch.launch(worlds, launch.offset);
  check_cuda(cudaGetLastError(), "cannot launch a kernel");
}

}  // namespace plumb::impulse
