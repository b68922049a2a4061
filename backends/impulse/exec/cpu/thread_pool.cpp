#include "exec/cpu/thread_pool.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <algorithm>
#include <thread>

#include "exec/cpu/hot_team.hpp"
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

struct ThreadPool::Arena {
  explicit Arena(int threads) : arena(threads) {}
  tbb::task_arena arena;
};

/// The threads while they stay together. They are called when there is something to share.
class ThreadPool::Together {
 public:
  explicit Together(std::uint32_t helpers) : helpers_(helpers) {}
  ~Together() {
    team_.dismiss();
    called_.wait();
  }
  Together(const Together&) = delete;
  Together& operator=(const Together&) = delete;

  void share(std::uint32_t count, void* context, PlumbTask task) {
    for (; helpers_ > 0; --helpers_) called_.run([this] { team_.help(); });
    team_.share(count, context, task);
  }

 private:
  HotTeam team_;
  tbb::task_group called_;
  std::uint32_t helpers_;  // yet to be called
};

ThreadPool::ThreadPool(const PlumbHost* host, std::uint32_t threads)
    : host_(host), threads_(threads == 0 ? 1 : threads) {
  const bool lends = host_ != nullptr && host_->run != nullptr && host_->worker_count > 0;
  if (!lends) host_ = nullptr;
  if (lends && threads_ > host_->worker_count) threads_ = host_->worker_count;
  if (!lends) threads_ = std::min(threads_, processors());
  if (!lends && threads_ > 1) arena_ = new Arena(static_cast<int>(threads_));
}
ThreadPool::~ThreadPool() { delete arena_; }

std::uint32_t ThreadPool::processors() { return std::max(1U, std::thread::hardware_concurrency()); }

void ThreadPool::run_together(void* context, void (*task)(void*)) {
  arena_->arena.execute([&] {
    const FloatingPointScope scope;
    PLUMB_ASSERT(together_ == nullptr);
    Together together(threads_ - 1);
    together_ = &together;
    struct Leave {
      ThreadPool& pool;
      ~Leave() { pool.together_ = nullptr; }
    } const leave{*this};
    task(context);
  });
}

void ThreadPool::run_chunks(std::uint32_t count, void* context, PlumbTask task) {
  if (together_ != nullptr) return together_->share(count, context, task);
  GuardedTask guarded{context, task};
  if (host_ != nullptr) {
    host_->run(
        host_->user, [](void* job, std::uint32_t c) { (*static_cast<const GuardedTask*>(job))(c); }, &guarded, count);
  } else if (arena_) {
    arena_->arena.execute([&] { tbb::parallel_for(std::uint32_t{0}, count, guarded, tbb::simple_partitioner{}); });
  } else {
    for (std::uint32_t c = 0; c < count; ++c) guarded(c);
  }
}

}  // namespace plumb::impulse
