// The executor of the CPU library: kernels run at once, on the world's threads.
#pragma once

#include <memory>
#include <string>

#include "exec/cpu/recording.hpp"
#include "exec/cpu/thread_pool.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

/// Threads that go through several loops together.
class Team {
 public:
  explicit Team(ThreadPool& pool) : pool_(pool) {}
  template <class F>
  void each(std::uint32_t n, const F& f) {
    pool_.each(n, f);
  }
  template <class Load, class Fetch, class F>
  void each_ahead(std::uint32_t n, const Load& load, const Fetch& /*fetch*/, const F& f) {
    pool_.each(
        n,
        [&](std::uint32_t i) {
          auto loaded = load(i);
          f(i, loaded);
        },
        LoopBody::kLarge);
  }
  template <class F>
  void each_group(std::uint32_t small, std::uint32_t n, const F& f) {
    pool_.each(
        small,
        [&](std::uint32_t g) {
          Team own(ThreadPool::one_thread());
          f(own, g);
        },
        LoopBody::kTask);
    for (std::uint32_t g = small; g < n; ++g) f(*this, g);
  }
  template <class F>
  void single(const F& f) {
    f();
  }
  void barrier() {}

 private:
  ThreadPool& pool_;
};

/// Tells when rows may be read; on the CPU always.
struct Signal {
  [[nodiscard]] void* handle() const { return nullptr; }
};

/// Worlds that are stepped together. On a CPU they are not: a thread a world is all that can be done.
class Batch {};

class Executor {
 public:
  static constexpr bool kWarps = false;              // whether neighbouring threads must do the same to be fast
  static constexpr std::uint32_t kGroupThreads = 1;  // of the team of a small group

  Executor(const PlumbHost* host, std::uint32_t threads) : pool_(host, threads) {}

  /// Whether a step is recorded, with the numbers that it had.
  static bool records() { return !kOneMemory; }
  static std::string unmet_requirement() { return {}; }
  static const char* device_name() { return "cpu"; }
  static std::uint32_t max_threads() { return ThreadPool::processors(); }

  [[nodiscard]] std::uint32_t threads() const { return pool_.threads(); }
  void join(const std::shared_ptr<Batch>& /*batch*/) {}
  [[nodiscard]] static bool is_in_batch() { return false; }
  void leave() noexcept {}

  template <class F>
  void run(std::uint32_t n, const F& f) {
    if (recording_ != nullptr) recording_->note(n, f);
    pool_.each(n, f);
  }
  template <class F>
  void run(Count n, const F& f) {
    if (recording_ != nullptr) recording_->note(n.capacity, f);
    pool_.each(*n.value < n.capacity ? *n.value : n.capacity, f);
  }
  template <class F>
  void team(Count load, std::uint32_t least, const F& f) {
    if (recording_ != nullptr) recording_->note(load.capacity < least ? least : load.capacity, f);
    Team team(pool_);
    f(team);
  }
  template <class F>
  void record(Recording& recording, const F& f) {
    if (!records()) return pool_.together(f);
    PLUMB_ASSERT(recording_ == nullptr);  // recordings do not nest
    recording.begin();
    recording_ = &recording;
    try {
      f();
      recording.end();
    } catch (...) {
      recording_ = nullptr;
      throw;
    }
    recording_ = nullptr;
  }
  [[nodiscard]] std::uint32_t host_threads() const { return threads(); }
  template <class F>
  void on_host(std::uint32_t n, const F& f) {
    const F* task = &f;
    pool_.run_chunks(n, &task, [](void* context, std::uint32_t i) { (**static_cast<const F**>(context))(i); });
  }
  template <class T>
  void to_device(Mirror<T>& mirror, std::size_t count, std::size_t first = 0) {
    PLUMB_ASSERT(first + count <= mirror.size());
    if (kOneMemory || count == 0) return;
    memory::upload(mirror.device() + first, mirror.host() + first, count * sizeof(T));
    uploaded_bytes_ += count * sizeof(T);
  }
  template <class T>
  void to_host(Mirror<T>& mirror, std::size_t count) {
    PLUMB_ASSERT(count <= mirror.size());
    if (!kOneMemory && count != 0) memory::download(mirror.host(), mirror.device(), count * sizeof(T));
  }
  [[nodiscard]] std::uint64_t uploaded_bytes() const { return uploaded_bytes_; }
  void wait() {}
  void send(Signal& /*signal*/) {}
  [[nodiscard]] void* stream_handle() const { return nullptr; }
  [[nodiscard]] static std::int32_t device_type() { return kOneMemory ? 1 : 2; }  // of DLPack
  [[nodiscard]] static std::int32_t device_id() { return 0; }
  ThreadPool& pool() { return pool_; }

 private:
  ThreadPool pool_;
  std::uint64_t uploaded_bytes_ = 0;
  Recording* recording_ = nullptr;  // what is being recorded
};

}  // namespace plumb::impulse
