// The threads of a world: one, those of its own (arena.hpp), or the host's job system.
#pragma once

#include <cstdint>
#include <memory>

#include "plumb/plumb.h"

namespace plumb::impulse {

class Arena;

/// How long a loop's body takes: tens of nanoseconds, a microsecond, or several.
enum class LoopBody : std::uint8_t { kSmall, kLarge, kTask };

class ThreadPool {
 public:
  /// host may be null. Where it lends a job system and more than one thread is asked for, that is used.
  ThreadPool(const PlumbHost* host, std::uint32_t threads);
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;
  ~ThreadPool();

  /// Of this machine, at least one.
  static std::uint32_t processors();
  /// One that is the thread which calls it.
  static ThreadPool& one_thread();
  [[nodiscard]] std::uint32_t threads() const { return threads_; }

  /// f(i) for every i < n. Small n, or one thread: a plain loop here. body: how long f takes.
  template <class F>
  void each(std::uint32_t n, const F& f, LoopBody body = LoopBody::kSmall) {
    const std::uint32_t least = least_chunk(body);
    if (threads_ == 1 || n <= (body == LoopBody::kTask ? 1 : 4 * least)) {
      for (std::uint32_t i = 0; i < n; ++i) f(i);
      return;
    }
    struct Job {
      const F& f;
      std::uint32_t n, chunk;
    } job{f, n, chunk_of(n, least)};
    run_chunks((n + job.chunk - 1) / job.chunk, &job, [](void* context, std::uint32_t c) {
      const Job& all = *static_cast<const Job*>(context);
      const std::uint32_t end = all.n - c * all.chunk < all.chunk ? all.n : (c + 1) * all.chunk;
      for (std::uint32_t i = c * all.chunk; i < end; ++i) all.f(i);
    });
  }

  /// task(context, c) for every c < count, on all threads, each with the floating-point control word that results rely
  /// on (floating_point.hpp).
  void run_chunks(std::uint32_t count, void* context, PlumbTask task);

  /// f(), whose loops follow each other closely: from the first that is worth it on the threads stay together. What
  /// runs in them must not throw.
  template <class F>
  void together(const F& f) {
    if (arena_ == nullptr) return f();
    const F* task = &f;
    run_together(&task, [](void* context) { (**static_cast<const F**>(context))(); });
  }

 private:
  /// Calls that are worth another thread.
  static constexpr std::uint32_t least_chunk(LoopBody body) {
    return body == LoopBody::kSmall ? 16 : body == LoopBody::kLarge ? 2 : 1;
  }
  [[nodiscard]] std::uint32_t chunk_of(std::uint32_t n, std::uint32_t least) const {
    const std::uint32_t chunk = n / (threads_ * 4);
    return chunk < least ? least : chunk;
  }
  void run_together(void* context, void (*task)(void*));

  class Together;
  const PlumbHost* host_;
  std::uint32_t threads_;
  std::unique_ptr<Arena> arena_;  // own; null with one thread or with the host's job system
  Together* together_ = nullptr;
};

}  // namespace plumb::impulse
