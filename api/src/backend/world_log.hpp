// What the host's log is told of a world, whatever the engine: each kind of remark of its steps once, for a step report
// is read by few, and why it was lost.
#pragma once

#include <string>

#include "plumb/backend/world_init.hpp"

namespace plumb::backend {

class WorldLog {
 public:
  void tell_remarks(const WorldInit& init, const PlumbStepReport& report) noexcept {
    struct Kind {
      std::uint32_t bit;
      PlumbLogLevel level;
      const char* text;
    };
    constexpr Kind kKinds[] = {
        {PLUMB_REMARK_SOLVER_FELL_BACK, PLUMB_LOG_WARNING,
         "the solver that was chosen gave up and another finished it"},
        {PLUMB_REMARK_CAPACITY_GREW, PLUMB_LOG_INFO, "memory grew, which takes time"},
        {PLUMB_REMARK_STEP_REPEATED, PLUMB_LOG_INFO, "it was taken again, which takes time"},
        {PLUMB_REMARK_ENERGY_BOUNDED, PLUMB_LOG_WARNING,
         "it would have made energy, so something was solved again in smaller steps or held; a smaller dt may help"},
    };
    for (const Kind& kind : kKinds)
      if ((report.remarks & ~told_ & kind.bit) != 0)
        tell(init, kind.level, [&] {
          return "step " + std::to_string(report.step) + ": " + kind.text + " (told once a world; step reports go on)";
        });
    told_ |= report.remarks;
  }

  static void tell_lost(const WorldInit& init, const std::string& why) noexcept {
    tell(init, PLUMB_LOG_ERROR, [&] { return "a world is lost: " + why; });
  }

 private:
  /// A line that cannot be made or told is no failure of the call that it is about.
  template <class Line>
  static void tell(const WorldInit& init, PlumbLogLevel level, const Line& line) noexcept {
    try {
      init.log(level, line());
    } catch (...) {
    }
  }

  std::uint32_t told_ = 0;
};

}  // namespace plumb::backend
