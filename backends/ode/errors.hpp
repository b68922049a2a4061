// ODE ends the process on errors: dError exits, dDebug aborts. Inside an ErrorScope both become plumb::Error instead.
#pragma once

#include "plumb/backend/world_init.hpp"

namespace plumb::ode {

/// Starts the library once a process and makes ODE's data for this thread. Throws Error when it cannot.
void ensure_ode();

/// While one lives on a thread, ODE's errors and failed assertions there throw Error(PLUMB_E_WORLD_LOST) and its
/// messages go to the host's log. ODE's code is not made for exceptions: what it worked on must not be touched again,
/// not even to destroy it. On other threads (ODE's own workers) an error can only be logged before the process ends.
class ErrorScope {
 public:
  explicit ErrorScope(const WorldInit& init);
  ErrorScope(const ErrorScope&) = delete;
  ErrorScope& operator=(const ErrorScope&) = delete;
  ~ErrorScope();

 private:
  const WorldInit* outer_;
};

}  // namespace plumb::ode
