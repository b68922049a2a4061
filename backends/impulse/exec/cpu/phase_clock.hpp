// Kernels run at once, so the host's clock tells; reading it costs next to nothing, so every step is measured.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>

#include "exec/cpu/executor.hpp"
#include "plumb/plumb.h"

namespace plumb::impulse {

class PhaseClock {
 public:
  static constexpr std::uint32_t kEvery = 1;
  [[nodiscard]] static bool measures(std::uint32_t /*step*/) { return true; }

  void measure(bool /*on*/) {}
  void start(Executor& /*executor*/) {
    seconds_.fill(0);
    last_ = Clock::now();
  }
  void end(Executor& /*executor*/, PlumbPhase phase) {
    const Clock::time_point now = Clock::now();
    seconds_[phase] = std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }
  [[nodiscard]] double seconds(PlumbPhase phase) const { return seconds_[phase]; }

 private:
  using Clock = std::chrono::steady_clock;
  std::array<double, PLUMB_PHASE_COUNT> seconds_{};
  Clock::time_point last_;
};

}  // namespace plumb::impulse
