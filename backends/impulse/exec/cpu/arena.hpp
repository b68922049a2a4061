// The threads of a world's own: oneTBB's where the build has it (arena_tbb.cpp), else the standard library's
// (arena_std.cpp), or in a .wasm the workers that a page lends (arena_web.cpp).
#pragma once

#include <cstdint>
#include <memory>

#include "exec/cpu/hot_team.hpp"
#include "plumb/plumb.h"

namespace plumb::impulse {

class Arena {
 public:
  /// threads: the caller is one of them.
  explicit Arena(std::uint32_t threads);
  ~Arena();
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// task(context, c) for every c < count, on all threads. What one throws is thrown here.
  void run(std::uint32_t count, void* context, PlumbTask task);

  /// job(context), which may call the other threads.
  void enter(void* context, void (*job)(void*));
  /// All others help the team until it dismisses them.
  void call(HotTeam& team);
  /// Until all that were called are back.
  void wait();

 private:
  struct Threads;
  std::unique_ptr<Threads> threads_;
};

}  // namespace plumb::impulse
