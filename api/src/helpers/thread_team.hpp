// Threads that wait for tasks and share them. Each has the same ones every time, as far as it gets to them before the
// others: what a task works with is in its processor's caches, and its memory from its own arena.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace plumb::helpers {

class ThreadTeam {
 public:
  /// threads: the caller's included, >= 1.
  explicit ThreadTeam(std::uint32_t threads);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  [[nodiscard]] std::uint32_t threads() const { return static_cast<std::uint32_t>(others_.size()) + 1; }
  /// f(i) for every i < n, each once; returns when all are done, and throws what the smallest i that failed threw.
  void each(std::size_t n, const std::function<void(std::size_t)>& f);

 private:
  /// Tasks of one thread, which others help with when they are done with their own.
  struct alignas(64) Share {
    std::atomic<std::size_t> next{0};
    std::size_t end = 0;
  };
  void wait_for_tasks(std::size_t thread);
  void work(std::size_t thread);
  void run(std::size_t task);

  std::mutex mutex_;
  std::condition_variable begins_, ends_;
  std::uint64_t round_ = 0;  // of tasks
  std::size_t at_work_ = 0;  // others that have not come to the end of this round
  bool over_ = false;
  const std::function<void(std::size_t)>* task_ = nullptr;
  std::vector<Share> shares_;  // by thread; the caller's first
  std::exception_ptr failure_;
  std::size_t failed_ = 0;
  std::vector<std::jthread> others_;  // last: they see all above
};

}  // namespace plumb::helpers
