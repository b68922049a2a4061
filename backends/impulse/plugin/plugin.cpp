// The one exported symbol.
#include "plugin/world.hpp"
#include "plumb/backend.hpp"

PLUMB_BACKEND(plumb::impulse::World)
