#include "exec/cpu/thread_pool.hpp"

#include <algorithm>
#include <thread>

#include "exec/cpu/arena.hpp"
#include "exec/floating_point.hpp"
#include "plumb/assert.hpp"

namespace plumb::impulse {

namespace {

struct GuardedTask {
  void* context;
  PlumbTask task;
  void operator()(std::uint32_t c) const {
    const FloatingPointScope scope;
    task(context, c);
  }
};

}  // namespace

/// The threads while they stay together. They are called when there is something to share.
class ThreadPool::Together {
 public:
  explicit Together(Arena& arena) : arena_(arena) {}
  ~Together() {
    team_.dismiss();
    arena_.wait();
  }
  Together(const Together&) = delete;
  Together& operator=(const Together&) = delete;

  void share(std::uint32_t count, void* context, PlumbTask task) {
    if (!called_) arena_.call(team_);
    called_ = true;
    team_.share(count, context, task);
  }

 private:
  Arena& arena_;
  HotTeam team_;
  bool called_ = false;
};

ThreadPool::ThreadPool(const PlumbHost* host, std::uint32_t threads)
    : host_(host), threads_(threads == 0 ? 1 : threads) {
  const bool lends = host_ != nullptr && host_->run != nullptr && host_->worker_count > 0;
  if (!lends) host_ = nullptr;
  if (lends && threads_ > host_->worker_count) threads_ = host_->worker_count;
  if (!lends) threads_ = std::min(threads_, processors());
  if (!lends && threads_ > 1) arena_ = std::make_unique<Arena>(threads_);
}
ThreadPool::~ThreadPool() = default;

std::uint32_t ThreadPool::processors() { return std::max(1U, std::thread::hardware_concurrency()); }

ThreadPool& ThreadPool::one_thread() {
  static ThreadPool pool(nullptr, 1);
  return pool;
}

void ThreadPool::run_together(void* context, void (*task)(void*)) {
  struct Job {
    ThreadPool& pool;
    void* context;
    void (*task)(void*);
    void operator()() const {
      const FloatingPointScope scope;
      PLUMB_ASSERT(pool.together_ == nullptr);
      Together together(*pool.arena_);
      pool.together_ = &together;
      struct Leave {
        ThreadPool& pool;
        ~Leave() { pool.together_ = nullptr; }
      } const leave{pool};
      task(context);
    }
  } job{*this, context, task};
  arena_->enter(&job, [](void* all) { (*static_cast<const Job*>(all))(); });
}

void ThreadPool::run_chunks(std::uint32_t count, void* context, PlumbTask task) {
  if (together_ != nullptr) return together_->share(count, context, task);
  GuardedTask guarded{context, task};
  const PlumbTask run_guarded = [](void* job, std::uint32_t c) { (*static_cast<const GuardedTask*>(job))(c); };
  if (host_ != nullptr) {
    host_->run(host_->user, run_guarded, &guarded, count);
  } else if (arena_) {
    arena_->run(count, &guarded, run_guarded);
  } else {
    for (std::uint32_t c = 0; c < count; ++c) guarded(c);
  }
}

}  // namespace plumb::impulse
