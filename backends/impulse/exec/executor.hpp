// Where the engine's kernels run: on threads of the CPU or on a CUDA device, chosen when the library is built.
//
// A kernel is a plain function object f(i) over views of arrays; an Executor calls it for every i < n, in any order.
// Both executors have the same members, so that the engine is written once:
//
//   run(n, f)           f(i) for every i < n, all done before what is enqueued next
//   run(Count, f)       the same, for a number of things that the device counted itself
//   team(load, least, f)   f(team) with a team of threads that goes through several loops. load is the length of the
//                       longest loop, which may be unknown to the host; it is at least `least`. Members of team:
//     each(n, f)        f(i) for every i < n, when all that came before is done
//     each_ahead(n, load, fetch, f)   f(i, load(i)); load may run early and so must read nothing that the loop before
//                       writes. A device calls fetch(i) before that, to have what load(i) will read brought nearer
//     each_group(small, n, f)   f(team, g) for every g < n, which do not depend on each other: the first `small`
//                       each by a team of its own, of kGroupThreads (a thread of a CPU or a block of a device); those
//                       that are left one after the other by all threads
//     single(f)         f() once, as each
//     barrier()            returns when all is done: needed before reading, between loops, what a loop has written
//   Buffer<T>, Mirror<T>   memory where kernels run; the same with a twin on the host (memory.hpp)
//   to_device, to_host  copy rows of a Mirror, in order with the kernels; uploaded_bytes() counts the first kind
//   RadixSort<K>, Scan  (sort.hpp)
//   record(graph, f)    f() enqueues a fixed sequence; a device captures it the first time and replays it afterwards
//   on_host(n, f)       f(i) for every i < n on threads of the host, for a few i that take long; host_threads() is how
//                       many there are. Not enqueued: all is done when it returns
//   wait()              returns when all that was enqueued is done
//   join(batch), leave(), is_in_batch()   what is recorded from then on is taken together with what the others of the
//                       batch record, when one of them waits; a CPU takes each by itself
//   send(Signal)        the signal is given when all that was enqueued is done: what an outsider's stream can wait for
//   unmet_requirement() a sentence that says why this machine cannot run it, or ""
//   device_name()       "cpu" or the name of the GPU
//
// What a kernel writes must not depend on the order of its calls: see real.hpp for why.
#pragma once

#include <cstdint>

namespace plumb::impulse {

/// A number of things that only the device knows; kernels over it are launched for the capacity and leave early.
struct Count {
  const std::uint32_t* value;  ///< device memory
  std::uint32_t capacity;      ///< *value beyond it is an overflow, and only the first capacity things exist
};

}  // namespace plumb::impulse

#if defined(PLUMB_IMPULSE_CUDA)
#include "exec/cuda/executor.cuh"
#else
#include "exec/cpu/executor.hpp"
#endif
