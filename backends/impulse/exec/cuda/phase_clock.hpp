// Events between the phases, recorded within the captured graph. Each is a node of the graph and takes its share of
// the device's time, so only one step in sixteen has them: a graph of its own.
#pragma once

#include <cuda_runtime_api.h>

#include <array>
#include <cstdint>

#include "exec/cuda/executor.cuh"
#include "plumb/plumb.h"

namespace plumb::impulse {

class PhaseClock {
 public:
  static constexpr std::uint32_t kEvery = 16;
  [[nodiscard]] static bool measures(std::uint32_t step) { return step % kEvery == 0; }

  PhaseClock() {
    for (Mark& mark : marks_) check_cuda(cudaEventCreate(&mark.event), "cannot make an event");
  }
  PhaseClock(const PhaseClock&) = delete;
  PhaseClock& operator=(const PhaseClock&) = delete;
  ~PhaseClock() {
    for (Mark& mark : marks_) (void)cudaEventDestroy(mark.event);
  }

  void measure(bool on) { on_ = on; }
  /// These two are called while the graph is captured; its replays record the same events anew.
  void start(Executor& executor) {
    if (on_) count_ = 0;
    record(executor, PLUMB_PHASE_COUNT);
  }
  void end(Executor& executor, PlumbPhase phase) { record(executor, phase); }

  [[nodiscard]] double seconds(PlumbPhase phase) const {
    for (std::uint32_t i = 1; i < count_; ++i) {
      if (marks_[i].phase != phase) continue;
      float milliseconds = 0;
      check_cuda(cudaEventElapsedTime(&milliseconds, marks_[i - 1].event, marks_[i].event), "cannot tell the time");
      return 1e-3 * static_cast<double>(milliseconds);
    }
    return 0;
  }

 private:
  struct Mark {
    PlumbPhase phase;
    cudaEvent_t event;
  };
  void record(Executor& executor, PlumbPhase phase) {
    if (!on_) return;
    Mark& mark = marks_[count_++];
    mark.phase = phase;
    check_cuda(cudaEventRecordWithFlags(mark.event, executor.stream(), cudaEventRecordExternal),
               "cannot record an event");
  }

  std::array<Mark, PLUMB_PHASE_COUNT + 1> marks_{};
  std::uint32_t count_ = 0;
  bool on_ = false;
};

}  // namespace plumb::impulse
