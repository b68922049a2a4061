// A host with a job system of its own: plain threads, which wait for the next run.
#pragma once

#include <atomic>
#include <barrier>
#include <cstddef>
#include <thread>
#include <vector>

#include "exec/simd.hpp"
#include "plumb/plumb.h"

namespace plumb::impulse::test {

struct JobHost {
  explicit JobHost(std::uint32_t workers) : turns_(static_cast<std::ptrdiff_t>(workers) + 1) {
    host.struct_size = sizeof host;
    host.worker_count = workers;
    host.user = this;
    host.run = [](void* user, PlumbTask task, void* context, std::uint32_t count) {
      static_cast<JobHost*>(user)->run(task, context, count);
    };
    for (std::uint32_t worker = 0; worker < workers; ++worker) threads_.emplace_back([this] { work(); });
  }
  ~JobHost() {
    task_ = nullptr;
    turns_.arrive_and_wait();
    for (std::thread& thread : threads_) thread.join();
  }
  JobHost(const JobHost&) = delete;
  JobHost& operator=(const JobHost&) = delete;

  PlumbHost host{};
  std::uint64_t control_word = simd::control_word();  ///< of the floating-point unit in the workers
  std::atomic<std::uint32_t> runs = 0;

 private:
  void run(PlumbTask task, void* context, std::uint32_t count) {
    ++runs;
    task_ = task;
    context_ = context;
    count_ = count;
    next_ = 0;
    turns_.arrive_and_wait();  // all begin
    turns_.arrive_and_wait();  // all have ended
  }
  void work() {
    for (;;) {
      turns_.arrive_and_wait();
      if (task_ == nullptr) return;
      simd::set_control_word(control_word);
      for (std::uint32_t i = next_++; i < count_; i = next_++) task_(context_, i);
      turns_.arrive_and_wait();
    }
  }

  std::barrier<> turns_;  // of all workers and who runs them
  PlumbTask task_ = nullptr;
  void* context_ = nullptr;
  std::uint32_t count_ = 0;
  std::atomic<std::uint32_t> next_ = 0;
  std::vector<std::thread> threads_;
};

}  // namespace plumb::impulse::test
