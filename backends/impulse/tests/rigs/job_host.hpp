// A host with a job system of its own: plain threads, made anew for each run.
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include "exec/simd.hpp"
#include "plumb/plumb.h"

namespace plumb::impulse::test {

struct JobHost {
  explicit JobHost(std::uint32_t workers) {
    host.struct_size = sizeof host;
    host.worker_count = workers;
    host.user = this;
    host.run = [](void* user, PlumbTask task, void* context, std::uint32_t count) {
      static_cast<JobHost*>(user)->run(task, context, count);
    };
  }

  PlumbHost host{};
  std::uint64_t control_word = simd::control_word();  ///< of the floating-point unit in the workers
  std::atomic<std::uint32_t> runs = 0;

 private:
  void run(PlumbTask task, void* context, std::uint32_t count) {
    ++runs;
    std::atomic<std::uint32_t> next = 0;
    std::vector<std::thread> threads;
    for (std::uint32_t worker = 0; worker < host.worker_count; ++worker)
      threads.emplace_back([&] {
        simd::set_control_word(control_word);
        for (std::uint32_t i = next++; i < count; i = next++) task(context, i);
      });
    for (std::thread& thread : threads) thread.join();
  }
};

}  // namespace plumb::impulse::test
