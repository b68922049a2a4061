// A team: the threads of one cooperative launch, which go through several loops together and meet at a barrier after
// each. Fewer blocks than were launched take part when there is little to do, and one block needs no barrier in memory.
#pragma once

#include <cooperative_groups.h>

#include <cstdint>

namespace plumb::impulse {

struct TeamBarrier {
  std::uint32_t arrived;
  std::uint32_t generation;
};

constexpr std::uint32_t kTeamThreads = 128;  // a block; few, so that a small loop still spreads over the device

class Team {
 public:
  __device__ Team(std::uint32_t blocks, TeamBarrier* barrier)
      : blocks_(blocks), barrier_(barrier), index_(blockIdx.x * blockDim.x + threadIdx.x) {}

  template <class F>
  __device__ void each(std::uint32_t n, const F& f) {
    const std::uint32_t stride = blocks_ * kTeamThreads;
    for (std::uint32_t i = index_; i < n; i += stride) f(i);
    meet();
  }
  template <class F>
  __device__ void single(const F& f) {
    if (index_ == 0) f();
    meet();
  }

 private:
  __device__ void meet() {
    __syncthreads();
    if (blocks_ == 1) return;
    if (threadIdx.x == 0) {
      volatile std::uint32_t* generation = &barrier_->generation;
      const std::uint32_t mine = *generation;
      __threadfence();
      if (atomicAdd(&barrier_->arrived, 1U) == blocks_ - 1) {
        barrier_->arrived = 0;
        __threadfence();
        *generation = mine + 1;
      } else {
        while (*generation == mine) {
        }
      }
      __threadfence();
    }
    __syncthreads();
  }

  std::uint32_t blocks_;
  TeamBarrier* barrier_;
  std::uint32_t index_;
};

}  // namespace plumb::impulse
