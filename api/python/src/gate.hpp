// Who may call a world now: one caller at a time, or any number of queries (the thread tags of plumb.h).
//
// Python's own lock does not see to it, for it is let go while a step runs. Nobody waits here: two callers at a time
// are a mistake of the host, which is told so.
#pragma once

#include <atomic>
#include <string>

#include "plumb/physics_world.hpp"

namespace plumb::python {

class Gate {
 public:
  bool enter_alone() {
    int nobody = 0;
    return users_.compare_exchange_strong(nobody, -1, std::memory_order_acquire);
  }
  bool enter_among_others() {
    int users = users_.load(std::memory_order_relaxed);
    while (users >= 0)
      if (users_.compare_exchange_weak(users, users + 1, std::memory_order_acquire)) return true;
    return false;
  }
  void leave_alone() { users_.store(0, std::memory_order_release); }
  void leave_others() { users_.fetch_sub(1, std::memory_order_release); }

 private:
  std::atomic<int> users_{0};  ///< -1: one alone; above 0: so many queries
};

enum class Tag { world, query };

/// Holds the gate for the time of one call. Throws Error (PLUMB_E_WRONG_THREAD) where it is taken.
class Passage {
 public:
  Passage(Gate& gate, Tag tag, const char* call) : gate_(gate), tag_(tag) {
    if (tag == Tag::world ? gate.enter_alone() : gate.enter_among_others()) return;
    throw Error(PLUMB_E_WRONG_THREAD, std::string(call) +
                                          ": another thread is in a call on this world; only queries may run side by "
                                          "side: share it by a threading.Lock, or give each thread its own world");
  }
  Passage(const Passage&) = delete;
  Passage& operator=(const Passage&) = delete;
  ~Passage() { tag_ == Tag::world ? gate_.leave_alone() : gate_.leave_others(); }

 private:
  Gate& gate_;
  Tag tag_;
};

}  // namespace plumb::python
