// The threads of a world: one, oneTBB's, or the host's job system.
#pragma once

#include <cstdint>

#include "plumb/plumb.h"

namespace plumb::impulse {

class Crew {
 public:
  /// host may be null. Where it lends a job system and more than one thread is asked for, that is used.
  Crew(const PlumbHost* host, std::uint32_t threads);
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;
  ~Crew();

  /// Of this machine, at least one.
  static std::uint32_t processors();
  [[nodiscard]] std::uint32_t threads() const { return threads_; }

  /// f(i) for every i < n. Small n, or one thread: a plain loop here.
  template <class F>
  void each(std::uint32_t n, const F& f) {
    if (threads_ == 1 || n <= kSmall) {
      for (std::uint32_t i = 0; i < n; ++i) f(i);
      return;
    }
    struct Job {
      const F& f;
      std::uint32_t n, chunk;
    } job{f, n, chunk_of(n)};
    run_chunks((n + job.chunk - 1) / job.chunk, &job, [](void* context, std::uint32_t c) {
      const Job& all = *static_cast<const Job*>(context);
      const std::uint32_t end = all.n - c * all.chunk < all.chunk ? all.n : (c + 1) * all.chunk;
      for (std::uint32_t i = c * all.chunk; i < end; ++i) all.f(i);
    });
  }

  /// task(context, c) for every c < count, on all threads, each with the floating-point control word that results rely
  /// on (floating_point.hpp).
  void run_chunks(std::uint32_t count, void* context, PlumbTask task) const;

 private:
  static constexpr std::uint32_t kSmall = 64;

  [[nodiscard]] std::uint32_t chunk_of(std::uint32_t n) const {
    const std::uint32_t chunk = n / (threads_ * 4);
    return chunk < 16 ? 16 : chunk;
  }

  struct Arena;
  const PlumbHost* host_;
  std::uint32_t threads_;
  Arena* arena_ = nullptr;  // own; null with one thread or with the host's job system
};

}  // namespace plumb::impulse
