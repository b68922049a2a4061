#include "exec/archive.hpp"

#include "plumb/physics_world.hpp"

namespace plumb::impulse {

void Archive::ends_too_early() { throw Error(PLUMB_E_CORRUPT, "the snapshot ends too early"); }

}  // namespace plumb::impulse
