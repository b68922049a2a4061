// Whose time a cell takes: the engine's, or that of the harness, which looks at what the engine did and works out what
// is true. Kept in memory that a worker shares with its parent, so that each of the two has a limit of its own.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace plumb::harness {

class CellClock {
 public:
  /// The parent's, before it asks: all time from here on is the engine's until somebody says otherwise.
  void start() {
    start_ = now();
    word_ = 0;
  }
  /// What follows is the engine's doing, or that of whoever judges it.
  void engine() { word_ = times().judge << 1; }
  void judge() { word_ = times().engine << 1 | judging; }

  struct Times {
    std::uint64_t engine, judge;  ///< ns
    bool judging;                 ///< now
  };
  [[nodiscard]] Times times() const {
    const std::uint64_t word = word_, passed = now() - start_, other = word >> 1;
    const std::uint64_t mine = passed > other ? passed - other : 0;
    return (word & judging) != 0 ? Times{other, mine, true} : Times{mine, other, false};
  }

 private:
  static constexpr std::uint64_t judging = 1;
  static std::uint64_t now() {
    const auto time = std::chrono::steady_clock::now().time_since_epoch();  // the same for all processes
    return static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(time).count());
  }

  std::atomic<std::uint64_t> start_{0};
  /// Twice the time that whoever is not at work now has had, and one while the harness is: one word, so that the parent
  /// never sees half a change.
  std::atomic<std::uint64_t> word_{0};
};

/// What the engine does from here to the end of the block. Without a clock nobody is timed.
class EngineAtWork {
 public:
  explicit EngineAtWork(CellClock* clock) : clock_(clock) {
    if (clock_ != nullptr) clock_->engine();
  }
  ~EngineAtWork() {
    if (clock_ != nullptr) clock_->judge();
  }
  EngineAtWork(const EngineAtWork&) = delete;
  EngineAtWork& operator=(const EngineAtWork&) = delete;

 private:
  CellClock* clock_;
};

}  // namespace plumb::harness
