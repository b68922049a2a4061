#include "worker/contention.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <string>

#include "plumb/assert.hpp"

namespace plumb::harness {

namespace {

using Clock = std::chrono::steady_clock;
constexpr std::chrono::milliseconds shortest{500};
// What a calm machine does beside: a terminal, a log, the parent of the worker. Below it times are steady.
constexpr double spare_cores = 0.25, steal_allowed = 0.03;

double seconds_between(Clock::time_point a, Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

}  // namespace

unsigned usable_cores() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return static_cast<unsigned>(std::max(1, CPU_COUNT(&set)));
}

ProcessorTime processor_time() {
  cpu_set_t set;
  CPU_ZERO(&set);
  if (sched_getaffinity(0, sizeof set, &set) != 0) return {};
  const auto ticks = static_cast<double>(sysconf(_SC_CLK_TCK));
  ProcessorTime time;
  std::ifstream lines("/proc/stat");
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("cpu", 0) != 0 || line.size() < 4 || line[3] == ' ') continue;
    std::istringstream words(line.substr(3));
    std::size_t processor = 0;
    double user = 0, nice = 0, system = 0, idle = 0, waiting = 0, interrupts = 0, soft = 0, stolen = 0;
    words >> processor >> user >> nice >> system >> idle >> waiting >> interrupts >> soft >> stolen;
    if (processor >= CPU_SETSIZE || !CPU_ISSET(processor, &set)) continue;
    time.busy += (user + nice + system + interrupts + soft) / ticks;
    time.stolen += stolen / ticks;
  }
  return time;
}

std::optional<Contention> contended(const Load& load, unsigned cores, unsigned threads, unsigned ranks) {
  PLUMB_ASSERT(cores > 0);
  const unsigned asked = threads * std::max(1u, ranks);
  const double all = load.others + threads;
  if (asked > cores) {
    const std::string who =
        ranks > 1 ? fmt::format("{} processes of {} threads", ranks, threads) : fmt::format("{} threads", threads);
    return Contention{std::max<double>(asked, all), fmt::format("{} timed at once on {} cores", who, cores)};
  }
  if (load.stolen > steal_allowed)
    return Contention{all, fmt::format("the machine's host took {:.0f} % of its time away", 100 * load.stolen)};
  if (all > cores + spare_cores)
    return Contention{all, fmt::format("other processes kept {:.1f} of {} cores busy beside {} of ours", load.others,
                                       cores, threads)};
  return std::nullopt;
}

LoadWatch::LoadWatch() { moments_.push_back({Clock::now(), processor_time(), 0}); }

Load LoadWatch::since(Clock::time_point since, double own) {
  PLUMB_ASSERT(!moments_.empty());
  const Moment now{Clock::now(), processor_time(), own};
  const auto latest = std::min(since, now.time - shortest);
  // The latest of the moments that lie far enough back; older ones will never be asked for again.
  while (moments_.size() > 1 && moments_[1].time <= latest) moments_.pop_front();
  const Moment& then = moments_.front();
  Load load;
  load.seconds = seconds_between(then.time, now.time);
  if (load.seconds > 0) {
    const double busy = now.processors.busy - then.processors.busy, ours = now.own - then.own;
    load.others = std::max(0.0, (busy - ours) / load.seconds);
    load.stolen = (now.processors.stolen - then.processors.stolen) / (load.seconds * usable_cores());
  }
  moments_.push_back(now);
  return load;
}

}  // namespace plumb::harness
