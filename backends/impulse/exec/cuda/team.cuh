// A team: the threads of one cooperative launch, which go through several loops together. Fewer blocks than were
// launched take part when there is little to do. Threads meet before a loop, not behind it, so that what a loop needs
// and nobody changes can be on its way while they wait; and loops that one block can do alone are left to the first
// one, whose threads need no barrier in memory. A block can also be a team by itself.
#pragma once

#include <cuda/atomic>

#include <cstdint>

#include "exec/cuda/team_threads.hpp"

namespace plumb::impulse {

struct TeamBarrier {
  std::uint32_t arrived;
};

class Team {
 public:
  __device__ Team(std::uint32_t blocks, TeamBarrier* barrier) : Team(blocks, blockIdx.x, barrier) {}
  /// The block by itself, wherever it is in the launch and however many threads it has.
  __device__ static Team of_one_block() { return {1, 0, nullptr}; }

  template <class F>
  __device__ void each(std::uint32_t n, const F& f) {
    if (n == 0) return;
    if (!join(n)) return;
    for (std::uint32_t i = index_; i < n; i += stride_of(n)) f(i);
  }
  template <class Load, class Fetch, class F>
  __device__ void each_ahead(std::uint32_t n, const Load& load, const Fetch& fetch, const F& f) {
    if (n == 0) return;
    decltype(load(0U)) loaded;
    if (index_ < n) loaded = load(index_);
    if (!join(n)) return;
    for (std::uint32_t i = index_; i < n;) {
      const std::uint32_t next = i + stride_of(n);
      if (next < n) fetch(next);
      f(i, loaded);
      i = next;
      if (i < n) loaded = load(i);
    }
  }
  /// One call of f in the code: what it does is long.
  template <class F>
  __device__ void each_group(std::uint32_t small, std::uint32_t n, const F& f) {
    std::uint32_t g = 0;
    if (small != 0) g = join(small == 1 ? 1 : ~0U) ? min(block_, small) : small;
    while (g < n) {
      const bool is_small = g < small;
      Team team = is_small ? of_one_block() : *this;
      f(team, g);
      if (!is_small) *this = team;
      g = is_small ? min(g + blocks_, small) : g + 1;
    }
  }
  template <class F>
  __device__ void single(const F& f) {
    if (join(1) && index_ == 0) f();
  }
  __device__ void barrier() {
    if (last_ == Work::kNothing) return;
    wait_for_all();
    last_ = Work::kNothing;
  }

 private:
  __device__ Team(std::uint32_t blocks, std::uint32_t block, TeamBarrier* barrier)
      : blocks_(blocks), block_(block), barrier_(barrier), index_(block * blockDim.x + threadIdx.x) {}

  enum class Work { kNothing, kFirstBlock, kAll };  // that was done since threads met

  __device__ std::uint32_t stride_of(std::uint32_t n) const { return is_small(n) ? blockDim.x : blocks_ * blockDim.x; }
  __device__ bool is_small(std::uint32_t n) const { return blocks_ == 1 || n <= blockDim.x; }

  /// Meets as far as a loop over n things asks for. Returns whether this block takes part in it.
  __device__ bool join(std::uint32_t n) {
    const bool small = is_small(n);
    if (small && last_ == Work::kFirstBlock) {
      if (block_ == 0) __syncthreads();
    } else if (last_ != Work::kNothing) {
      wait_for_all();
    }
    last_ = small ? Work::kFirstBlock : Work::kAll;
    return !small || block_ == 0;
  }

  __device__ void wait_for_all() {
    __syncthreads();
    if (blocks_ == 1) return;
    if (threadIdx.x == 0) {
      // All blocks together add 2^31, so that the highest bit tells one meeting from the next.
      constexpr std::uint32_t kTurn = 1U << 31;
      cuda::atomic_ref<std::uint32_t, cuda::thread_scope_device> arrived(barrier_->arrived);
      const std::uint32_t before =
          arrived.fetch_add(block_ == 0 ? kTurn - (blocks_ - 1) : 1U, cuda::memory_order_release);
      while (((arrived.load(cuda::memory_order_acquire) ^ before) & kTurn) == 0) {
      }
    }
    __syncthreads();
  }

  std::uint32_t blocks_, block_;
  TeamBarrier* barrier_;
  std::uint32_t index_;
  Work last_ = Work::kNothing;
};

}  // namespace plumb::impulse
