// The one exported symbol.
#include "plugin/open.hpp"

extern "C" PLUMB_EXPORT PlumbResult plumb_backend_open(const PlumbOpenRequest* request, PlumbOpenReply* reply) {
  return plumb::impulse::open(request, reply);
}
