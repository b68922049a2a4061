// Where the threads know nothing but to help a team.
#include <exception>
#include <mutex>

#include "exec/cpu/arena.hpp"

namespace plumb::impulse {

void Arena::run(std::uint32_t count, void* context, PlumbTask task) {
  struct Job {
    void* context;
    PlumbTask task;
    std::mutex mutex{};
    std::exception_ptr thrown{};
  } job{context, task};
  HotTeam team;
  call(team);
  team.share(count, &job, [](void* of_job, std::uint32_t c) {
    Job& all = *static_cast<Job*>(of_job);
    try {
      all.task(all.context, c);
    } catch (...) {
      const std::lock_guard lock(all.mutex);
      if (!all.thrown) all.thrown = std::current_exception();
    }
  });
  team.dismiss();
  wait();
  if (job.thrown) std::rethrow_exception(job.thrown);
}

void Arena::enter(void* context, void (*job)(void*)) { job(context); }

}  // namespace plumb::impulse
