// What all worlds of a process share in DART, and without a lock: Frame::World() lists every tree's root among its
// children, and a detector counts itself among those who have begun ODE. Groups of collision share something as well:
// two that are made at once have places that are not numbers.
#pragma once

#include <mutex>

namespace plumb::dart6 {

/// Held by whoever makes or unmakes skeletons, groups or detectors.
inline std::mutex& making() {
  static std::mutex mutex;
  return mutex;
}

}  // namespace plumb::dart6
