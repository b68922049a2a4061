// What the validation layer knows of one world: who is inside, the phase of its step, and how many bodies should live.
#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <string>

#include "calls.hpp"
#include "plumb/physics_world.hpp"

namespace plumb::layers {

struct ValidatedWorld {
  bool stepping = false;  ///< between step and wait
  bool destroyed = false;
  PlumbResult lost = PLUMB_OK;  ///< WORLD_LOST or DEVICE_LOST once it is
  std::uint32_t bodies = 0;     ///< alive, by what was created and destroyed
  std::atomic<int> inside = 0;  ///< -1: a [world] call; above 0: that many [query] calls

  void set_text(const std::string& text) {
    const std::lock_guard lock(text_mutex_);
    text_ = text;
  }
  [[nodiscard]] const char* text() {
    const std::lock_guard lock(text_mutex_);
    return text_.c_str();
  }

 private:
  std::mutex text_mutex_;
  std::string text_;
};

/// Being inside a world for the time of a call, as its thread tag allows.
class Visit {
 public:
  Visit(ValidatedWorld& world, Thread thread) : inside_(world.inside), alone_(thread != Thread::many_callers) {
    int now = 0;
    if (alone_) {
      entered_ = inside_.compare_exchange_strong(now, -1);
      return;
    }
    now = inside_.load();
    while (now >= 0 && !entered_) entered_ = inside_.compare_exchange_weak(now, now + 1);
  }
  Visit(const Visit&) = delete;
  Visit& operator=(const Visit&) = delete;
  ~Visit() {
    if (!entered_) return;
    if (alone_) {
      inside_.store(0);
    } else {
      inside_.fetch_sub(1);
    }
  }

  [[nodiscard]] bool entered() const { return entered_; }

 private:
  std::atomic<int>& inside_;
  bool alone_;
  bool entered_ = false;
};

}  // namespace plumb::layers
