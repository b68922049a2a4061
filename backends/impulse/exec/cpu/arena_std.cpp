#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include "exec/cpu/arena.hpp"

namespace plumb::impulse {

struct Arena::Threads {
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::thread> others;
  HotTeam* team = nullptr;  // that was called for last
  std::uint64_t calls = 0;
  std::size_t away = 0;  // of the others: with the team
  bool closed = false;

  void live() {
    std::unique_lock lock(mutex);
    for (std::uint64_t answered = 0;; ++answered) {
      changed.wait(lock, [&] { return closed || calls != answered; });
      if (closed) return;
      HotTeam& caller = *team;
      lock.unlock();
      caller.help();
      lock.lock();
      if (--away == 0) changed.notify_all();
    }
  }
  void close() {
    {
      const std::lock_guard lock(mutex);
      closed = true;
    }
    changed.notify_all();
    for (std::thread& other : others) other.join();
  }
};

Arena::Arena(std::uint32_t threads) : threads_(std::make_unique<Threads>()) {
  try {
    while (threads_->others.size() + 1 < threads)
      threads_->others.emplace_back([all = threads_.get()] { all->live(); });
  } catch (...) {
    threads_->close();
    throw;
  }
}

Arena::~Arena() { threads_->close(); }

void Arena::call(HotTeam& team) {
  {
    const std::lock_guard lock(threads_->mutex);
    threads_->team = &team;
    threads_->away = threads_->others.size();
    ++threads_->calls;
  }
  threads_->changed.notify_all();
}

void Arena::wait() {
  std::unique_lock lock(threads_->mutex);
  threads_->changed.wait(lock, [&] { return threads_->away == 0; });
}

void give_way() { std::this_thread::yield(); }

}  // namespace plumb::impulse
