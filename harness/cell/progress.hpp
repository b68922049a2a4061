// How far a worker is with its cell and whose time it takes, in memory shared with its parent: storing a number costs a
// step nothing, and after a crash or a hang the parent can say in which step it was.
#pragma once

#include <atomic>
#include <cstdint>

#include "simulation/cell_clock.hpp"

namespace plumb::harness {

struct Progress {
  std::atomic<std::uint64_t> step{0};   ///< that is being done, from 1; 0: not stepping yet
  std::atomic<std::uint64_t> total{0};  ///< of the simulation that steps
  CellClock clock;
};
static_assert(std::atomic<std::uint64_t>::is_always_lock_free);

/// Descriptors that a worker is born with.
enum WorkerDescriptor : int { worker_requests = 3, worker_answers = 4, worker_progress = 5 };

}  // namespace plumb::harness
