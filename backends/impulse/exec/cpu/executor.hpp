// The executor of the CPU library: kernels run at once, on the world's threads.
#pragma once

#include <algorithm>
#include <string>
#include <thread>

#include "exec/cpu/crew.hpp"
#include "exec/executor.hpp"
#include "exec/memory.hpp"

namespace plumb::impulse {

/// Threads that go through several loops together.
class Team {
 public:
  explicit Team(Crew& crew) : crew_(crew) {}
  template <class F>
  void each(std::uint32_t n, const F& f) {
    crew_.each(n, f);
  }
  template <class F>
  void single(const F& f) {
    f();
  }

 private:
  Crew& crew_;
};

/// A sequence that record() has seen. Nothing to keep here: the CPU runs it anew each time.
struct Recording {
  void forget() {}
};

class Executor {
 public:
  static constexpr bool kWarps = false;  // whether neighbouring threads must do the same to be fast

  Executor(const PlumbHost* host, std::uint32_t threads) : crew_(host, threads) {}

  static std::string unmet_requirement() { return {}; }
  static const char* device_name() { return "cpu"; }
  static std::uint32_t max_threads() { return std::max(1U, std::thread::hardware_concurrency()); }

  [[nodiscard]] std::uint32_t threads() const { return crew_.threads(); }

  template <class F>
  void run(std::uint32_t n, const F& f) {
    crew_.each(n, f);
  }
  template <class F>
  void run(Count n, const F& f) {
    crew_.each(*n.value < n.capacity ? *n.value : n.capacity, f);
  }
  template <class F>
  void team(Count /*load*/, std::uint32_t /*least*/, const F& f) {
    Team team(crew_);
    f(team);
  }
  template <class F>
  void record(Recording& /*recording*/, const F& f) {
    f();
  }
  template <class T>
  void to_device(Mirror<T>& /*mirror*/, std::size_t /*count*/) {}
  template <class T>
  void to_host(Mirror<T>& /*mirror*/, std::size_t /*count*/) {}
  void wait() {}
  Crew& crew() { return crew_; }

 private:
  Crew crew_;
};

}  // namespace plumb::impulse
