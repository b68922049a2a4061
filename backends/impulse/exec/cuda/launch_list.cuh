// A sequence of kernels that is launched for many worlds at once (batch.hpp): what each is launched by, and its
// arguments for one world, which lie in the device's memory. Worlds whose lists are alike are launched together: a
// block a world, which goes through what the kernel has to do in that world, so that each world comes to what it comes
// to alone.
#pragma once

#include <cuda_runtime.h>

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>
#include <vector>

#include "exec/cuda/check.hpp"
#include "exec/cuda/team_threads.hpp"
#include "exec/memory.hpp"
#if defined(__CUDACC__)
#include "exec/cuda/team.cuh"
#endif

namespace plumb::impulse {

/// Where the arguments of some worlds lie; a kernel's are `offset` bytes from there.
struct ManyWorlds {
  const std::byte* const* blocks;  ///< by world; device memory
  std::uint32_t count;
  std::uint32_t threads;  ///< of the block of each, a multiple of a warp's
  cudaStream_t stream;
};

struct ListedLaunch {
  void (*launch)(const ManyWorlds& worlds, std::size_t offset);
  std::size_t offset;
  bool operator==(const ListedLaunch&) const = default;
};

/// Bytes from one place to another; one of them is the device's memory, the other may be page-locked memory of the
/// host, which a device reads and writes as its own.
struct Transfer {
  void* to;
  const void* from;
  std::size_t bytes;
};

class LaunchList {
 public:
  [[nodiscard]] bool empty() const { return launches_.empty(); }
  [[nodiscard]] const std::vector<ListedLaunch>& launches() const { return launches_; }
  /// On the device, after finish().
  [[nodiscard]] const std::byte* arguments() const { return on_device_.data(); }
  /// Likewise: a number that lists of the same launches share, and hardly any others.
  [[nodiscard]] std::uint64_t signature() const { return signature_; }

  template <class Arguments>
  void add(void (*launch)(const ManyWorlds&, std::size_t), const Arguments& arguments) {
    static_assert(std::is_trivially_copyable_v<Arguments> && sizeof(Arguments) % kAlignment == 0);
    launches_.push_back({launch, arguments_.size()});
    const auto* bytes = reinterpret_cast<const std::byte*>(&arguments);
    arguments_.insert(arguments_.end(), bytes, bytes + sizeof arguments);
  }
  void finish() {
    signature_ = 0;
    for (const ListedLaunch& launch : launches_)
      for (const std::uint64_t part : {reinterpret_cast<std::uintptr_t>(launch.launch), launch.offset})
        signature_ = (signature_ ^ part) * 0x9e3779b97f4a7c15U + (signature_ >> 29);
    on_device_.from_host(arguments_.data(), arguments_.size());
    arguments_ = {};
  }
  void clear() {
    launches_.clear();
    arguments_.clear();
  }

  static constexpr std::size_t kAlignment = 16;

 private:
  std::vector<ListedLaunch> launches_;
  std::vector<std::byte> arguments_;
  Buffer<std::byte> on_device_;
  std::uint64_t signature_ = 0;
};

#if defined(__CUDACC__)
namespace listed {

/// A kernel's argument and how many things it is for: *counted, or where that is null all of them.
template <class F>
struct alignas(LaunchList::kAlignment) Loop {
  F f;
  const std::uint32_t* counted;
  std::uint32_t most;
};
template <class F>
struct alignas(LaunchList::kAlignment) Whole {
  F f;
};

/// The arguments of the block's world, in the memory of the block: no store to the world's arrays can change them.
template <class Arguments>
__device__ const Arguments& arguments_of_block(const std::byte* const* blocks, std::size_t offset) {
  __shared__ uint4 words[sizeof(Arguments) / sizeof(uint4)];
  const auto* from = reinterpret_cast<const uint4*>(blocks[blockIdx.x] + offset);
  for (std::uint32_t i = threadIdx.x; i < sizeof(Arguments) / sizeof(uint4); i += blockDim.x) words[i] = from[i];
  __syncthreads();
  return *reinterpret_cast<const Arguments*>(words);
}

template <class F>
__global__ void __launch_bounds__(kTeamThreads) run(const std::byte* const* blocks, std::size_t offset) {
  const auto& own = arguments_of_block<Loop<F>>(blocks, offset);
  const std::uint32_t n = own.counted == nullptr || *own.counted > own.most ? own.most : *own.counted;
  for (std::uint32_t i = threadIdx.x; i < n; i += blockDim.x) own.f(i);
}
template <class F>
__global__ void __launch_bounds__(kTeamThreads) team(const std::byte* const* blocks, std::size_t offset) {
  Team team = Team::of_one_block();
  arguments_of_block<Whole<F>>(blocks, offset).f(team);
}
template <class F>
__global__ void __launch_bounds__(kTeamThreads) block(const std::byte* const* blocks, std::size_t offset) {
  arguments_of_block<Whole<F>>(blocks, offset).f();
}

template <class F>
void launch_run(const ManyWorlds& worlds, std::size_t offset) {
  run<F><<<worlds.count, worlds.threads, 0, worlds.stream>>>(worlds.blocks, offset);
}
template <class F>
void launch_team(const ManyWorlds& worlds, std::size_t offset) {
  team<F><<<worlds.count, worlds.threads, 0, worlds.stream>>>(worlds.blocks, offset);
}
template <class F>
void launch_block(const ManyWorlds& worlds, std::size_t offset) {
  block<F><<<worlds.count, worlds.threads, 0, worlds.stream>>>(worlds.blocks, offset);
}

}  // namespace listed
#endif

/// As launch_run() for a copy.
void launch_transfer(const ManyWorlds& worlds, std::size_t offset);
struct alignas(LaunchList::kAlignment) ListedTransfer {
  Transfer transfer;
};

}  // namespace plumb::impulse
