// The parent's side of a worker: a process of this program with one backend in it, asked by lines of JSON over pipes.
//
// A backend may crash, hang, eat memory, print, or call exit: each of these is an Answer with a status and a reason.
// The worker has a process group of its own, which is killed as a whole; it dies with its parent (PR_SET_PDEATHSIG, and
// the end of its request pipe).
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "base/json.hpp"
#include "cell/progress.hpp"
#include "rows/row.hpp"

namespace plumb::harness {

/// SIGINT or SIGTERM came: the workers are to be killed and the program is to end by that signal.
struct Interrupted {
  int signal;
};

/// From now on SIGINT, SIGTERM and SIGHUP make the next wait for a worker throw Interrupted; SIGPIPE is ignored.
void catch_signals();
/// For whoever waits for something else. Throws Interrupted.
void throw_if_interrupted();

/// Wall times, s, and memory of an answer.
struct WorkerLimits {
  double engine_seconds = 300;
  double judge_seconds = 300;  ///< what the harness itself takes to look and to work out what is true
  double all_seconds = std::numeric_limits<double>::infinity();  ///< of both
  std::uint64_t memory_bytes = 0;                                ///< resident size; 0: no limit
};

struct Answer {
  std::string status = "ok";  ///< or crashed, timeout, unjudged, out_of_time, out_of_memory, error
  std::string reason;
  Json json;
  bool killed_from_outside = false;     ///< by a signal that neither this program nor a fault sent
  bool restarted = false;               ///< after it had been killed so once
  double wall_seconds = 0;              ///< that it took
  std::optional<Contention> contended;  ///< whether the machine had more to do than cores
};

class WorkerProcess {
 public:
  /// Starts the worker. Throws std::system_error when the system cannot.
  explicit WorkerProcess(const std::string& backend_file);
  ~WorkerProcess();
  WorkerProcess(const WorkerProcess&) = delete;
  WorkerProcess& operator=(const WorkerProcess&) = delete;

  /// Waits for the answer to a request; `tick` is called a few times a second. After any status but "ok" the worker is
  /// dead. Throws Interrupted.
  Answer ask(const Json& request, const WorkerLimits& limits, const std::function<void(const Progress&)>& tick = {});
  [[nodiscard]] bool alive() const { return pid_ > 0; }
  /// Of processors, of all its threads since it started, s; 0 when it is dead.
  [[nodiscard]] double processor_seconds() const;

 private:
  bool send(const std::string& line);
  void read_output();
  bool read_answer();  ///< false at the end of the pipe
  [[nodiscard]] std::uint64_t resident_bytes() const;
  /// The status and reason of what took longer than it may.
  [[nodiscard]] std::optional<std::pair<std::string, std::string>> too_late(const WorkerLimits& limits) const;
  [[nodiscard]] std::string where() const;
  [[nodiscard]] std::string last_words() const;
  Answer bury();
  Answer put_down(const std::string& status, const std::string& reason);
  void end_process(bool politely);
  int wait_for_end(std::chrono::milliseconds patience);

  pid_t pid_ = -1;
  int requests_ = -1, answers_ = -1, output_ = -1;
  Progress* progress_ = nullptr;
  std::string pending_;  ///< of an answer
  std::string tail_;     ///< of what the backend printed
};

}  // namespace plumb::harness
