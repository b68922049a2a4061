// The one exported symbol.
#include "plumb/backend.hpp"
#include "world.hpp"

PLUMB_BACKEND(plumb::ode::World)
