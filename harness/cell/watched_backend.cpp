#include "cell/watched_backend.hpp"

#include <fmt/format.h>

#include "plumb/layers.hpp"
#include "plumb/profile.hpp"

namespace plumb::harness {

WatchedBackend::WatchedBackend(const Backend& backend, const Json& request) : backend_(backend) {
  const std::string timeline = request.value("timeline", ""), trace = request.value("trace", "");
  const PlumbBackendTable* table = &backend.table();
  try {
    if (!timeline.empty()) {
      table = layers::profile(table, timeline);
      ends_.emplace_back([table] { layers::end_profile(table); });
    }
    // Above it, so that the engine's times are without the writing of the trace.
    if (!trace.empty()) {
      table = layers::trace(table, trace);
      ends_.emplace_back([table] { layers::end_trace(table); });
    }
  } catch (...) {
    end();
    throw;
  }
  if (!ends_.empty()) backend_ = Backend(table, backend.file());
}

WatchedBackend::~WatchedBackend() { end(); }

void WatchedBackend::end() noexcept {
  for (; !ends_.empty(); ends_.pop_back()) {
    try {
      ends_.back()();
    } catch (const Error& error) {
      fmt::print(stderr, "{}\n", error.what());
    }
  }
}

}  // namespace plumb::harness
