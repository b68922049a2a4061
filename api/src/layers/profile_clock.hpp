// What a profile's zones are stamped with: the time, and which thread it is.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace plumb::layers {

/// ns of the steady clock.
[[nodiscard]] inline std::int64_t profile_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

/// From 1, in the order in which threads first asked; never given twice.
[[nodiscard]] inline std::uint32_t profile_thread() {
  static std::atomic<std::uint32_t> count = 0;
  static thread_local const std::uint32_t number = ++count;
  return number;
}

}  // namespace plumb::layers
