#include "exec/cpu/crew.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <thread>

#include "exec/floating_point.hpp"

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

struct Crew::Arena {
  explicit Arena(int threads) : arena(threads) {}
  tbb::task_arena arena;
};

Crew::Crew(const PlumbHost* host, std::uint32_t threads) : host_(host), threads_(threads == 0 ? 1 : threads) {
  const bool lends = host_ != nullptr && host_->run != nullptr && host_->worker_count > 0;
  if (!lends) host_ = nullptr;
  if (lends && threads_ > host_->worker_count) threads_ = host_->worker_count;
  if (!lends) threads_ = std::min(threads_, processors());
  if (!lends && threads_ > 1) arena_ = new Arena(static_cast<int>(threads_));
}
Crew::~Crew() { delete arena_; }

std::uint32_t Crew::processors() { return std::max(1U, std::thread::hardware_concurrency()); }

void Crew::run_chunks(std::uint32_t count, void* context, PlumbTask task) const {
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
