// The threads of a .wasm: workers of the page, each with an instance of the same module over the same memory. They are
// there before the worlds are, for a page's own thread may not wait for one to start; all worlds of the engine take
// them in turn, as one thread steps them. engine/threads.mjs makes them; of emscripten's threads only what a thread is
// to its libraries is used.
#include <pthread.h>

#include <atomic>
#include <cstdlib>

#include "exec/cpu/arena.hpp"
#include "plumb/assert.hpp"

#define PLUMB_WEB_EXPORT(name) __attribute__((export_name(#name)))

extern "C" {
void _emscripten_thread_init(pthread_t self, int is_main, int is_runtime, int may_wait, int profiles);
int _emscripten_thread_supports_atomics_wait();
int emscripten_is_main_runtime_thread();
void __wasm_init_tls(void* block);
}

namespace plumb::impulse {

namespace {

constexpr std::int64_t kForever = -1;
constexpr std::int64_t kNap = 20'000;  // ns
constexpr std::size_t kStack = 2U << 20U;
constexpr int kThreadLost = 86;  // engine/wasi.mjs has the sentence

/// Who may come to help, and who is inside. A leader that leaves shuts the door and waits for those inside alone:
/// whoever has not woken by then comes too late, and holds nobody up.
class Door {
 public:
  void open(std::uint32_t seats) {
    word_.store(seats * kSeat, std::memory_order_release);
    __builtin_wasm_memory_atomic_notify(address(), seats);
  }
  void shut() { word_.fetch_and(kInside, std::memory_order_acq_rel); }
  [[nodiscard]] bool someone_inside() const { return (word_.load(std::memory_order_acquire) & kInside) != 0; }

  void close() {
    word_.store(kClosed, std::memory_order_release);
    __builtin_wasm_memory_atomic_notify(address(), kInside);
  }
  /// Sleeps until there is a seat, and takes it; false: closed.
  bool take_seat() {
    for (;;) {
      std::uint32_t seen = word_.load(std::memory_order_acquire);
      if ((seen & kClosed) != 0) return false;
      if (seen < kSeat)
        __builtin_wasm_memory_atomic_wait32(address(), static_cast<int>(seen), kForever);
      else if (word_.compare_exchange_weak(seen, seen - kSeat + 1, std::memory_order_acq_rel))
        return true;
    }
  }
  void leave() { word_.fetch_sub(1, std::memory_order_release); }

 private:
  static constexpr std::uint32_t kSeat = 1U << 16U, kInside = kSeat - 1, kClosed = 1U << 31U;
  int* address() { return reinterpret_cast<int*>(&word_); }
  std::atomic<std::uint32_t> word_ = 0;
};

struct Workers {
  std::atomic<std::uint32_t> count = 0;
  std::atomic<bool> lost = false;
  Door door;
  HotTeam* team = nullptr;  // while the door is open
};
Workers& workers() {
  static constinit Workers all;
  return all;
}

}  // namespace

struct Arena::Threads {
  std::uint32_t others;
};

Arena::Arena(std::uint32_t threads) : threads_(std::make_unique<Threads>(Threads{threads - 1})) {}
Arena::~Arena() = default;

void Arena::call(HotTeam& team) {
  PLUMB_ASSERT(!workers().door.someone_inside());
  workers().team = &team;
  workers().door.open(threads_->others);
}

void Arena::wait() {
  workers().door.shut();
  while (workers().door.someone_inside() && !workers().lost) {
  }
}

void give_way() {
  if (workers().lost && emscripten_is_main_runtime_thread() != 0) std::_Exit(kThreadLost);
  static int never = 0;
  if (_emscripten_thread_supports_atomics_wait() != 0) __builtin_wasm_memory_atomic_wait32(&never, never, kNap);
}

}  // namespace plumb::impulse

using plumb::impulse::workers;

extern "C" {

/// The thread that loaded the engine may sleep: it is not a page's own.
PLUMB_WEB_EXPORT(plumb_may_sleep) void plumb_may_sleep() { _emscripten_thread_init(pthread_self(), 0, 1, 1, 0); }

/// What a thread has but for the worker that runs it: thread-specific data, and a stack. 0: no memory is left.
PLUMB_WEB_EXPORT(plumb_new_thread) pthread_t plumb_new_thread() {
  pthread_t thread{};
  const int error = pthread_create(
      &thread, nullptr, [](void* /*nothing*/) -> void* { return nullptr; }, nullptr);
  return error == 0 ? thread : 0;
}
/// Where its stack begins.
PLUMB_WEB_EXPORT(plumb_stack_of) void* plumb_stack_of(pthread_t thread) {
  pthread_attr_t attributes;
  void* lowest = nullptr;
  std::size_t size = 0;
  pthread_getattr_np(thread, &attributes);
  pthread_attr_getstack(&attributes, &lowest, &size);
  return static_cast<std::byte*>(lowest) + size;
}
/// Called by the worker, on that stack: from now on it is that thread.
PLUMB_WEB_EXPORT(plumb_enter_thread) void plumb_enter_thread(pthread_t thread) {
  _emscripten_thread_init(thread, 0, 0, 1, 0);
  __wasm_init_tls(std::aligned_alloc(__builtin_wasm_tls_align(), __builtin_wasm_tls_size()));
  ++workers().count;
}
/// Helps whoever calls, until the threads are closed.
PLUMB_WEB_EXPORT(plumb_serve) void plumb_serve() {
  while (workers().door.take_seat()) {
    workers().team->help();
    workers().door.leave();
  }
}
PLUMB_WEB_EXPORT(plumb_close_threads) void plumb_close_threads() { workers().door.close(); }
/// Of a worker that died amid a task, which nobody will finish.
PLUMB_WEB_EXPORT(plumb_lose_thread) void plumb_lose_thread() { workers().lost = true; }

// What emscripten's libraries ask for.

void __emscripten_init_main_thread_js(pthread_t self) { _emscripten_thread_init(self, 1, 1, 0, 0); }
/// Its worker comes later.
int __pthread_create_js(pthread_t /*thread*/, const pthread_attr_t* /*attributes*/, void* (* /*start*/)(void*),
                        void* /*arg*/) {
  return 0;
}
void emscripten_check_blocking_allowed() {}
std::size_t _emscripten_default_pthread_stack_size() { return plumb::impulse::kStack; }
int emscripten_num_logical_cores() { return static_cast<int>(1 + workers().count); }
}
