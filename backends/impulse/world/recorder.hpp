// Recordings of steps, which a device replays as long as steps depend on the same (StepInput).
#pragma once

#include "exec/executor.hpp"
#include "world/step_context.hpp"

namespace plumb::impulse {

class StepRecorder {
 public:
  /// Memory that steps work with is elsewhere now, or they do other things.
  void forget() { ++generation_; }
  [[nodiscard]] std::uint64_t generation() const { return generation_; }

  /// Of the step of this number, or of its second half.
  Recording& recording(std::uint32_t number, bool measured, const StepInput& input, bool second_half = false) {
    if (!(input == recorded_)) {
      for (auto& of_half : recordings_)
        for (auto& of_parity : of_half)
          for (Recording& recording : of_parity) recording.forget();
      recorded_ = input;
    }
    return recordings_[second_half ? 1 : 0][measured ? 1 : 0][number % 2];
  }

 private:
  Recording recordings_[2][2][2];  // halves of steps that are measured or not, of each parity
  StepInput recorded_{};
  std::uint64_t generation_ = 1;
};

}  // namespace plumb::impulse
