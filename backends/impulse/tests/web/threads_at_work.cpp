// What tests ask of the threads of a .wasm, beside the hashes (test_threads.mjs).
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "api/web/exports/shared.hpp"
#include "exec/cpu/arena.hpp"

extern "C" int emscripten_is_main_runtime_thread();

namespace {

using plumb::impulse::Arena;

constexpr std::uint32_t kFresh = 7;
thread_local std::uint32_t own = kFresh;

bool is_worker() { return emscripten_is_main_runtime_thread() == 0; }

/// A task for each thread, which first waits until every other one is in its own; false: some never came.
template <class Task>
bool each_on_its_own(std::uint32_t threads, const Task& task) {
  struct Meeting {
    const Task& task;
    std::uint32_t wanted;
    std::atomic<std::uint32_t> here = 0;
    std::atomic<bool> missed = false;
  } meeting{task, threads};
  Arena(threads).run(threads, &meeting, [](void* context, std::uint32_t i) {
    Meeting& all = *static_cast<Meeting*>(context);
    ++all.here;
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (all.here < all.wanted)
      if (std::chrono::steady_clock::now() > end) {
        all.missed = true;
        return;
      }
    all.task(i);
  });
  return !meeting.missed;
}

}  // namespace

PLUMB_WEB(bool, test_meet)(std::uint32_t threads) {
  return each_on_its_own(threads, [](std::uint32_t) {});
}

/// Memory that all threads take and give back at once is each one's own.
PLUMB_WEB(bool, test_allocate)(std::uint32_t threads) {
  std::atomic<bool> torn = false;
  const bool met = each_on_its_own(threads, [&](std::uint32_t mine) {
    std::vector<std::vector<std::uint32_t>> kept(16);
    for (std::uint32_t round = 0; round < 5000; ++round) {
      auto& one = kept[round % kept.size()];
      for (const std::uint32_t value : one) torn = torn || value != mine;
      one = std::vector<std::uint32_t>(1 + round * 37 % 500, mine);
    }
  });
  return met && !torn;
}

/// The last of many words that a worker took memory for, and wrote 42 to.
PLUMB_WEB(const std::uint32_t*, test_grow)(std::uint32_t threads) {
  static std::vector<std::uint32_t> taken;
  each_on_its_own(threads, [&](std::uint32_t) {
    if (is_worker() && taken.empty()) taken.assign(1U << 25U, 42);
  });
  return &taken.back();
}

/// What is thread-local is each thread's own, and fresh in each.
PLUMB_WEB(bool, test_own)(std::uint32_t threads) {
  std::atomic<std::uint32_t> written = 0;
  std::atomic<bool> wrong = false;
  const bool met = each_on_its_own(threads, [&](std::uint32_t mine) {
    if (own != kFresh) wrong = true;
    own = mine;
    ++written;
    while (written < threads) {
    }
    if (own != mine) wrong = true;
    own = kFresh;
  });
  return met && !wrong;
}

PLUMB_WEB(PlumbResult, test_throw)(std::uint32_t threads) {
  return plumb::web::guarded([&] {
    each_on_its_own(threads, [](std::uint32_t) {
      if (is_worker()) throw std::runtime_error("thrown by a worker");
    });
    return PLUMB_OK;
  });
}

PLUMB_WEB(void, test_trap)(std::uint32_t threads) {
  each_on_its_own(threads, [](std::uint32_t) {
    if (is_worker()) __builtin_trap();
  });
}
