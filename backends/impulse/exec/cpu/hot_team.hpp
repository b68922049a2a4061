// Threads that stay together for the many short loops of a step, and wait for the next one by looking out for it: to
// wake threads takes longer than most of those loops ("hot teams" and the active wait policy of OpenMP's libraries).
#pragma once

#include <atomic>
#include <cstdint>

#include "exec/floating_point.hpp"
#include "exec/simd.hpp"
#include "plumb/plumb.h"

namespace plumb::impulse {

/// Others may have the processor in between (arena_*.cpp).
void give_way();

/// One thread leads, any number of others help. None must come: what nobody takes the leader does.
class HotTeam {
 public:
  /// task(context, c) for every c < count, by the leader and whoever helps. Tasks must not throw.
  void share(std::uint32_t count, void* context, PlumbTask task) {
    context_ = context;
    task_ = task;
    done_.store(0, std::memory_order_relaxed);
    tickets_.store(std::uint64_t{count} << 32, std::memory_order_release);
    work();
    Patience patience;
    while (done_.load(std::memory_order_acquire) != count) patience.wait();
  }
  /// Of another thread, until the leader dismisses all.
  void help() {
    const FloatingPointScope scope;
    Patience patience;
    while (!dismissed_.load(std::memory_order_acquire))
      if (work())
        patience = {};
      else
        patience.wait();
  }
  void dismiss() { dismissed_.store(true, std::memory_order_release); }

 private:
  /// Looks again at once for some microseconds; after that others may have the processor in between.
  class Patience {
   public:
    void wait() {
      if (++looks_ > kLooks) return give_way();
      simd::pause();
    }

   private:
#if defined(__wasm__)  // which has no instruction to pause by
    static constexpr std::uint32_t kLooks = 20'000;
#else
    static constexpr std::uint32_t kLooks = 500;
#endif
    std::uint32_t looks_ = 0;
  };

  /// Takes tasks until there are none. Whoever holds a ticket below the count holds up the loop, and so what it reads
  /// of the loop stays: a ticket that was drawn late is one of the next loop, or none.
  bool work() {
    bool did = false;
    while (has_task(tickets_.load(std::memory_order_acquire))) {
      const std::uint64_t ticket = tickets_.fetch_add(1, std::memory_order_acq_rel);
      if (!has_task(ticket)) break;
      task_(context_, static_cast<std::uint32_t>(ticket));
      done_.fetch_add(1, std::memory_order_release);
      did = true;
    }
    return did;
  }
  static bool has_task(std::uint64_t ticket) { return static_cast<std::uint32_t>(ticket) < ticket >> 32; }

  static constexpr std::size_t kLine = 64;                 // of a cache, bytes
  alignas(kLine) std::atomic<std::uint64_t> tickets_ = 0;  // how many tasks the loop has, and the next one
  alignas(kLine) std::atomic<std::uint32_t> done_ = 0;     // of them
  alignas(kLine) std::atomic<bool> dismissed_ = false;
  void* context_ = nullptr;
  PlumbTask task_ = nullptr;
};

}  // namespace plumb::impulse
