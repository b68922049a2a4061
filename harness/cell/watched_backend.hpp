// A backend whose calls go into the files that a cell's request names.
#pragma once

#include <functional>
#include <vector>

#include "base/json.hpp"
#include "plumb/loader.hpp"

namespace plumb::harness {

/// The backend itself, or behind the layers that write "trace" and "timeline" of the request. Outlives the worlds that
/// it makes; a file that could not be completed is told on stderr.
class WatchedBackend {
 public:
  /// Throws Error for a file that cannot be written.
  WatchedBackend(const Backend& backend, const Json& request);
  ~WatchedBackend();
  WatchedBackend(const WatchedBackend&) = delete;
  WatchedBackend& operator=(const WatchedBackend&) = delete;
  [[nodiscard]] Backend& backend() { return backend_; }

 private:
  void end() noexcept;

  Backend backend_;
  std::vector<std::function<void()>> ends_;  ///< of the layers, from the backend up
};

}  // namespace plumb::harness
