// Whether a machine had more to do than cores while something was timed: by what its processors did for others, what
// was stolen from it, and how many timed processes share its cores.
#pragma once

#include <sched.h>
#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "rows/row.hpp"

namespace plumb::harness {

/// Processors' time since the machine started, s, over the processors that this process may use.
struct ProcessorTime {
  double busy = 0;    ///< for anybody, stolen time left out
  double stolen = 0;  ///< taken by the machine's host
};

/// As /proc/stat says (proc(5)); zeros where there is none.
[[nodiscard]] ProcessorTime processor_time();
[[nodiscard]] unsigned usable_cores();  ///< processors that this process may run on

/// What was seen between two moments.
struct Load {
  double seconds = 0;  ///< between them
  double others = 0;   ///< cores that others kept busy
  double stolen = 0;   ///< share of the time of all cores
};

/// None, or why: `threads` of ours beside `others` on `cores`, of which `ranks`
/// processes like this one make use at the same time. Load is the number of cores that all together ask for.
[[nodiscard]] std::optional<Contention> contended(const Load& load, unsigned cores, unsigned threads, unsigned ranks);

/// Watches one worker. Processors count time in hundredths of a second, so a short answer is judged with the time
/// before it.
class LoadWatch {
 public:
  LoadWatch();
  /// Between now and a moment at least `shortest` ago and not after `since`; own: processor time of ours in it, s,
  /// counted from the same start at each call.
  [[nodiscard]] Load since(std::chrono::steady_clock::time_point since, double own);

 private:
  struct Moment {
    std::chrono::steady_clock::time_point time;
    ProcessorTime processors;
    double own;
  };
  std::deque<Moment> moments_;
};

}  // namespace plumb::harness
