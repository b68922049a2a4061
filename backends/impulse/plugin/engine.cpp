#include "plugin/engine.hpp"

#include "plugin/open.hpp"

PlumbResult plumb_impulse_open(const PlumbOpenRequest* request, PlumbOpenReply* reply) {
  return plumb::impulse::open(request, reply);
}
