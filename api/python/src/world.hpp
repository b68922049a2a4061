// A world of a loaded backend, from its birth to close().
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core.hpp"
#include "dtypes.hpp"
#include "gate.hpp"
#include "unlocked.hpp"

namespace plumb::python {

/// What world.step() gives back: PlumbStepReport, whose numbers are turned into Python's when somebody asks.
using Report = PlumbStepReport;

class World {
 public:
  /// Throws Error with the backend's sentence.
  World(const PlumbBackendTable& table, const PlumbWorldDesc& desc);
  World(const World&) = delete;
  World& operator=(const World&) = delete;
  ~World() { destroy(); }

  void close();
  [[nodiscard]] bool closed() const { return world_ == nullptr; }

  Report step(double dt);
  void begin_step(double dt);
  Report wait();

  /// Calls act(table, world), which answers with a PlumbResult, as plumb.h's tag says. Throws Error with the backend's
  /// sentence when that is below 0, WRONG_THREAD or WRONG_PHASE when it may not be called now, ValueError when the
  /// world is closed.
  template <class Act>
  PlumbResult call(Tag tag, const char* name, Act&& act) {
    const Passage passage(gate_, tag, name);
    require_ready(name);
    return checked(act(table_, world_));
  }
  /// The same, while other threads of Python run: for calls that may take long.
  template <class Act>
  PlumbResult call_unlocked(Tag tag, const char* name, Act&& act) {
    const Passage passage(gate_, tag, name);
    require_ready(name);
    return checked(unlocked([&] { return act(table_, world_); }));
  }

  /// The same, of what is asked between begin_step and wait.
  template <class Act>
  PlumbResult call_in_step(Tag tag, const char* name, Act&& act) {
    const Passage passage(gate_, tag, name);
    require_stepping(name);
    return checked(unlocked([&] { return act(table_, world_); }));
  }

  /// The table of an extension. Throws Error (PLUMB_E_UNSUPPORTED) where the backend has none.
  template <class Table>
  const Table& extension(const char* name) const {
    return *static_cast<const Table*>(find_extension(name));
  }

 private:
  friend class Worlds;  // holds the gates of many for the time of a call

  void destroy();
  PlumbResult begin(double dt);
  PlumbResult finish(Report& report);
  void require_open(const char* name) const;
  void require_ready(const char* name) const;
  void require_stepping(const char* name) const;
  PlumbResult checked(PlumbResult result) const;
  const void* find_extension(const char* name) const;

  const PlumbBackendTable& table_;
  PlumbWorld* world_ = nullptr;
  Gate gate_;
  bool stepping_ = false;
  const void* together_ = nullptr;  ///< the Worlds that it came to last; they may be gone
};

/// Calls a function of the table that fills an array, with an array that is long enough.
template <class Row, class Fill>
PlumbResult fill_all(std::vector<Row>& rows, Fill&& fill) {
  thread_local std::size_t most = 16;  // that were ever needed
  std::uint32_t count = 0;
  rows.resize(most);
  PlumbResult result = fill(rows.data(), static_cast<std::uint32_t>(most), &count);
  while (result == PLUMB_TRUNCATED) {
    rows.resize(most = count);
    result = fill(rows.data(), count, &count);
  }
  rows.resize(result < 0 ? 0 : count);
  return result;
}

/// The same of bytes, as many as the function says that there are.
template <class Fill>
PlumbResult fill_bytes(std::string& bytes, Fill&& fill) {
  std::size_t size = 0;
  const PlumbResult result = fill(nullptr, 0, &size);
  if (result != PLUMB_TRUNCATED) return result;
  bytes.resize(size);
  return fill(bytes.data(), size, &size);
}

}  // namespace plumb::python
