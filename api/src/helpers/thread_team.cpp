#include "thread_team.hpp"

namespace plumb::helpers {

ThreadTeam::ThreadTeam(std::uint32_t threads) {
  for (std::uint32_t i = 1; i < threads; ++i) others_.emplace_back([this] { wait_for_tasks(); });
}

ThreadTeam::~ThreadTeam() {
  const std::scoped_lock lock(mutex_);
  over_ = true;
  begins_.notify_all();
}

void ThreadTeam::wait_for_tasks() {
  std::uint64_t seen = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      begins_.wait(lock, [&] { return over_ || round_ != seen; });
      if (over_) return;
      seen = round_;
    }
    work();
    const std::scoped_lock lock(mutex_);
    if (--at_work_ == 0) ends_.notify_one();
  }
}

void ThreadTeam::work() {
  for (std::size_t i = next_++; i < count_; i = next_++) try {
      (*task_)(i);
    } catch (...) {
      const std::scoped_lock lock(mutex_);
      if (failure_ && failed_ < i) continue;
      failure_ = std::current_exception();
      failed_ = i;
    }
}

void ThreadTeam::each(std::size_t n, const std::function<void(std::size_t)>& f) {
  {
    const std::scoped_lock lock(mutex_);
    task_ = &f;
    count_ = n;
    next_ = 0;
    failure_ = nullptr;
    if (n > 1) {
      at_work_ = others_.size();
      ++round_;
    }
  }
  if (n > 1) begins_.notify_all();
  work();
  std::unique_lock lock(mutex_);
  ends_.wait(lock, [this] { return at_work_ == 0; });
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace plumb::helpers
