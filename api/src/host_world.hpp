// A loaded world as IPhysicsWorld: the host's side of the tables.
#pragma once

#include <memory>

#include "plumb/physics_world.hpp"

namespace plumb {

/// Takes the world over: destroys it in the end.
[[nodiscard]] std::unique_ptr<IPhysicsWorld> adopt_world(const PlumbBackendTable& table, PlumbWorld* world);

}  // namespace plumb
