// Kernels have a memory of their own, as on a device, though it is the host's as well: what does not travel is missed.
#include "exec/memory.hpp"

namespace plumb::impulse {

const bool kOneMemory = false;

}  // namespace plumb::impulse
