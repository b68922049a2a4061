#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <thread>

#include "exec/cpu/arena.hpp"

namespace plumb::impulse {

struct Arena::Threads {
  explicit Threads(std::uint32_t threads) : arena(static_cast<int>(threads)), others(threads - 1) {}
  tbb::task_arena arena;
  tbb::task_group called;
  std::uint32_t others;
};

Arena::Arena(std::uint32_t threads) : threads_(std::make_unique<Threads>(threads)) {}
Arena::~Arena() = default;

void Arena::run(std::uint32_t count, void* context, PlumbTask task) {
  threads_->arena.execute([&] {
    tbb::parallel_for(
        std::uint32_t{0}, count, [&](std::uint32_t c) { task(context, c); }, tbb::simple_partitioner{});
  });
}

void Arena::enter(void* context, void (*job)(void*)) {
  threads_->arena.execute([&] { job(context); });
}

void Arena::call(HotTeam& team) {
  for (std::uint32_t i = 0; i < threads_->others; ++i) threads_->called.run([&team] { team.help(); });
}

void Arena::wait() { threads_->called.wait(); }

void give_way() { std::this_thread::yield(); }

}  // namespace plumb::impulse
