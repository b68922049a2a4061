#include "plugin/engine.hpp"

#include "plugin/world.hpp"
#include "plumb/backend.hpp"

PlumbResult plumb_impulse_open(const PlumbOpenRequest* request, PlumbOpenReply* reply) {
  return plumb::backend::open<plumb::impulse::World>(request, reply);
}
