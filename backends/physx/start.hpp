// What PhysX needs once in a process before anything of it is made.
#pragma once

#include <string>

#include "physx_math.hpp"

namespace plumb::px {

/// The first call starts PhysX. It is never stopped: worlds of other threads may live until the process ends.
[[nodiscard]] PxPhysics& physics();

/// What PhysX has last complained of on this thread, and forgets it; "" for nothing.
[[nodiscard]] std::string complaint();

/// How often PhysX has said, on any thread, that it had no room for something.
[[nodiscard]] std::uint32_t losses();

/// ": " and the complaint, or "": the end of a sentence.
[[nodiscard]] std::string because();

}  // namespace plumb::px
