#include "exec/cpu/recording.hpp"

#include "plumb/physics_world.hpp"

namespace plumb::impulse {

void Recording::stale() {
  throw Error(PLUMB_E_INTERNAL, "a recorded step would be replayed with numbers or addresses that have changed");
}

}  // namespace plumb::impulse
