#include "thread_team.hpp"

namespace plumb::helpers {

ThreadTeam::ThreadTeam(std::uint32_t threads) : shares_(threads) {
  for (std::uint32_t i = 1; i < threads; ++i) others_.emplace_back([this, i] { wait_for_tasks(i); });
}

ThreadTeam::~ThreadTeam() {
  const std::scoped_lock lock(mutex_);
  over_ = true;
  begins_.notify_all();
}

void ThreadTeam::wait_for_tasks(std::size_t thread) {
  std::uint64_t seen = 0;
  for (;;) {
    {
      std::unique_lock lock(mutex_);
      begins_.wait(lock, [&] { return over_ || round_ != seen; });
      if (over_) return;
      seen = round_;
    }
    work(thread);
    const std::scoped_lock lock(mutex_);
    if (--at_work_ == 0) ends_.notify_one();
  }
}

void ThreadTeam::work(std::size_t thread) {
  for (std::size_t k = 0; k < shares_.size(); ++k) {
    Share& share = shares_[(thread + k) % shares_.size()];
    for (std::size_t task = share.next++; task < share.end; task = share.next++) run(task);
  }
}

void ThreadTeam::run(std::size_t task) {
  try {
    (*task_)(task);
  } catch (...) {
    const std::scoped_lock lock(mutex_);
    if (failure_ && failed_ < task) return;
    failure_ = std::current_exception();
    failed_ = task;
  }
}

void ThreadTeam::each(std::size_t n, const std::function<void(std::size_t)>& f) {
  {
    const std::scoped_lock lock(mutex_);
    task_ = &f;
    failure_ = nullptr;
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      shares_[i].next = i * n / shares_.size();
      shares_[i].end = (i + 1) * n / shares_.size();
    }
    if (n > 1) {
      at_work_ = others_.size();
      ++round_;
    }
  }
  if (n > 1) begins_.notify_all();
  work(0);
  std::unique_lock lock(mutex_);
  ends_.wait(lock, [this] { return at_work_ == 0; });
  if (failure_) std::rethrow_exception(failure_);
}

}  // namespace plumb::helpers
