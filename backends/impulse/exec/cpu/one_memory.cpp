// The host and the kernels share their memory.
#include "exec/memory.hpp"

namespace plumb::impulse {

const bool kOneMemory = true;

}  // namespace plumb::impulse
