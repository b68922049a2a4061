// The plugin where the engine is a library beside it, of which there is one for each level of the machine's
// instructions: the dynamic linker takes the best that the machine can run (glibc-hwcaps, ld.so(8)).
#include "plugin/engine.hpp"

extern "C" PLUMB_EXPORT PlumbResult plumb_backend_open(const PlumbOpenRequest* request, PlumbOpenReply* reply) {
  return plumb_impulse_open(request, reply);
}
